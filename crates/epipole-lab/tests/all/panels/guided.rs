//! From an empty project to a measured length by the buttons that the Lab suggests.

use crate::common::desk::{click, open, rest};
use egui_kittest::kittest::{NodeT, Queryable};
use epipole_lab::project::Step;

#[test]
fn an_empty_project_offers_files_and_samples() {
    for (width, height) in [(1280.0, 720.0), (390.0, 844.0)] {
        let mut bench = open(width, height);
        click(&mut bench, "Project");
        click(&mut bench, "Remove all photographs");
        bench.get_by_label("Drop photographs here");
        click(&mut bench, "Choose photographs…");
        assert_eq!(bench.state_mut().host().asked, 1);
        click(&mut bench, "A table, nine photographs");
        rest(&mut bench);
        let project = bench.state().project();
        assert_eq!(project.view().step, Step::Reconstruction);
        assert_eq!(project.document().photos.len(), 9);
        bench.get_by_label("Sound reconstruction");
    }
}

#[test]
fn a_verdict_leads_to_depth_and_to_measuring() {
    let mut bench = open(1280.0, 720.0);
    bench.get_by_label("Sound reconstruction");
    click(&mut bench, "Measure a length");
    assert_eq!(bench.state().project().view().step, Step::Measure);
    click(&mut bench, "Photographs");
    click(&mut bench, "Depth of all views");
    let project = bench.state().project();
    assert_eq!(project.view().step, Step::Depth);
    assert!(project.document().all_views);
    click(&mut bench, "Undo");
    assert!(!bench.state().project().document().all_views);
}

#[test]
fn a_step_says_that_it_is_done() {
    let bench = open(1280.0, 720.0);
    let described = |step: Step| {
        let button = bench.get_all_by_label(step.title()).next().unwrap();
        button.accesskit_node().description().unwrap_or_default()
    };
    for step in [Step::Photographs, Step::Features, Step::Reconstruction] {
        let words = described(step);
        assert!(words.starts_with("done"), "{step:?}: {words:?}");
    }
    assert_eq!(described(Step::Export), "");
}
