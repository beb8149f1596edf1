//! The depth of all views is asked for, seen, clicked and removed.

use super::measuring::{hits, places, space};
use crate::common::desk::{click, open, rest};
use egui_kittest::kittest::Queryable;
use epipole_lab::project::CloudPoint;
use epipole_lab::session::HostEvent;

#[test]
fn the_depth_of_all_views_takes_one_click() {
    let mut bench = open(900.0, 700.0);
    let link = [("step", "depth"), ("all-views-megapixels", "0.05")];
    let link = link.map(|(name, value)| (name.to_owned(), value.to_owned()));
    let host_event = HostEvent::Link(link.to_vec());
    bench.state_mut().host().host_events.push(host_event);
    rest(&mut bench);
    click(&mut bench, "All views");
    click(&mut bench, "Depth of all views");
    rest(&mut bench);
    let project = bench.state().project();
    let cloud = project.all_views().expect("it was computed").1.clone();
    let words = format!("{} points from all views.", cloud.len());
    assert!(bench.query_by_label(&words).is_some(), "{words}");
    assert!(bench.query_by_label("9 of 9").is_some());
    click(&mut bench, "Show sparse points");
    click(&mut bench, "Measure");
    rest(&mut bench);
    let rect = space(&bench);
    for at in places(rect) {
        hits(&mut bench, at);
    }
    // Without sparse points, all ends are of the cloud.
    let project = bench.state().project();
    let measures = &project.document().measures;
    assert!(measures.len() > 10, "{}", measures.len());
    for (index, measure) in measures.iter().enumerate() {
        assert!(measure.ends.iter().all(|end| end.cloud.is_some()));
        assert!(project.length_words(index).contains(" ± "));
    }

    // The same on the surface, by its vertices.
    let (num_points, num_measures) = (cloud.len(), measures.len());
    click(&mut bench, "Depth");
    click(&mut bench, "surface");
    click(&mut bench, "Measure");
    rest(&mut bench);
    let rect = space(&bench);
    for at in places(rect) {
        hits(&mut bench, at);
    }
    let project = bench.state().project();
    let measures = project.document().measures.iter().enumerate();
    // The first may begin at a point that was clicked before.
    let measures: Vec<_> = measures.skip(num_measures + 1).collect();
    assert!(measures.len() > 10, "{}", measures.len());
    for (index, measure) in measures {
        let is_vertex = |cloud: CloudPoint| cloud.index as usize >= num_points;
        assert!(
            measure
                .ends
                .iter()
                .all(|end| end.cloud.is_some_and(is_vertex))
        );
        assert!(project.length_words(index).contains(" ± "));
    }
    click(&mut bench, "Depth");
    click(&mut bench, "Remove from cloud");
    rest(&mut bench);
    assert!(bench.state().project().all_views().is_none());
    assert!(bench.query_by_label("Depth of all views").is_some());
}
