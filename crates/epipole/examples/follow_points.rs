//! Corners of one frame found again in the next.
//!
//! `cargo run --release --example follow_points`

mod common;

use common::{gray, render};
use epipole::feature::{GoodFeaturesOptions, TrackOptions};
use epipole::feature::{good_features_to_track, track_lucas_kanade};
use epipole::prelude::*;

pub(crate) fn run() -> Result<(), Error> {
    let step = RigidTransform::translation(-0.01, 0.0, 0.0);
    let (camera, truth) = render(&RigidTransform::identity())?;
    let (first, second) = (gray(&truth), gray(&render(&step)?.1));
    let options = GoodFeaturesOptions::default().with_max_corners(200);
    let corners: Vec<_> = good_features_to_track(&first, &options, &mut ())?
        .iter()
        .map(Keypoint::point)
        .collect();
    let tracks = track_lucas_kanade(&first, &second, &corners, &TrackOptions::default(), &mut ())?;
    let mut errors = Vec::new();
    for (corner, track) in corners.iter().zip(&tracks) {
        let Some(track) = track else { continue };
        // Ground truth, from the depth of the pixel.
        let depth_m = truth
            .depth_m
            .get_pixel(corner.x.round() as u32, corner.y.round() as u32)
            .0[0];
        let x_in_cam = Point3::from(camera.camera.intrinsics.ray(corner) * f64::from(depth_m));
        let projected = camera.camera.intrinsics.project(&(step * x_in_cam))?;
        errors.push((track.point - projected).norm());
    }
    errors.sort_by(f64::total_cmp);
    let median_px = errors[errors.len() / 2];
    println!(
        "{} of {} corners followed, median error {median_px:.2} px",
        errors.len(),
        corners.len()
    );
    assert!(errors.len() * 2 > corners.len() && median_px < 0.3);
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Result<(), Error> {
    run()
}
