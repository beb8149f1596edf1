//! Robust estimation of F, E, H and poses on scenes with known truth.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use epipole::camera::{Camera, Intrinsics, RigidTransform, look_at, relative_motion};
use epipole::epipolar::{
    Epipole, RelativePose, decompose_essential, epipoles, essential_from_fundamental,
    essential_from_motion, fundamental_from_cameras, fundamental_from_essential, sampson_px,
    select_pose,
};
use epipole::homography::{homography_from_motion, transfer, transfer_error_px};
use epipole::math::random::Random;
use epipole::robust::{RansacOptions, RansacReport, SamplerKind, StopReason, estimate_similarity};
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view_calibrated,
};
use epipole::{
    Error, estimate_absolute_pose, estimate_fundamental, estimate_homography,
    estimate_relative_pose, estimate_two_view,
};
use nalgebra::{Matrix3, Point2, Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// Where the points of a scene are.
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Volume,
    Plane,
    /// This share on a plane, the rest off it.
    Mostly(f64),
}

struct Scene {
    cam1: Camera,
    cam2: Camera,
    points: Vec<Point3<f64>>,
    p1: Vec<Point2<f64>>,
    p2: Vec<Point2<f64>>,
    /// Which matches are true.
    truth: Vec<bool>,
}

impl Scene {
    fn motion(&self) -> RigidTransform {
        relative_motion(&self.cam1.cam_from_world, &self.cam2.cam_from_world)
    }
}

fn intrinsics(focal_px: f64) -> Intrinsics {
    Intrinsics::centered(focal_px, 640, 480).unwrap()
}

/// A random pair of cameras that look at the scene around the origin from 4 to 6 units away.
fn cameras(random: &mut Random) -> (Camera, Camera) {
    let mut camera = |focal_px: f64| {
        let mut near = |size: f64| random.uniform(-size, size);
        let center = Point3::new(near(1.5), near(1.0), -5.0 + near(1.0));
        let target = Point3::new(near(0.3), near(0.3), 0.0);
        let up = Vector3::new(near(0.3), -1.0, 0.0);
        Camera {
            intrinsics: intrinsics(focal_px),
            cam_from_world: look_at(&center, &target, &up).unwrap(),
        }
    };
    (camera(600.0), camera(650.0))
}

fn scene(
    random: &mut Random,
    (cam1, cam2): (Camera, Camera),
    shape: Shape,
    num_matches: usize,
    share_true: f64,
    noise_px: f64,
) -> Scene {
    let mut found = Scene {
        cam1,
        cam2,
        points: Vec::new(),
        p1: Vec::new(),
        p2: Vec::new(),
        truth: Vec::new(),
    };
    let num_true = (share_true * num_matches as f64).round() as usize;
    while found.p1.len() < num_matches {
        let on_plane = match shape {
            Shape::Volume => false,
            Shape::Plane => true,
            Shape::Mostly(share) => (found.p1.len() as f64) < share * num_true as f64,
        };
        let (x, y) = (random.uniform(-1.6, 1.6), random.uniform(-1.2, 1.2));
        let z = if on_plane {
            0.3 * x - 0.2 * y
        } else {
            random.uniform(-1.5, 1.5)
        };
        let point = Point3::new(x, y, z);
        let (Ok(a), Ok(b)) = (cam1.project(&point), cam2.project(&point)) else {
            continue;
        };
        let is_true = found.p1.len() < num_true;
        let mut noisy = |p: Point2<f64>| {
            Point2::new(
                p.x + noise_px * random.normal(),
                p.y + noise_px * random.normal(),
            )
        };
        let (a, mut b) = (noisy(a), noisy(b));
        if !is_true {
            b = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        }
        found.points.push(point);
        found.p1.push(a);
        found.p2.push(b);
        found.truth.push(is_true);
    }
    found
}

fn rotation_error(a: &RigidTransform, b: &RigidTransform) -> f64 {
    a.rotation.angle_to(&b.rotation)
}

fn direction_error(a: &RigidTransform, b: &RigidTransform) -> f64 {
    (a.translation.vector.normalize() - b.translation.vector.normalize()).norm()
}

fn options(seed: u64) -> RansacOptions {
    RansacOptions {
        seed,
        ..RansacOptions::default()
    }
}

fn same_up_to_sign(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    let (a, b) = (a / a.norm(), b / b.norm());
    (a - b).norm().min((a + b).norm())
}

/// COLMAP's src/colmap/estimators/two_view_geometry_test.cc, calibrated and uncalibrated: a hundred seeds, 50 exact
/// matches, rotation and direction within 1e-6.
#[test]
fn a_hundred_exact_pairs() {
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let pair = cameras(&mut random);
        let s = scene(&mut random, pair, Shape::Volume, 50, 1.0, 0.0);
        let (k1, k2) = (&s.cam1.intrinsics, &s.cam2.intrinsics);
        let truth = s.motion();
        let report = estimate_relative_pose(&s.p1, &s.p2, k1, k2, &options(seed)).unwrap();
        let motion = report.model.cam2_from_cam1();
        assert!(rotation_error(&motion, &truth) < 1e-6, "{seed}");
        assert!(direction_error(&motion, &truth) < 1e-6, "{seed}");
        assert_eq!(report.num_inliers, 50);

        let f = estimate_fundamental(&s.p1, &s.p2, &options(seed))
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

/// The same source: planar and panoramic pairs are recognized, with noise and outliers; also where
/// the noise fills the threshold, half a pixel against one.
#[test]
fn configurations_are_recognized() {
    // A plane alone tells its motion but for one of two.
    let (mut planes, mut one_of_two) = (0, 0);
    // Sixty true matches of 200 with .7 px of noise leave the motion of one pair in forty farther off than that: seven
    // of 300 seeds.
    let mut generals = 0;
    for (max_error_px, noise_px, share_true) in [
        (1.0, 0.3, 0.7),
        (1.0, 0.5, 0.7),
        (1.5, 0.3, 0.7),
        (2.0, 0.7, 0.3),
        (2.0, 1.0, 0.7),
    ] {
        for seed in 0..20 {
            let mut random = Random::new(seed);
            let pair = cameras(&mut random);
            let (k1, k2) = (pair.0.intrinsics, pair.1.intrinsics);
            let two_view = |s: &Scene| {
                let options = TwoViewOptions {
                    ransac: RansacOptions {
                        max_error_px,
                        ..options(seed)
                    },
                    ..TwoViewOptions::default()
                };
                (
                    estimate_two_view_calibrated(&s.p1, &s.p2, &k1, &k2, &options).unwrap(),
                    estimate_two_view(&s.p1, &s.p2, &options).unwrap(),
                )
            };
            let told = format!("{max_error_px} px, noise {noise_px} px, seed {seed}");
            let close = |motion: &RigidTransform, truth: &RigidTransform| {
                rotation_error(motion, truth) < 0.03 && direction_error(motion, truth) < 0.1
            };
            let general = scene(&mut random, pair, Shape::Volume, 200, share_true, noise_px);
            let (calibrated, uncalibrated) = two_view(&general);
            assert_eq!(calibrated.configuration, Configuration::General, "{told}");
            assert_eq!(uncalibrated.configuration, Configuration::General, "{told}");
            let motion = calibrated.cam2_from_cam1.unwrap();
            let truth = general.motion();
            generals += usize::from(close(&motion, &truth));
            // Where it is farther off, the matches speak for it, and not for the truth.
            let misfit = |motion: &RigidTransform| -> f64 {
                let e = essential_from_motion(motion).unwrap();
                let f = fundamental_from_essential(&e, &k1, &k2).unwrap();
                let pairs = general.p1.iter().zip(&general.p2);
                let errors = pairs.map(|(p1, p2)| sampson_px(&f, p1, p2) / max_error_px);
                errors.map(|error| (error * error).min(1.0)).sum()
            };
            assert!(
                close(&motion, &truth) || misfit(&motion) < misfit(&truth),
                "{told}"
            );
            assert_eq!(calibrated.other_cam2_from_cam1, None);

            let plane = scene(&mut random, pair, Shape::Plane, 200, share_true, noise_px);
            let (calibrated, uncalibrated) = two_view(&plane);
            assert_eq!(calibrated.configuration, Configuration::Planar, "{told}");
            assert_eq!(uncalibrated.configuration, Configuration::Planar, "{told}");
            let motions = [calibrated.cam2_from_cam1, calibrated.other_cam2_from_cam1];
            let truth = plane.motion();
            planes += 1;
            one_of_two += usize::from(motions.iter().flatten().any(|m| close(m, &truth)));

            let mut turned = pair;
            let center = turned.0.center_in_world();
            turned.1.cam_from_world.translation.vector =
                -(turned.1.cam_from_world.rotation * center.coords);
            let turn = scene(
                &mut random,
                turned,
                Shape::Volume,
                200,
                share_true,
                noise_px,
            );
            let (calibrated, uncalibrated) = two_view(&turn);
            assert_eq!(calibrated.configuration, Configuration::Panoramic, "{told}");
            let motion = calibrated.cam2_from_cam1.unwrap();
            assert_eq!(motion.translation.vector, Vector3::zeros());
            assert!(rotation_error(&motion, &turn.motion()) < 0.005, "{told}");
            // Without intrinsics a turn looks like a plane.
            assert_eq!(uncalibrated.configuration, Configuration::Planar, "{told}");
        }
    }
    println!("of {planes} planes one of two motions was right for {one_of_two}");
    assert!(20 * one_of_two >= 19 * planes, "{one_of_two} of {planes}");
    assert!(50 * generals >= 49 * planes, "{generals} of {planes}");
}

/// Matches that have nothing to do with one another agree by the dozen if there are thousands of
/// them; that is no pair.
#[test]
fn chance_is_no_pair() {
    let k = intrinsics(600.0);
    for (count, max_error_px) in [(30, 4.0), (100, 1.0), (300, 2.0), (1000, 1.0), (3000, 4.0)] {
        for seed in 0..3 {
            let mut random = Random::new(900 + seed);
            let mut anywhere = || -> Vec<Point2<f64>> {
                let mut pixel =
                    || Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
                (0..count).map(|_| pixel()).collect()
            };
            let (a, b) = (anywhere(), anywhere());
            let choice = TwoViewOptions {
                ransac: RansacOptions {
                    max_error_px,
                    max_iterations: 2000,
                    ..options(seed)
                },
                ..TwoViewOptions::default()
            };
            let calibrated = estimate_two_view_calibrated(&a, &b, &k, &k, &choice).unwrap();
            assert_eq!(calibrated.configuration, Configuration::Degenerate);
            assert_eq!(calibrated.cam2_from_cam1, None);
            let uncalibrated = estimate_two_view(&a, &b, &choice).unwrap();
            assert_eq!(uncalibrated.configuration, Configuration::Degenerate);
            assert!(
                estimate_fundamental(&a, &b, &choice.ransac)
                    .unwrap()
                    .could_be_chance()
            );
            assert!(
                estimate_homography(&a, &b, &choice.ransac)
                    .unwrap()
                    .could_be_chance()
            );
            assert!(
                estimate_similarity(&a, &b, &choice.ransac)
                    .unwrap()
                    .could_be_chance()
            );
            let points: Vec<_> = a
                .iter()
                .map(|p| Point3::new(p.x / 100.0, p.y / 100.0, random.uniform(4.0, 9.0)))
                .collect();
            let pose = estimate_absolute_pose(&points, &b, &k, &choice.ransac);
            assert!(pose.is_err() || pose.unwrap().could_be_chance());
        }
    }
}

#[test]
fn the_motion_is_that_of_e_even_where_f_is_chosen() {
    let (mut by_f, mut by_e) = (Vec::new(), Vec::new());
    for seed in 0..10 {
        let mut random = Random::new(400 + seed);
        let pair = cameras(&mut random);
        let scene = scene(&mut random, pair, Shape::Volume, 200, 0.7, 0.5);
        let (k1, k2) = (pair.0.intrinsics, pair.1.intrinsics);
        let choose = TwoViewOptions {
            ransac: options(seed),
            // E cannot have twice F's inliers.
            min_essential_share: 2.0,
            ..TwoViewOptions::default()
        };
        let found = estimate_two_view_calibrated(&scene.p1, &scene.p2, &k1, &k2, &choose).unwrap();
        assert!(matches!(found.model, TwoViewModel::Fundamental(_)));
        let motion = found.cam2_from_cam1.unwrap();
        let truth = scene.motion();
        by_e.push(direction_error(&motion, &truth));
        assert!(rotation_error(&motion, &truth) < 0.01 && by_e[by_e.len() - 1] < 0.05);
        // What decomposing the chosen F would give.
        let e = essential_from_fundamental(&found.fundamental.unwrap(), &k1, &k2).unwrap();
        let motions = decompose_essential(&e).unwrap();
        let chosen = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
            let inliers = pixels
                .iter()
                .zip(&found.inliers)
                .filter(|(_, inlier)| **inlier);
            inliers.map(|(pixel, _)| *pixel).collect()
        };
        let (in1, in2) = (chosen(&scene.p1), chosen(&scene.p2));
        let selected = select_pose(&motions, &in1, &in2, &k1, &k2).unwrap();
        by_f.push(direction_error(&selected.cam2_from_cam1, &truth));
    }
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len() as f64;
    assert!(mean(&by_e) < 0.7 * mean(&by_f), "{by_e:?} {by_f:?}");
}

/// F stays right when up to 95 % of the true matches lie on one plane, also where the errors fill
/// the threshold: noise of half a pixel against one pixel.
#[test]
fn a_dominant_plane_does_not_mislead() {
    let (all, most) = (1.0, 0.8);
    for (share_on_plane, count, share_true, noise_px) in [
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
            let shape = Shape::Mostly(share_on_plane);
            let s = scene(&mut random, pair, shape, count, share_true, noise_px);
            let report = estimate_fundamental(&s.p1, &s.p2, &options(seed)).unwrap();
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
            "{share_on_plane} of {count} on the plane, {share_true} true, {noise_px} px: {wrong:?}"
        );
    }
}

#[test]
fn forward_motion() {
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let up = Vector3::new(0.0, -1.0, 0.0);
        let camera = |z: f64| Camera {
            intrinsics: intrinsics(600.0),
            cam_from_world: look_at(&Point3::new(0.0, 0.0, z), &Point3::new(0.0, 0.0, 9.0), &up)
                .unwrap(),
        };
        let pair = (camera(-5.0), camera(-4.0));
        let s = scene(&mut random, pair, Shape::Volume, 300, 0.7, 0.3);
        let (k1, k2) = (&s.cam1.intrinsics, &s.cam2.intrinsics);
        let pose = estimate_relative_pose(&s.p1, &s.p2, k1, k2, &options(seed)).unwrap();
        let motion = pose.model.cam2_from_cam1();
        assert!(rotation_error(&motion, &s.motion()) < 0.002, "{seed}");
        assert!(direction_error(&motion, &s.motion()) < 0.01, "{seed}");
        let f = estimate_fundamental(&s.p1, &s.p2, &options(seed)).unwrap();
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
            let camera = |x: f64, yaw: f64| Camera {
                intrinsics: intrinsics(600.0),
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
                let (k1, k2) = (&s.cam1.intrinsics, &s.cam2.intrinsics);
                for report in [estimate_fundamental(&s.p1, &s.p2, &options(1))] {
                    match report {
                        Ok(report) => assert!(report.model.iter().all(|x| x.is_finite())),
                        Err(error) => assert!(!error.to_string().is_empty()),
                    }
                }
                if let Ok(report) = estimate_relative_pose(&s.p1, &s.p2, k1, k2, &options(1)) {
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
                let report = estimate_two_view_calibrated(&s.p1, &s.p2, k1, k2, &choice).unwrap();
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
    let once = estimate_fundamental(&s.p1, &s.p2, &options(1)).unwrap();
    let often = estimate_fundamental(&p1, &p2, &options(1)).unwrap();
    assert_eq!(once.model, often.model);
    assert_eq!(once.num_inliers, often.num_unique_inliers);
    assert_eq!(once.inliers, often.inliers[..100]);

    // Seven different matches in many copies are seven matches.
    let few: Vec<_> = s.p1[..6].iter().cycle().take(60).copied().collect();
    assert!(matches!(
        estimate_fundamental(&few, &few, &options(1)),
        Err(Error::TooFew { got: 6, .. })
    ));
}

type Points = Vec<Point2<f64>>;

/// A matrix of numbers, of length 1.
fn check_unit(matrix: &Matrix3<f64>) {
    assert!((matrix.norm() - 1.0).abs() < 1e-9, "{matrix}");
}

/// A fundamental or an essential matrix: length 1, rank 2.
fn check_epipolar(matrix: &Matrix3<f64>) {
    check_unit(matrix);
    let values = matrix.singular_values();
    assert!(values[2] < 1e-9, "{values}");
}

fn check_rotation(rotation: &Matrix3<f64>) {
    let off = (rotation.transpose() * rotation - Matrix3::identity()).norm();
    assert!(off < 1e-9 && rotation.determinant() > 0.0, "{rotation}");
}

/// The inliers are those that a report counts and whose errors are within the threshold.
fn check_report<M>(report: &RansacReport<M>, options: &RansacOptions, errors_px: &[f64]) {
    assert!((1..=options.max_iterations).contains(&report.iterations));
    assert!(report.required_iterations >= 1);
    assert_eq!(report.inliers.len(), errors_px.len());
    let count = report.inliers.iter().filter(|inlier| **inlier).count();
    assert_eq!(count, report.num_inliers);
    assert!((1..=count).contains(&report.num_unique_inliers));
    let num_data = errors_px.len() as f64;
    assert!((0.0..=num_data).contains(&report.score), "{}", report.score);
    for (error_px, inlier) in errors_px.iter().zip(&report.inliers) {
        // At the threshold rounding decides.
        let (near, far) = (0.999 * options.max_error_px, 1.001 * options.max_error_px);
        assert!(!inlier || *error_px < far, "{error_px}");
        assert!(
            *inlier || error_px.is_nan() || *error_px > near,
            "{error_px}"
        );
    }
}

fn check_two_view(report: &TwoViewReport, num_matches: usize, options: &TwoViewOptions) {
    match &report.model {
        TwoViewModel::Fundamental(matrix) | TwoViewModel::Essential(matrix) => {
            check_epipolar(matrix);
        }
        TwoViewModel::Homography(matrix) => check_unit(matrix),
    }
    report.fundamental.iter().for_each(check_epipolar);
    report.homography.iter().for_each(check_unit);
    assert_eq!(report.inliers.len(), num_matches);
    let count = report.inliers.iter().filter(|inlier| **inlier).count();
    assert_eq!(count, report.num_inliers);
    // At most four models are tried.
    assert!((1..=4 * options.ransac.max_iterations).contains(&report.iterations));
    if let Some(motion) = &report.cam2_from_cam1 {
        check_rotation(motion.rotation.to_rotation_matrix().matrix());
        let length = motion.translation.vector.norm();
        let turned = matches!(report.configuration, Configuration::Panoramic);
        assert!(length == 0.0 || (length - 1.0).abs() < 1e-9, "{length}");
        assert!(!turned || length == 0.0, "{length}");
    }
    if let Some(angle) = report.median_triangulation_angle_rad {
        assert!((0.0..=std::f64::consts::PI).contains(&angle), "{angle}");
    }
}

/// Every estimator on one pair of lists: no panic, no endless loop, and whatever is found is what
/// it is said to be.
fn try_everything(p1: &Points, p2: &Points) -> Vec<Option<Error>> {
    let k = intrinsics(600.0);
    let budget = RansacOptions {
        max_iterations: 500,
        ..RansacOptions::default()
    };
    let points: Vec<_> = p1.iter().map(|p| Point3::new(p.x, p.y, 900.0)).collect();
    let errors_px = |error: &dyn Fn(&Point2<f64>, &Point2<f64>) -> f64| -> Vec<f64> {
        p1.iter().zip(p2).map(|(a, b)| error(a, b)).collect()
    };
    let mut errors = Vec::new();
    let mut note = |result: Result<(), Error>| errors.push(result.err());
    note(estimate_fundamental(p1, p2, &budget).map(|r| {
        check_epipolar(&r.model);
        check_report(&r, &budget, &errors_px(&|a, b| sampson_px(&r.model, a, b)));
    }));
    note(estimate_homography(p1, p2, &budget).map(|r| {
        check_unit(&r.model);
        check_report(
            &r,
            &budget,
            &errors_px(&|a, b| transfer_error_px(&r.model, a, b)),
        );
    }));
    note(estimate_relative_pose(p1, p2, &k, &k, &budget).map(|r| {
        let pose = &r.model;
        check_rotation(&pose.rotation);
        assert!((pose.direction.norm() - 1.0).abs() < 1e-9);
        check_epipolar(&pose.fundamental);
        check_epipolar(&pose.essential());
        check_report(
            &r,
            &budget,
            &errors_px(&|a, b| sampson_px(&pose.fundamental, a, b)),
        );
    }));
    note(estimate_similarity(p1, p2, &budget).map(|r| {
        let matrix = r.model.matrix();
        assert!(matrix.iter().all(|x| x.is_finite()), "{matrix}");
        check_report(
            &r,
            &budget,
            &errors_px(&|a, b| (r.model.apply(a) - b).norm()),
        );
    }));
    note(estimate_absolute_pose(&points, p2, &k, &budget).map(|r| {
        check_rotation(r.model.rotation.to_rotation_matrix().matrix());
        let center = r.model.inverse().translation.vector;
        assert!(center.iter().all(|x| x.is_finite()), "{center}");
        let camera = Camera {
            intrinsics: k,
            cam_from_world: r.model,
        };
        let errors: Vec<f64> = (points.iter().zip(p2))
            .map(|(point, pixel)| match camera.project(point) {
                Ok(seen) => (seen - pixel).norm(),
                Err(_) => f64::INFINITY,
            })
            .collect();
        check_report(&r, &budget, &errors);
    }));
    let choice = TwoViewOptions {
        ransac: budget,
        ..TwoViewOptions::default()
    };
    note(estimate_two_view(p1, p2, &choice).map(|r| check_two_view(&r, p1.len(), &choice)));
    note(
        estimate_two_view_calibrated(p1, p2, &k, &k, &choice)
            .map(|r| check_two_view(&r, p1.len(), &choice)),
    );
    errors
}

#[test]
fn bad_input_is_an_error_for_everyone() {
    let mut random = Random::new(9);
    let cloud = |random: &mut Random, n: usize| -> Points {
        (0..n)
            .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
            .collect()
    };
    let (a, b) = (cloud(&mut random, 40), cloud(&mut random, 40));
    let same = vec![Point2::new(5.0, 5.0); 40];
    let mut bad = a.clone();
    bad[17].y = f64::NAN;
    for (p1, p2) in [
        (&vec![], &vec![]),
        (&a[..1].to_vec(), &b[..1].to_vec()),
        (&same, &same),
        (&bad, &b),
        (&b, &bad),
        (&a, &b[..30].to_vec()),
    ] {
        for error in try_everything(p1, p2) {
            let sentence = error.expect("bad input must be refused").to_string();
            assert!(sentence.len() > 10);
        }
    }
    // Lines: F, E and H are open, a similarity is not.
    let line: Points = (0..40)
        .map(|i| Point2::new(f64::from(i) * 7.0, 2.0 * f64::from(i)))
        .collect();
    let errors = try_everything(&line, &line);
    for (i, name) in ["F", "H", "E"].iter().enumerate() {
        assert!(errors[i].is_some(), "{name}");
    }
    assert!(errors[3].is_none());
    // One image on a line only.
    let errors = try_everything(&line, &a);
    assert!(errors[0].is_some() && errors[2].is_some());
}

/// One match at infinity, or where no image reaches, is no reason to refuse the others; every room finds what it
/// finds without it, and says that it was left out.
#[test]
fn a_match_beyond_all_images_is_left_out() {
    let mut random = Random::new(21);
    let pair = cameras(&mut random);
    let s = scene(&mut random, pair, Shape::Volume, 200, 0.8, 0.3);
    let k = Intrinsics::centered(700.0, 640, 480).unwrap();
    let options = options(1);
    let choice = TwoViewOptions {
        ransac: options,
        ..TwoViewOptions::default()
    };
    for far in [f64::INFINITY, f64::NEG_INFINITY, 1e200, -2e9] {
        for place in [0, 100] {
            let (mut p1, mut p2) = (s.p1.clone(), s.p2.clone());
            p1.insert(place, Point2::new(100.0, far));
            p2.insert(place, Point2::new(200.0, 100.0));
            let check = |inliers: &[bool], without: &[bool], num_left_out: usize| {
                assert_eq!(num_left_out, 1, "{far}");
                let mut expected = without.to_vec();
                expected.insert(place, false);
                assert_eq!(inliers, expected, "{far}");
            };
            let (with, without) = (
                estimate_fundamental(&p1, &p2, &options).unwrap(),
                estimate_fundamental(&s.p1, &s.p2, &options).unwrap(),
            );
            assert_eq!(with.model, without.model);
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_homography(&p1, &p2, &options).unwrap(),
                estimate_homography(&s.p1, &s.p2, &options).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_relative_pose(&p1, &p2, &k, &k, &options).unwrap(),
                estimate_relative_pose(&s.p1, &s.p2, &k, &k, &options).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_similarity(&p1, &p2, &options).unwrap(),
                estimate_similarity(&s.p1, &s.p2, &options).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_two_view(&p1, &p2, &choice).unwrap(),
                estimate_two_view(&s.p1, &s.p2, &choice).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_two_view_calibrated(&p1, &p2, &k, &k, &choice).unwrap(),
                estimate_two_view_calibrated(&s.p1, &s.p2, &k, &k, &choice).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
        }
    }
}

/// Matches that have nothing to do with each other: the report says so.
#[test]
fn nothing_but_outliers() {
    let mut random = Random::new(13);
    let mut cloud = || -> Points {
        (0..300)
            .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
            .collect()
    };
    let (a, b) = (cloud(), cloud());
    let options = RansacOptions {
        max_iterations: 2000,
        ..RansacOptions::default()
    };
    let report = estimate_fundamental(&a, &b, &options).unwrap();
    assert!(report.num_inliers < 30);
    assert_eq!(report.stop, StopReason::Exhausted);
    assert!(report.required_iterations > 100_000);
    let report = estimate_homography(&a, &b, &options).unwrap();
    assert!(report.num_inliers < 15);
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
            let options = RansacOptions {
                sampler,
                min_iterations: 1,
                max_iterations: 100_000,
                ..options(seed)
            };
            estimate_fundamental(p1, p2, &options).unwrap()
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

/// Matches that lead to one pixel by the dozen, as of a nearest neighbor for everything, do not draw
/// the epipole there.
#[test]
fn a_crowded_pixel_has_few_votes() {
    for (share_crowded, seed) in (0..10).flat_map(|seed| [(0.3, seed), (0.5, seed), (0.6, seed)]) {
        let mut random = Random::new(seed);
        let pair = cameras(&mut random);
        let mut s = scene(
            &mut random,
            pair,
            Shape::Volume,
            200,
            1.0 - share_crowded,
            0.5,
        );
        let num_true = s.truth.iter().filter(|&&is_true| is_true).count();
        for (p2, is_true) in s.p2.iter_mut().zip(&s.truth) {
            if !is_true {
                *p2 = Point2::new(300.0, 200.0);
            }
        }
        let (k1, k2) = (&s.cam1.intrinsics, &s.cam2.intrinsics);
        let f = estimate_fundamental(&s.p1, &s.p2, &options(seed)).unwrap();
        let e = estimate_relative_pose(&s.p1, &s.p2, k1, k2, &options(seed)).unwrap();
        for inliers in [&f.inliers, &e.inliers] {
            let found = inliers.iter().zip(&s.truth).filter(|(a, b)| **a && **b);
            let found = found.count();
            assert!(10 * found > 8 * num_true, "{share_crowded} {seed}: {found}");
        }
        assert!(f.num_unique_inliers <= num_true + 1 && !f.could_be_chance());
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
    let report = estimate_fundamental(&points(&u), &points(&v), &RansacOptions::default());
    assert!(
        matches!(report, Err(Error::NoConsensus { .. })),
        "{report:?}"
    );
}

#[test]
fn equal_seeds_give_equal_bits() {
    let mut random = Random::new(17);
    let pair = cameras(&mut random);
    let s = scene(&mut random, pair, Shape::Volume, 200, 0.6, 0.5);
    let (k1, k2) = (&s.cam1.intrinsics, &s.cam2.intrinsics);
    let mut different = 0;
    for seed in 0..5 {
        let one = estimate_fundamental(&s.p1, &s.p2, &options(seed)).unwrap();
        assert_eq!(
            one,
            estimate_fundamental(&s.p1, &s.p2, &options(seed)).unwrap()
        );
        let e = estimate_relative_pose(&s.p1, &s.p2, k1, k2, &options(seed)).unwrap();
        assert_eq!(
            e,
            estimate_relative_pose(&s.p1, &s.p2, k1, k2, &options(seed)).unwrap()
        );
        let other = estimate_fundamental(&s.p1, &s.p2, &options(seed + 100)).unwrap();
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
        turn in prop::array::uniform3(-3.0_f64..3.0),
        shift in prop::array::uniform3(-50.0_f64..50.0),
    ) {
        let mut random = Random::new(seed);
        let pair = cameras(&mut random);
        let s = scene(&mut random, pair, Shape::Volume, 40, 1.0, 0.0);
        let truth = fundamental_from_cameras(&s.cam1, &s.cam2).unwrap();

        let motion = RigidTransform::new(Vector3::from(shift), Vector3::from(turn));
        let moved = |c: &Camera| Camera {
            cam_from_world: c.cam_from_world * motion.inverse(),
            ..*c
        };
        let again = fundamental_from_cameras(&moved(&s.cam1), &moved(&s.cam2)).unwrap();
        prop_assert!(same_up_to_sign(&truth, &again) < 1e-9);

        let find = |p1: &Points, p2: &Points| estimate_fundamental(p1, p2, &options(seed)).unwrap();
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
            &RansacOptions { max_error_px: factor, ..options(seed) },
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
        let there = estimate_homography(&p1, &p2, &options(seed)).unwrap().model;
        let back = estimate_homography(&p2, &p1, &options(seed)).unwrap().model;
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
