//! Exact matches, and laws that hold of every answer.

use super::scene::{
    Points, Shape, cameras, direction_error, intrinsics, options, rotation_error, same_up_to_sign,
    scene,
};
use epipole::camera::{Camera, PosedCamera, RigidTransform};
use epipole::epipolar::{
    decompose_essential, essential_from_fundamental, essential_from_motion,
    fundamental_from_cameras, sampson_px, select_pose,
};
use epipole::homography::{homography_from_motion, transfer};
use epipole::math::random::Random;
use epipole::{estimate_fundamental, estimate_homography, estimate_relative_pose};
use nalgebra::{Matrix3, Point2, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// COLMAP's src/colmap/estimators/two_view_geometry_test.cc, calibrated and uncalibrated: a hundred
/// seeds, 50 exact matches, rotation and direction within 1e-6.
#[test]
fn a_hundred_exact_pairs() {
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let pair = cameras(&mut random);
        let s = scene(&mut random, pair, Shape::Volume, 50, 1.0, 0.0);
        let (k1, k2) = (&s.cam1.camera.intrinsics, &s.cam2.camera.intrinsics);
        let truth = s.motion();
        let report = estimate_relative_pose(
            &s.p1,
            &s.p2,
            [
                &Camera::pinhole(*k1, 640, 480),
                &Camera::pinhole(*k2, 640, 480),
            ],
            &options(seed),
            &mut (),
        )
        .unwrap();
        let motion = report.model.cam2_from_cam1();
        assert!(rotation_error(&motion, &truth) < 1e-6, "{seed}");
        assert!(direction_error(&motion, &truth) < 1e-6, "{seed}");
        assert_eq!(report.num_inliers, 50);

        let f = estimate_fundamental(&s.p1, &s.p2, &options(seed), &mut ())
            .unwrap()
            .model;
        let e = essential_from_fundamental(&f, k1, k2).unwrap();
        let chosen = select_pose(&decompose_essential(&e).unwrap(), &s.p1, &s.p2, k1, k2).unwrap();
        assert!(
            rotation_error(&chosen.cam2_from_cam1, &truth) < 1e-6,
            "{seed}"
        );
        assert!(
            direction_error(&chosen.cam2_from_cam1, &truth) < 1e-6,
            "{seed}"
        );
        assert_eq!(chosen.num_in_front, 50);
    }
}

#[test]
fn equal_seeds_give_equal_bits() {
    let mut random = Random::new(17);
    let pair = cameras(&mut random);
    let s = scene(&mut random, pair, Shape::Volume, 200, 0.6, 0.5);
    let (k1, k2) = (&s.cam1.camera.intrinsics, &s.cam2.camera.intrinsics);
    let mut different = 0;
    for seed in 0..5 {
        let one = estimate_fundamental(&s.p1, &s.p2, &options(seed), &mut ()).unwrap();
        assert_eq!(
            one,
            estimate_fundamental(&s.p1, &s.p2, &options(seed), &mut ()).unwrap()
        );
        let e = estimate_relative_pose(
            &s.p1,
            &s.p2,
            [
                &Camera::pinhole(*k1, 640, 480),
                &Camera::pinhole(*k2, 640, 480),
            ],
            &options(seed),
            &mut (),
        )
        .unwrap();
        assert_eq!(
            e,
            estimate_relative_pose(
                &s.p1,
                &s.p2,
                [
                    &Camera::pinhole(*k1, 640, 480),
                    &Camera::pinhole(*k2, 640, 480)
                ],
                &options(seed),
                &mut ()
            )
            .unwrap()
        );
        let other = estimate_fundamental(&s.p1, &s.p2, &options(seed + 100), &mut ()).unwrap();
        different += usize::from(other.model != one.model);
    }
    assert!(different > 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Moving the world changes nothing; scaling the image scales F; swapping the views transposes
    /// it; the order of the matches does not matter.
    #[test]
    fn invariances(
        seed in 0_u64..1000,
        factor in 0.2_f64..5.0,
        rotation in prop::array::uniform3(-3.0_f64..3.0),
        shift in prop::array::uniform3(-50.0_f64..50.0),
    ) {
        let mut random = Random::new(seed);
        let pair = cameras(&mut random);
        let s = scene(&mut random, pair, Shape::Volume, 40, 1.0, 0.0);
        let truth = fundamental_from_cameras(&s.cam1, &s.cam2).unwrap();

        let motion = RigidTransform::new(Vector3::from(shift), Vector3::from(rotation));
        let moved = |c: &PosedCamera| PosedCamera {
            cam_from_world: c.cam_from_world * motion.inverse(),
            ..*c
        };
        let again = fundamental_from_cameras(&moved(&s.cam1), &moved(&s.cam2)).unwrap();
        prop_assert!(same_up_to_sign(&truth, &again) < 1e-9);

        let find = |p1: &Points, p2: &Points| estimate_fundamental(p1, p2, &options(seed), &mut ()).unwrap();
        let f = find(&s.p1, &s.p2);
        let fits = |f: &Matrix3<f64>, p1: &Points, p2: &Points| {
            p1.iter().zip(p2).map(|(a, b)| sampson_px(f, a, b)).fold(0.0, f64::max)
        };
        prop_assert!(fits(&f.model, &s.p1, &s.p2) < 1e-5);

        let swapped = find(&s.p2, &s.p1);
        prop_assert!(fits(&swapped.model.transpose(), &s.p1, &s.p2) < 1e-5);

        let scaled = |p: &Points| -> Points { p.iter().map(|q| q * factor).collect() };
        let large = estimate_fundamental(
            &scaled(&s.p1),
            &scaled(&s.p2),
            &options(seed).with_max_error_px(factor),
            &mut (),
        ).unwrap();
        prop_assert_eq!(large.num_inliers, 40);
        let undo = Matrix3::from_diagonal(&Vector3::new(factor, factor, 1.0));
        prop_assert!(fits(&(undo * large.model * undo), &s.p1, &s.p2) < 1e-5);

        let reversed = |p: &Points| -> Points { p.iter().rev().copied().collect() };
        let back = find(&reversed(&s.p1), &reversed(&s.p2));
        prop_assert_eq!(back.num_inliers, 40);
        prop_assert!(fits(&back.model, &s.p1, &s.p2) < 1e-5);
    }

    /// A homography found forwards is the inverse of the one found backwards.
    #[test]
    fn homographies_invert(seed in 0_u64..1000) {
        let mut random = Random::new(seed);
        let rotation = Vector3::from_fn(|_, _| random.uniform(-0.3, 0.3));
        let t = Vector3::from_fn(|_, _| random.uniform(-0.3, 0.3));
        let motion = RigidTransform::from_parts(
            t.into(),
            UnitQuaternion::from_scaled_axis(rotation),
        );
        let k = intrinsics(600.0);
        let h = homography_from_motion(&motion, &-Vector3::z(), 1.0, &k, &k);
        let p1: Points = (0..30)
            .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
            .collect();
        let p2: Points = p1.iter().map(|p| transfer(&h, p).unwrap()).collect();
        let there = estimate_homography(&p1, &p2, &options(seed), &mut ()).unwrap().model;
        let back = estimate_homography(&p2, &p1, &options(seed), &mut ()).unwrap().model;
        prop_assert!(same_up_to_sign(&there, &h) < 1e-7);
        prop_assert!(same_up_to_sign(&(there * back), &Matrix3::identity()) < 1e-6);
    }
}

/// E of a known motion survives decomposition, whatever the pose.
#[test]
fn essential_round_trip() {
    let mut random = Random::new(19);
    for _ in 0..100 {
        let mut vector = || Vector3::from_fn(|_, _| random.normal());
        let motion = RigidTransform::new(vector(), vector());
        let e = essential_from_motion(&motion).unwrap();
        let best = decompose_essential(&e)
            .unwrap()
            .iter()
            .map(|m| rotation_error(m, &motion) + direction_error(m, &motion))
            .fold(f64::INFINITY, f64::min);
        assert!(best < 1e-7, "{best}");
    }
}
