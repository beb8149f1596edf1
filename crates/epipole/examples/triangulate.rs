//! A point from three known cameras, and how sure it is.
//!
//! `cargo run --release --example triangulate`

use epipole::optim::RobustLoss;
use epipole::prelude::*;
use epipole::triangulation::point_covariance;

pub(crate) fn run() -> Result<(), Error> {
    let intrinsics = Intrinsics::centered(700.0, 640, 480)?;
    let truth = Point3::new(0.1, -0.05, 3.0);
    let cameras = [-0.2, 0.0, 0.3].map(|x| PosedCamera {
        camera: Camera::pinhole(intrinsics, 640, 480),
        cam_from_world: RigidTransform::translation(-x, 0.0, 0.0),
    });
    let mut pixels = Vec::new();
    for camera in &cameras {
        pixels.push(camera.project(&truth)?);
    }
    // Half a pixel of error in one view.
    pixels[1] += Vector2::new(0.5, 0.0);
    let found = triangulate_nview(&cameras, &pixels, RobustLoss::Trivial)?;
    let covariance = point_covariance(&cameras, &found.point_in_world, 0.5)?;
    let sigma = covariance.diagonal().map(f64::sqrt);
    println!(
        "{:.4} m, ± ({:.4}, {:.4}, {:.4}) m",
        found.point_in_world, sigma.x, sigma.y, sigma.z
    );
    assert!((found.point_in_world - truth).norm() < 3.0 * sigma.norm());
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Result<(), Error> {
    run()
}
