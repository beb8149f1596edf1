//! Two photographs by a rig whose cameras are known: rectified, matched densely, measured in
//! meters.
//!
//! `cargo run --release --example rectify_and_measure`

mod common;

use common::{SIZE, render};
use epipole::prelude::*;

pub(crate) fn run() -> Result<(), Error> {
    // The right camera stands 6 cm to the right and looks inward a little.
    let right_from_left = RigidTransform::new(
        Vector3::new(-0.06, 0.002, 0.0),
        Vector3::new(0.01, 0.03, -0.01),
    );
    let (left, truth) = render(&RigidTransform::identity())?;
    let (_, other) = render(&right_from_left)?;
    let camera = Camera::pinhole(left.camera.intrinsics, SIZE.0, SIZE.1);
    let options = RectifyOptions::default();
    let rig = rectify_calibrated(&[camera; 2], &right_from_left, &options)?;
    let rows1 = rig
        .map(0, &mut ())?
        .warp(&rgb_to_gray(&truth.image), &mut ())?;
    let rows2 = rig
        .map(1, &mut ())?
        .warp(&rgb_to_gray(&other.image), &mut ())?;
    let disparity = StereoSgm::default().compute(&rows1, &rows2, &mut ())?;
    println!("{:.0} % have a disparity", 100.0 * disparity.density());

    let mut errors = Vec::new();
    for (u, v) in (20..220)
        .step_by(5)
        .flat_map(|v| (20..300).step_by(5).map(move |u| (u, v)))
    {
        let place = Point2::new(f64::from(u), f64::from(v));
        let Some((d, pixel)) = disparity.get(u, v).zip(rig.source_pixel(0, &place)?) else {
            continue;
        };
        // Q leads to the rectified camera, and a rotation back to the photograph's.
        let x = rig.q * epipole::nalgebra::Vector4::new(place.x, place.y, f64::from(d), 1.0);
        let in_cam = rig.rect_from_cam[0].inverse() * (x.xyz() / x.w);
        let (u, v) = (pixel.x.round() as u32, pixel.y.round() as u32);
        errors.push((in_cam.z - f64::from(truth.depth_m.get_pixel(u, v).0[0])).abs());
    }
    errors.sort_by(f64::total_cmp);
    let median_m = errors[errors.len() / 2];
    println!(
        "median error of {} depths: {:.1} mm",
        errors.len(),
        1e3 * median_m
    );
    assert!(median_m < 0.02);
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Result<(), Error> {
    run()
}
