//! Photographs from which no scene can be made: the Lab says which, why, and what would help.

use crate::common::{finish, sentences, solved, steps_between};
use epipole_lab::project::{Outcome, Project, Sample, Step};
use epipole_lab::session::Event;
use epipole_lab::tasks::ReconstructionOfAll;

#[test]
fn a_camera_that_only_turned_is_told_so() {
    let mut project = solved(Sample::Turned);
    let (each, all) = sentences(&mut project);
    assert!(
        each.iter().all(|words| words.contains("only turned")),
        "{each:?}"
    );
    assert!(all.contains("only turned"), "{all}");
}

#[test]
fn a_turn_is_told_by_a_wrong_focal_length_too_with_the_right_one() {
    for typed_px in [480.0, 1000.0] {
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Turned));
        let photos = project.document().photos.iter();
        let ids: Vec<_> = photos.map(|photo| photo.id).collect();
        for id in &ids {
            project.update(Event::Focal(vec![*id], Some(typed_px)));
        }
        finish(&mut project);
        let (each, all) = sentences(&mut project);
        assert!(
            each.iter().all(|words| words.contains("only turned")),
            "{each:?}"
        );
        // Small turns look alike by any focal length; that between the first and the last
        // photograph does not.
        for photo in [0, 3].map(|n| &project.document().photos[n]) {
            let Outcome::RotationOnly(Some(focal_px)) = project.outcome(photo) else {
                panic!("{typed_px}: {each:?}");
            };
            // The camera of the sample has 600 px.
            assert!((570..=630).contains(&focal_px), "{typed_px}: {focal_px}");
            let words = format!("if its focal length is near {focal_px} px");
            assert!(project.outcome_words(photo).contains(&words), "{each:?}");
        }
        assert!(all.contains("only turned"), "{all}");
        project.update(Event::Show(Step::TwoViews));
        project.update(Event::LookAtPair(ids[0], ids[3]));
        let pair = project.describe();
        let words = format!("px, not {typed_px} px, the camera only turned, by 15.");
        assert!(pair.contains(&words), "{pair}");
    }
}

#[test]
fn a_plane_is_told_so() {
    let mut project = solved(Sample::Plane);
    let (each, all) = sentences(&mut project);
    assert!(
        all.contains("4 of 4 photographs have a camera"),
        "{all} {each:?}"
    );
    assert!(all.contains("Every pair shows a plane"), "{all} {each:?}");
    assert!(all.contains("Type it, calibrate"), "{all}");
    project.update(Event::Show(Step::TwoViews));
    let pair = project.describe();
    assert!(pair.contains("A plane, seen from two places: H"), "{pair}");
}

#[test]
fn two_places_in_one_heap_are_told_apart() {
    let mut project = solved(Sample::Mixed);
    let (each, all) = sentences(&mut project);
    assert!(
        all.contains("3 of 6") && all.contains("part 1 of 2: nothing joins the parts"),
        "{all}"
    );
    let of_other = |words: &String| words.contains("belongs to part 2, which nothing joins");
    assert_eq!(
        each.iter().filter(|words| of_other(words)).count(),
        3,
        "{each:?}"
    );
    // Each part holds the photographs of one place.
    let components = &project.get(ReconstructionOfAll).unwrap().components;
    for component in components {
        let places: Vec<bool> = component.cameras.iter().map(Option::is_some).collect();
        assert!(places[..3].iter().all(|is| *is == places[0]), "{places:?}");
        assert!(places[3..].iter().all(|is| *is != places[0]), "{places:?}");
    }
}

#[test]
fn some_upright_and_some_not_go_together_and_that_is_told() {
    let mut project = solved(Sample::Upright);
    let (each, all) = sentences(&mut project);
    assert!(
        all.contains("5 of 5 photographs have a camera"),
        "{all} {each:?}"
    );
    project.update(Event::Show(Step::Photographs));
    let words = project.describe();
    assert!(
        words.contains("2 are upright and 3 are landscape"),
        "{words}"
    );
    // On the arc around the table neighbors are equally far from each other, however the camera was
    // held.
    let component = project.component().unwrap();
    let steps = steps_between(&component.cameras);
    for step in &steps {
        assert!((step / steps[0] - 1.0).abs() < 0.02, "{steps:?}");
    }
}

#[test]
fn one_alone_and_one_twice_are_told_so() {
    let mut alone = solved(Sample::Alone);
    let (each, all) = sentences(&mut alone);
    assert!(each[0].starts_with("alone"), "{each:?}");
    assert!(all.contains("alone"), "{all}");
    let mut twice = solved(Sample::Twice);
    let (each, _) = sentences(&mut twice);
    assert!(each[0].starts_with("alone"), "{each:?}");
    assert!(each[1].contains("the same file as twice-1.png"), "{each:?}");
}
