//! Poses through a 180° fisheye are as exact as least squares over the right matches alone.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use epipole::camera::{Camera, Fisheye, Intrinsics, Lens, Observation, RigidTransform};
use epipole::epipolar::estimate_relative_pose_of_rays;
use epipole::math::random::Random;
use epipole::robust::RansacOptions;
use nalgebra::{Point3, Vector2, Vector3};

fn fisheye() -> Camera {
    Camera {
        intrinsics: Intrinsics::centered(250.0, 800, 800).unwrap(),
        lens: Lens::Fisheye(Fisheye::default()),
        width: 800,
        height: 800,
    }
}

/// Matches with noise of one pixel, 30 % of them wrong; the right ones come first.
fn matches(seed: u64) -> ([Vec<Observation>; 2], usize, RigidTransform) {
    let mut random = Random::new(seed);
    let camera = fisheye();
    let direction = Vector3::from_fn(|_, _| random.normal()).normalize();
    let turn = 0.2 * Vector3::from_fn(|_, _| random.normal());
    let cam2_from_cam1 = RigidTransform::new(0.5 * direction, turn);
    let mut seen = [Vec::new(), Vec::new()];
    while seen[0].len() < 200 {
        let x = Point3::from(4.0 * Vector3::from_fn(|_, _| random.normal()));
        let mut see = |x: &Point3<f64>| {
            let off = Vector2::from_fn(|_, _| random.normal());
            // Half a turn of view.
            let is_seen = x.z > 0.0 && x.coords.norm() > 1.0;
            let pixel = is_seen.then(|| camera.project(x).ok())?? + off;
            camera.observe(&pixel).ok()
        };
        if let (Some(seen1), Some(seen2)) = (see(&x), see(&(cam2_from_cam1 * x))) {
            seen[0].push(seen1);
            seen[1].push(seen2);
        }
    }
    let num_right = 140;
    seen[1][num_right..].rotate_left(1);
    (seen, num_right, cam2_from_cam1)
}

#[test]
fn relative_poses_are_as_exact_as_from_the_right_matches() {
    let mut errors = [Vec::new(), Vec::new()];
    for seed in 0..60 {
        let (seen, num_right, truth) = matches(seed);
        let options = RansacOptions {
            seed,
            ..RansacOptions::default().within(4.0)
        };
        let wide = RansacOptions {
            // Nearly every error of right matches is within it: least squares over all of them.
            max_error_px: 1e3,
            ..options
        };
        let [seen1, seen2] = &seen;
        let found = estimate_relative_pose_of_rays(seen1, seen2, &options, &mut ()).unwrap();
        let best = estimate_relative_pose_of_rays(
            &seen1[..num_right],
            &seen2[..num_right],
            &wide,
            &mut (),
        );
        for (errors, model) in errors.iter_mut().zip([found.model, best.unwrap().model]) {
            errors.push(model.rotation.angle_to(&truth.rotation).to_degrees());
        }
    }
    let [found, best] = errors.map(|mut errors| {
        errors.sort_by(f64::total_cmp);
        errors[30]
    });
    println!("median rotation error: {found:.4}°, of right matches alone {best:.4}°");
    assert!(found < 1.1 * best, "{found} {best}");
}
