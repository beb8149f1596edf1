//! The examples, run as they are without arguments.

#![cfg(feature = "decode")]
#![allow(
    clippy::duplicate_mod,
    reason = "each example is a program of its own and names what they share"
)]

#[path = "../examples/augmented_plane.rs"]
mod augmented_plane;
#[path = "../examples/bundle_adjustment.rs"]
mod bundle_adjustment;
#[path = "../examples/calibrate.rs"]
mod calibrate;
#[path = "../examples/colmap_model.rs"]
mod colmap_model;
#[path = "../examples/follow_points.rs"]
mod follow_points;
#[path = "../examples/own_estimator.rs"]
mod own_estimator;
#[path = "../examples/panorama.rs"]
mod panorama;
#[path = "../examples/rectify_and_measure.rs"]
mod rectify_and_measure;
#[path = "../examples/relative_pose.rs"]
mod relative_pose;
#[path = "../examples/triangulate.rs"]
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
