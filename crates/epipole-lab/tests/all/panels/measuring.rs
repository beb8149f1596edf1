//! Points are chosen by mouse, finger and keys, sparse and dense ones.

use crate::common::desk::{Bench, click, open, rest};
use egui::{Event as Input, Pos2, TouchDeviceId, TouchId, TouchPhase, pos2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use epipole_lab::session::Event;

/// Clicks, and returns whether there was a point.
pub(super) fn hits(bench: &mut Bench<'_>, at: Pos2) -> bool {
    bench.drag_at(at);
    bench.drop_at(at);
    bench.run_steps(3);
    bench.query_by_label_contains("No point there").is_none()
}

pub(super) fn space(bench: &Bench<'_>) -> egui::Rect {
    bench.get_by_label_contains("Space with ").rect()
}

/// Places over the whole space.
pub(super) fn places(rect: egui::Rect) -> impl Iterator<Item = Pos2> {
    let share = |n: usize| (n as f32 + 0.5) / 12.0;
    let all = (0..144).map(move |n| vec2(share(n % 12), share(n / 12)));
    all.map(move |share| rect.min + share * rect.size())
}

#[test]
fn a_finger_reaches_farther_than_a_mouse_and_a_miss_is_told() {
    let mut bench = open(900.0, 700.0);
    click(&mut bench, "Measure");
    let rect = space(&bench);
    let missed: Vec<Pos2> = places(rect).filter(|at| !hits(&mut bench, *at)).collect();
    assert!((20..144).contains(&missed.len()), "{}", missed.len());
    // The corner of the space is far from everything, also for a finger.
    let touch = |phase| Input::Touch {
        device_id: TouchDeviceId(1),
        id: TouchId(1),
        phase,
        pos: pos2(1.0, 1.0),
        force: None,
    };
    for phase in [TouchPhase::Start, TouchPhase::End] {
        bench.input_mut().events.push(touch(phase));
        bench.run_steps(2);
    }
    let num_missed = missed.len();
    let still = missed
        .into_iter()
        .filter(|at| !hits(&mut bench, *at))
        .count();
    assert!(still + 8 < num_missed, "{still} of {num_missed}");
    assert!(still > 0);
}

#[test]
fn the_keyboard_chooses_the_point_at_the_center() {
    let mut bench = open(900.0, 700.0);
    click(&mut bench, "Measure");
    bench.get_by_label_contains("Space with ").focus();
    bench.run_steps(2);
    let num_measures = |bench: &Bench<'_>| bench.state().project().document().measures.len();
    for _ in 0..60 {
        bench.key_press(egui::Key::Enter);
        bench.run_steps(3);
        if num_measures(&bench) == 1 {
            return;
        }
        bench.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::ArrowRight);
        bench.key_press(egui::Key::ArrowDown);
        bench.run_steps(2);
    }
    panic!("no length was measured by keys");
}

#[test]
fn dense_points_are_measured() {
    let mut bench = open(900.0, 700.0);
    let link = vec![("step".to_owned(), "depth".to_owned())];
    let host_event = epipole_lab::session::HostEvent::Link(link);
    bench.state_mut().host().host_events.push(host_event);
    rest(&mut bench);
    click(&mut bench, "Add to cloud and export");
    rest(&mut bench);
    click(&mut bench, "Measure");
    rest(&mut bench);
    let rect = space(&bench);
    for at in places(rect) {
        hits(&mut bench, at);
    }
    let project = bench.state().project();
    let measures = &project.document().measures;
    let is_dense = |n: &usize| measures[*n].ends.iter().any(|end| end.pixel.is_some());
    let dense: Vec<usize> = (0..measures.len()).filter(is_dense).collect();
    assert!(dense.len() > 3, "{} of {}", dense.len(), measures.len());
    for index in &dense {
        let words = project.length_words(*index);
        assert!(words.contains(" ± "), "{words}");
        let length = project.length_in_units(&measures[*index]).unwrap();
        assert!(
            length.sigma > 0.0 && length.sigma < length.value,
            "{length:?}"
        );
    }
    // Without the photographs there is no such place.
    let num_all = measures.len();
    let mut pixels = measures[dense[0]].ends.iter().filter_map(|end| end.pixel);
    let pixel = pixels.next().unwrap();
    let mut project = crate::common::reopened(project);
    assert_eq!(project.document().measures.len(), num_all);
    project.update(Event::Remove(pixel.second));
    assert!(project.document().measures.len() < num_all);
}

#[test]
fn areas_and_control_points_are_made_by_clicks() {
    let mut bench = open(900.0, 900.0);
    click(&mut bench, "Measure");
    let rect = space(&bench);
    let choose = |bench: &mut Bench<'_>, name: &str| {
        let is_word = |node: &egui_kittest::Node<'_>| {
            node.accesskit_node().role() == egui::accesskit::Role::Label
        };
        for label in ["Kind", name] {
            let widget = bench.get_all_by_label(label).find(|node| !is_word(node));
            widget.unwrap().click();
            bench.run_steps(4);
        }
    };
    let document = |bench: &Bench<'_>| bench.state().project().document().clone();
    choose(&mut bench, "Area");
    assert!(bench.query_by_label("Finish").is_none());
    for at in places(rect) {
        hits(&mut bench, at);
        if bench.query_by_label("Finish").is_some() {
            break;
        }
    }
    assert!(document(&bench).shapes.is_empty());
    click(&mut bench, "Finish");
    assert_eq!(document(&bench).shapes.len(), 1);
    assert!(bench.query_by_label_contains("Area 1: ").is_some());
    // The figure stays chosen until it is canceled.
    assert!(bench.query_by_label_contains("corners in order").is_some());
    click(&mut bench, "Cancel");
    assert!(bench.query_by_label_contains("corners in order").is_none());
    choose(&mut bench, "Control point");
    for at in places(rect) {
        hits(&mut bench, at);
        if document(&bench).control_points.len() == 2 {
            break;
        }
    }
    let names: Vec<String> = (document(&bench).control_points.iter())
        .map(|control| control.name.clone())
        .collect();
    assert_eq!(names, ["P1", "P2"]);
    click(&mut bench, "coordinates of P2 are known");
    assert_eq!(
        document(&bench).control_points[1].position_m,
        Some([0.0; 3])
    );
    assert!(
        bench
            .query_by_label_contains("1 of 3 control points")
            .is_some()
    );
    click(&mut bench, "Remove P1");
    click(&mut bench, "Remove area 1");
    assert_eq!(document(&bench).control_points.len(), 1);
    assert!(document(&bench).shapes.is_empty());
    click(&mut bench, "Undo");
    assert_eq!(document(&bench).shapes.len(), 1);
}
