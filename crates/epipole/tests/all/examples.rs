//! The examples, run as they are without arguments.

#![allow(
    clippy::duplicate_mod,
    reason = "each example is a program of its own and names what they share"
)]

#[path = "../../examples/augmented_plane.rs"]
mod augmented_plane;
#[path = "../../examples/bundle_adjustment.rs"]
mod bundle_adjustment;
#[path = "../../examples/calibrate.rs"]
mod calibrate;
#[path = "../../examples/colmap_model.rs"]
mod colmap_model;
#[path = "../../examples/follow_points.rs"]
mod follow_points;
#[path = "../../examples/own_estimator.rs"]
mod own_estimator;
#[path = "../../examples/panorama.rs"]
mod panorama;
#[path = "../../examples/rectify_and_measure.rs"]
mod rectify_and_measure;
#[path = "../../examples/relative_pose.rs"]
mod relative_pose;
#[path = "../../examples/triangulate.rs"]
mod triangulate;

#[test]
fn augmented_plane_runs() {
    augmented_plane::run().expect("the example runs");
}

#[test]
fn bundle_adjustment_runs() {
    bundle_adjustment::run().expect("the example runs");
}

#[test]
fn calibrate_runs() {
    calibrate::run(&[]).expect("the example runs");
}

#[test]
fn colmap_model_runs() {
    colmap_model::run(&[]).expect("the example runs");
}

#[test]
fn follow_points_runs() {
    follow_points::run().expect("the example runs");
}

#[test]
fn own_estimator_runs() {
    own_estimator::run().expect("the example runs");
}

#[test]
fn panorama_runs() {
    panorama::run(&[]).expect("the example runs");
}

#[test]
fn rectify_and_measure_runs() {
    rectify_and_measure::run().expect("the example runs");
}

#[test]
fn relative_pose_runs() {
    relative_pose::run(&[]).expect("the example runs");
}

#[test]
fn triangulate_runs() {
    triangulate::run().expect("the example runs");
}

/// Crates that `source` names directly, not through `epipole::`.
fn foreign(source: &str) -> Vec<String> {
    let crates = ["arrayvec", "image", "libm", "nalgebra", "rayon"];
    let mut named = Vec::new();
    for name in crates.map(|name| format!("{name}::")) {
        for (at, _) in source.match_indices(&name) {
            let before = source[..at].chars().next_back();
            if !before.is_some_and(|c| c.is_alphanumeric() || "_:{".contains(c)) {
                named.push(name.clone());
            }
        }
    }
    named
}

#[test]
fn an_example_needs_only_this_crate() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let this = include_str!("examples.rs");
    let (mut examples, mark) = (0, "#[path = \"../../examples/");
    for line in this.lines().filter_map(|line| line.strip_prefix(mark)) {
        let file = folder.join(line.trim_end_matches("\"]"));
        let source = std::fs::read_to_string(&file).expect("the example is there");
        assert!(source.lines().count() <= 60, "{}", file.display());
        assert_eq!(foreign(&source), [""; 0], "{}", file.display());
        examples += 1;
    }
    assert_eq!(examples, 10);
    assert_eq!(foreign("let x = libm::sin(0.0);"), ["libm::"]);
    assert_eq!(foreign("use epipole::nalgebra::Matrix3;"), [""; 0]);
}
