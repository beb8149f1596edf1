//! Cameras and points that were disturbed, put right by bundle adjustment.
//!
//! `cargo run --release --example bundle_adjustment`

use epipole::math::random::Random;
use epipole::prelude::*;
use epipole::sfm::{Bundle, BundleObservation, BundleOptions, adjust_bundle};

pub(crate) fn run() -> Result<(), Error> {
    let mut random = Random::new(1);
    let intrinsics = Intrinsics::centered(600.0, 640, 480)?;
    let mut bundle = Bundle::default();
    for i in 0..5 {
        let cam_from_world = RigidTransform::translation(0.4 - 0.2 * f64::from(i), 0.0, 4.0);
        bundle.cameras.push(PosedCamera {
            camera: Camera::pinhole(intrinsics, 640, 480),
            cam_from_world,
        });
    }
    for point in 0..50 {
        let position = Point3::new(
            random.uniform(-1.0, 1.0),
            random.uniform(-0.8, 0.8),
            random.uniform(-1.0, 1.0),
        );
        bundle.points.push(position);
        for camera in 0..5 {
            let exact = bundle.cameras[camera].project(&position)?;
            let noise = Vector2::new(0.5 * random.normal(), 0.5 * random.normal());
            bundle.observations.push(BundleObservation {
                camera,
                point,
                pixel: exact + noise,
            });
        }
    }
    for point in &mut bundle.points {
        *point += Vector3::new(random.normal(), random.normal(), random.normal()) * 0.05;
    }
    let report = adjust_bundle(&mut bundle, &BundleOptions::default(), &mut ())?;
    for step in &report.history {
        println!("{:2}: cost {:.2}", step.index, step.cost);
    }
    let rms_px = (2.0 * report.final_cost / bundle.observations.len() as f64).sqrt();
    println!("{rms_px:.3} px after {} steps", report.iterations);
    assert!((0.4..0.75).contains(&rms_px));
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Result<(), Error> {
    run()
}
