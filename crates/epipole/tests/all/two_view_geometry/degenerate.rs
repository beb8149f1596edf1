//! Motions and matches that mislead.

use super::scene::{Shape, cameras, direction_error, intrinsics, options, rotation_error, scene};
use epipole::camera::{Camera, PosedCamera, RigidTransform, look_at};
use epipole::epipolar::{Epipole, RelativePose, epipoles, fundamental_from_cameras, sampson_px};
use epipole::math::random::Random;
use epipole::robust::{RansacOptions, SamplerKind, StopReason};
use epipole::two_view::{Configuration, TwoViewOptions, estimate_two_view_calibrated};
use epipole::{Error, estimate_fundamental, estimate_relative_pose};
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// F stays right when up to 95 % of the true matches lie on one plane, also where the errors fill
/// the threshold: noise of half a pixel against one pixel.
#[test]
fn a_dominant_plane_does_not_mislead() {
    let (all, most) = (1.0, 0.8);
    for (plane_ratio, count, true_ratio, noise_px) in [
        (0.5, 300, most, 0.3),
        (0.9, 300, all, 0.3),
        (0.9, 300, most, 0.3),
        (0.9, 300, most, 0.5),
        (0.95, 200, all, 0.3),
        (0.95, 200, all, 0.5),
        (0.95, 300, all, 0.3),
        (0.95, 300, all, 0.5),
        (0.95, 300, most, 0.3),
        (0.95, 300, most, 0.5),
    ] {
        let mut wrong = Vec::new();
        for seed in 0..40 {
            let mut random = Random::new(seed);
            let pair = cameras(&mut random);
            let shape = Shape::Mostly(plane_ratio);
            let s = scene(&mut random, pair, shape, count, true_ratio, noise_px);
            let report = estimate_fundamental(&s.p1, &s.p2, &options(seed), &mut ()).unwrap();
            let truth = fundamental_from_cameras(&s.cam1, &s.cam2).unwrap();
            // Points anywhere in space, not only those that were matched.
            let mut errors: Vec<f64> = (0..200)
                .filter_map(|_| {
                    let mut near = |size: f64| random.uniform(-size, size);
                    let x = Point3::new(near(1.6), near(1.2), near(1.5));
                    let (a, b) = (s.cam1.project(&x).ok()?, s.cam2.project(&x).ok()?);
                    assert!(sampson_px(&truth, &a, &b) < 1e-6);
                    Some(sampson_px(&report.model, &a, &b))
                })
                .collect();
            errors.sort_by(f64::total_cmp);
            if errors[errors.len() / 2] > 1.0 {
                wrong.push((seed, errors[errors.len() / 2]));
            }
        }
        assert!(
            wrong.is_empty(),
            "{plane_ratio} of {count} on the plane, {true_ratio} true, {noise_px} px: {wrong:?}"
        );
    }
}

#[test]
fn forward_motion() {
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let up = Vector3::new(0.0, -1.0, 0.0);
        let camera = |z: f64| PosedCamera {
            camera: Camera::pinhole(intrinsics(600.0), 640, 480),
            cam_from_world: look_at(&Point3::new(0.0, 0.0, z), &Point3::new(0.0, 0.0, 9.0), &up)
                .unwrap(),
        };
        let pair = (camera(-5.0), camera(-4.0));
        let s = scene(&mut random, pair, Shape::Volume, 300, 0.7, 0.3);
        let (k1, k2) = (&s.cam1.camera.intrinsics, &s.cam2.camera.intrinsics);
        let pose = estimate_relative_pose(
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
        let motion = pose.model.cam2_from_cam1();
        assert!(rotation_error(&motion, &s.motion()) < 0.002, "{seed}");
        assert!(direction_error(&motion, &s.motion()) < 0.01, "{seed}");
        let f = estimate_fundamental(&s.p1, &s.p2, &options(seed), &mut ()).unwrap();
        // 210 are true, with noise of 0.3 px in each coordinate.
        assert!(f.num_inliers > 180);
        // Points anywhere in space, not only those that were matched.
        let mut errors: Vec<f64> = (0..400)
            .filter_map(|_| {
                let mut near = |size: f64| random.uniform(-size, size);
                let x = Point3::new(near(1.6), near(1.2), near(1.5));
                let (a, b) = (s.cam1.project(&x).ok()?, s.cam2.project(&x).ok()?);
                Some(sampson_px(&f.model, &a, &b))
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let (median, most) = (errors[errors.len() / 2], errors[errors.len() - 1]);
        let truth = fundamental_from_cameras(&s.cam1, &s.cam2).unwrap();
        let place = |f: &Matrix3<f64>| match epipoles(f).unwrap() {
            (Epipole::Finite(pixel), _) => pixel,
            (far, _) => panic!("the camera moves towards {far:?}"),
        };
        let off = (place(&f.model) - place(&truth)).norm();
        assert!(median < 0.15 && most < 0.6, "{seed}: {median} {most}");
        assert!(off < 6.0, "{seed}: {off}");
    }
}

/// No baseline at all, or one far below the noise: some answer within the budget, nothing worse,
/// and the choice of model says that the camera only turned.
#[test]
fn no_motion_and_almost_none() {
    for baseline in [0.0, 1e-9, 1e-4] {
        for noise_px in [0.0, 0.3] {
            let mut random = Random::new(3);
            let camera = |x: f64, yaw: f64| PosedCamera {
                camera: Camera::pinhole(intrinsics(600.0), 640, 480),
                cam_from_world: RigidTransform::new(
                    Vector3::new(-x, 0.0, 5.0),
                    Vector3::new(0.0, yaw, 0.0),
                ),
            };
            for yaw in [0.0, 0.1] {
                let mut pair = (camera(0.0, 0.0), camera(baseline, 0.0));
                pair.1.cam_from_world =
                    RigidTransform::rotation(Vector3::new(0.0, yaw, 0.0)) * pair.1.cam_from_world;
                let s = scene(&mut random, pair, Shape::Volume, 150, 0.8, noise_px);
                let (k1, k2) = (&s.cam1.camera.intrinsics, &s.cam2.camera.intrinsics);
                for report in [estimate_fundamental(&s.p1, &s.p2, &options(1), &mut ())] {
                    match report {
                        Ok(report) => assert!(report.model.iter().all(|x| x.is_finite())),
                        Err(error) => assert!(!error.to_string().is_empty()),
                    }
                }
                if let Ok(report) = estimate_relative_pose(
                    &s.p1,
                    &s.p2,
                    [
                        &Camera::pinhole(*k1, 640, 480),
                        &Camera::pinhole(*k2, 640, 480),
                    ],
                    &options(1),
                    &mut (),
                ) {
                    let RelativePose {
                        rotation,
                        direction,
                        ..
                    } = report.model;
                    assert!(
                        rotation
                            .iter()
                            .chain(direction.iter())
                            .all(|x| x.is_finite())
                    );
                    assert!(report.iterations <= RansacOptions::default().max_iterations);
                }
                let choice = TwoViewOptions::default();
                let report = estimate_two_view_calibrated(
                    &s.p1,
                    &s.p2,
                    [
                        &Camera::pinhole(*k1, 640, 480),
                        &Camera::pinhole(*k2, 640, 480),
                    ],
                    &choice,
                    &mut (),
                )
                .unwrap();
                assert_eq!(report.configuration, Configuration::Panoramic);
            }
        }
    }
}

#[test]
fn duplicates_count_once() {
    let mut random = Random::new(7);
    let pair = cameras(&mut random);
    let s = scene(&mut random, pair, Shape::Volume, 100, 0.6, 0.2);
    let (mut p1, mut p2) = (s.p1.clone(), s.p2.clone());
    // Each wrong match fifty times over.
    for i in (0..100).filter(|&i| !s.truth[i]) {
        for _ in 0..50 {
            p1.push(s.p1[i]);
            p2.push(s.p2[i]);
        }
    }
    let once = estimate_fundamental(&s.p1, &s.p2, &options(1), &mut ()).unwrap();
    let often = estimate_fundamental(&p1, &p2, &options(1), &mut ()).unwrap();
    assert_eq!(once.model, often.model);
    assert_eq!(once.num_inliers, often.num_unique_inliers);
    assert_eq!(once.inliers, often.inliers[..100]);

    // Six different matches in many copies are six matches.
    let few: Vec<_> = s.p1[..6].iter().cycle().take(60).copied().collect();
    assert!(matches!(
        estimate_fundamental(&few, &few, &options(1), &mut ()),
        Err(Error::TooFewDistinct { got: 6, .. })
    ));
}

/// Matches in order of quality: PROSAC finds F in a small share of the samples, and in the reversed
/// order it still finds it.
#[test]
fn a_good_order_saves_samples() {
    let mut drawn = [0; 2];
    for seed in 0..10 {
        let mut random = Random::new(seed);
        let pair = cameras(&mut random);
        // The right ones come first, with some wrong ones between.
        let mut s = scene(&mut random, pair, Shape::Volume, 400, 0.35, 0.3);
        for i in (0..140).step_by(5) {
            s.p1.swap(i, 399 - i);
            s.p2.swap(i, 399 - i);
        }
        let run = |p1: &[Point2<f64>], p2: &[Point2<f64>], sampler| {
            let options = options(seed)
                .with_sampler(sampler)
                .with_min_iterations(1)
                .with_max_iterations(100_000);
            estimate_fundamental(p1, p2, &options, &mut ()).unwrap()
        };
        for (count, sampler) in drawn
            .iter_mut()
            .zip([SamplerKind::Uniform, SamplerKind::Prosac])
        {
            let report = run(&s.p1, &s.p2, sampler);
            assert!(report.num_inliers > 130, "{sampler:?} {seed}");
            assert_eq!(report.stop, StopReason::Confident);
            *count += report.iterations;
        }
        s.p1.reverse();
        s.p2.reverse();
        assert!(
            run(&s.p1, &s.p2, SamplerKind::Prosac).num_inliers > 130,
            "{seed}"
        );
    }
    let [uniform, prosac] = drawn;
    println!("samples: {uniform} uniform, {prosac} with PROSAC");
    assert!(10 * prosac < uniform, "{prosac} of {uniform}");
}

/// Matches that lead to one pixel by the dozen, as of a nearest neighbor for everything, do not
/// draw the epipole there.
#[test]
fn a_crowded_pixel_has_few_votes() {
    for (crowded_ratio, seed) in (0..10).flat_map(|seed| [(0.3, seed), (0.5, seed), (0.6, seed)]) {
        let mut random = Random::new(seed);
        let pair = cameras(&mut random);
        let mut s = scene(
            &mut random,
            pair,
            Shape::Volume,
            200,
            1.0 - crowded_ratio,
            0.5,
        );
        let num_true = s.truth.iter().filter(|&&is_true| is_true).count();
        for (p2, is_true) in s.p2.iter_mut().zip(&s.truth) {
            if !is_true {
                *p2 = Point2::new(300.0, 200.0);
            }
        }
        let (k1, k2) = (&s.cam1.camera.intrinsics, &s.cam2.camera.intrinsics);
        let f = estimate_fundamental(&s.p1, &s.p2, &options(seed), &mut ()).unwrap();
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
        for inliers in [&f.inliers, &e.inliers] {
            let found = inliers.iter().zip(&s.truth).filter(|(a, b)| **a && **b);
            let found = found.count();
            assert!(10 * found > 8 * num_true, "{crowded_ratio} {seed}: {found}");
        }
        assert!(f.num_unique_inliers <= num_true + 1 && !f.could_be_random());
    }
    // OpenCV's issue 19639: seven matches, of which three share a pixel and two another one.
    let u = [
        941.0, 890.0, 596.0, 940.0, 898.0, 941.0, 894.0, 933.0, 586.0, 938.0, 902.0, 933.0, 887.0,
        935.0,
    ];
    let v = [
        1416.0, 806.0, 1157.0, 852.0, 1380.0, 855.0, 1378.0, 843.0, 1145.0, 849.0, 1378.0, 843.0,
        1378.0, 843.0,
    ];
    let points =
        |list: &[f64]| -> Vec<_> { list.chunks(2).map(|p| Point2::new(p[0], p[1])).collect() };
    let report = estimate_fundamental(&points(&u), &points(&v), &RansacOptions::default(), &mut ());
    assert!(
        matches!(report, Err(Error::NoConsensus { .. })),
        "{report:?}"
    );
}
