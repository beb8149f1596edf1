//! Two photographs and their focal length: how did the camera move between them?
//!
//! `cargo run --release --example relative_pose -- left.jpg right.jpg 1200`, or without arguments
//! on two rendered photographs.

mod common;

use common::{Outcome, gray, read_gray, render};
use epipole::prelude::*;

pub(crate) fn run(arguments: &[String]) -> Outcome<()> {
    let rotation_vector = Vector3::new(0.02, 0.17, 0.01);
    let (left, right, k) = if let [left, right, focal_px] = arguments {
        let image = read_gray(left)?;
        let k = Intrinsics::centered(focal_px.parse()?, image.width(), image.height())?;
        (image, read_gray(right)?, k)
    } else {
        let step = RigidTransform::new(Vector3::new(-0.25, 0.02, 0.03), rotation_vector);
        let (camera, first) = render(&RigidTransform::identity())?;
        (
            gray(&first),
            gray(&render(&step)?.1),
            camera.camera.intrinsics,
        )
    };
    let camera = Camera::pinhole(k, left.width(), left.height());
    let sift = SiftOptions::default();
    let (left, right) = (
        detect_sift(&left, &sift, &mut ())?,
        detect_sift(&right, &sift, &mut ())?,
    );
    let options = MatchOptions::default();
    let matches = match_descriptors(&left.descriptors, &right.descriptors, &options, &mut ())?;
    let (pixels1, pixels2): (Vec<_>, Vec<_>) = matches
        .iter()
        .map(|m| {
            let (a, b) = (left.keypoints[m.index1], right.keypoints[m.index2]);
            (a.point(), b.point())
        })
        .unzip();
    let options = TwoViewOptions::default();
    let cameras = [&camera; 2];
    let found = estimate_two_view_calibrated(&pixels1, &pixels2, cameras, &options, &mut ())?;
    let count = found.num_inliers;
    println!("{count} of {}: {:?}", matches.len(), found.configuration);
    let motion = found.cam2_from_cam1.ok_or("the motion cannot be told")?;
    println!("turned by {:.2}°", motion.rotation.angle().to_degrees());
    println!("moved along {:.3}", motion.translation.vector.transpose());
    if arguments.is_empty() {
        assert!((motion.rotation.angle() - rotation_vector.norm()).abs() < 0.01);
    }
    Ok(())
}

#[allow(dead_code, reason = "the tests call run")]
fn main() -> Outcome<()> {
    run(&common::arguments())
}
