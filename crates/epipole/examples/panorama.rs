//! Photographs of a camera that turned on the spot, joined by a homography.
//!
//! `cargo run --release --example panorama -- out.png`

mod common;

use common::{Outcome, SIZE, gray, matches, render};
use epipole::imaging::{WarpOptions, gray_to_u8, warp_perspective};
use epipole::prelude::*;

pub(crate) fn run(arguments: &[String]) -> Outcome<()> {
    let rotation = RigidTransform::rotation(Vector3::new(0.0, 0.2, 0.02));
    let (camera, first) = render(&RigidTransform::identity())?;
    let (first, second) = (gray(&first), gray(&render(&rotation)?.1));
    let (pixels1, pixels2) = matches(&first, &second)?;
    // From the second photograph to the first, where the panorama is drawn.
    let found = estimate_homography(&pixels2, &pixels1, &RansacOptions::default(), &mut ())?;
    println!("{} of {} matches agree", found.num_inliers, pixels1.len());

    let (k, k_inverse) = (
        camera.camera.intrinsics.matrix(),
        camera.camera.intrinsics.inverse_matrix(),
    );
    let truth = k
        * rotation
            .rotation
            .inverse()
            .to_rotation_matrix()
            .into_inner()
        * k_inverse;
    for corner in [
        Point2::new(0.0, 0.0),
        Point2::new(0.0, 239.0),
        Point2::new(160.0, 120.0),
    ] {
        let there = transfer(&found.model, &corner).zip(transfer(&truth, &corner));
        let (here, there) = there.ok_or("at infinity")?;
        assert!((here - there).norm() < 1.0, "{here} {there}");
    }
    let canvas = WarpOptions::new(SIZE.0 * 3 / 2, SIZE.1);
    let base = warp_perspective(&first, &Matrix3::identity(), &canvas, &mut ())?;
    let mut joined = warp_perspective(&second, &found.model, &canvas, &mut ())?;
    for (u, v, pixel) in joined.enumerate_pixels_mut() {
        if u < SIZE.0 {
            *pixel = *base.get_pixel(u, v);
        }
    }
    if let Some(path) = arguments.first() {
        gray_to_u8(&joined).save(path)?;
    }
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Outcome<()> {
    run(&common::arguments())
}
