//! Which of F, E and H a pair is, and whether it is a pair at all.

use super::scene::{
    Scene, Shape, cameras, direction_error, intrinsics, options, rotation_error, scene,
};
use epipole::camera::{Camera, RigidTransform};
use epipole::epipolar::{
    decompose_essential, essential_from_fundamental, essential_from_motion,
    fundamental_from_essential, sampson_px, select_pose,
};
use epipole::math::random::Random;
use epipole::robust::estimate_similarity;
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, estimate_two_view_calibrated,
};
use epipole::{
    estimate_absolute_pose, estimate_fundamental, estimate_homography, estimate_two_view,
};
use nalgebra::{Point2, Point3, Vector3};

/// The same source: planar and panoramic pairs are recognized, with noise and outliers; also where
/// the noise fills the threshold, half a pixel against one.
#[test]
fn configurations_are_recognized() {
    // A plane alone leaves two motions.
    let (mut planes, mut one_of_two) = (0, 0);
    // Sixty true matches of 200 with .7 px of noise leave the motion of one pair in forty farther
    // off than that: seven of 300 seeds.
    let mut generals = 0;
    for (max_error_px, noise_px, true_ratio) in [
        (1.0, 0.3, 0.7),
        (1.0, 0.5, 0.7),
        (1.5, 0.3, 0.7),
        (2.0, 0.7, 0.3),
        (2.0, 1.0, 0.7),
    ] {
        for seed in 0..20 {
            let mut random = Random::new(seed);
            let pair = cameras(&mut random);
            let (k1, k2) = (pair.0.camera.intrinsics, pair.1.camera.intrinsics);
            let two_view = |s: &Scene| {
                let options = TwoViewOptions::default()
                    .with_ransac(options(seed).with_max_error_px(max_error_px));
                (
                    estimate_two_view_calibrated(
                        &s.p1,
                        &s.p2,
                        [
                            &Camera::pinhole(k1, 640, 480),
                            &Camera::pinhole(k2, 640, 480),
                        ],
                        &options,
                        &mut (),
                    )
                    .unwrap(),
                    estimate_two_view(&s.p1, &s.p2, &options, &mut ()).unwrap(),
                )
            };
            let context = format!("{max_error_px} px, noise {noise_px} px, seed {seed}");
            let close = |motion: &RigidTransform, truth: &RigidTransform| {
                rotation_error(motion, truth) < 0.03 && direction_error(motion, truth) < 0.1
            };
            let general = scene(&mut random, pair, Shape::Volume, 200, true_ratio, noise_px);
            let (calibrated, uncalibrated) = two_view(&general);
            assert_eq!(
                calibrated.configuration,
                Configuration::General,
                "{context}"
            );
            assert_eq!(
                uncalibrated.configuration,
                Configuration::General,
                "{context}"
            );
            let motion = calibrated.cam2_from_cam1.unwrap();
            let truth = general.motion();
            generals += usize::from(close(&motion, &truth));
            // A motion farther off must fit the matches better than the truth does.
            let misfit = |motion: &RigidTransform| -> f64 {
                let e = essential_from_motion(motion).unwrap();
                let f = fundamental_from_essential(&e, &k1, &k2).unwrap();
                let pairs = general.p1.iter().zip(&general.p2);
                let errors = pairs.map(|(p1, p2)| sampson_px(&f, p1, p2) / max_error_px);
                errors.map(|error| (error * error).min(1.0)).sum()
            };
            assert!(
                close(&motion, &truth) || misfit(&motion) < misfit(&truth),
                "{context}"
            );
            assert_eq!(calibrated.other_cam2_from_cam1, None);

            let plane = scene(&mut random, pair, Shape::Plane, 200, true_ratio, noise_px);
            let (calibrated, uncalibrated) = two_view(&plane);
            assert_eq!(calibrated.configuration, Configuration::Planar, "{context}");
            assert_eq!(
                uncalibrated.configuration,
                Configuration::Planar,
                "{context}"
            );
            let motions = [calibrated.cam2_from_cam1, calibrated.other_cam2_from_cam1];
            let truth = plane.motion();
            planes += 1;
            one_of_two += usize::from(motions.iter().flatten().any(|m| close(m, &truth)));

            let mut rotated = pair;
            let center = rotated.0.center_in_world();
            rotated.1.cam_from_world.translation.vector =
                -(rotated.1.cam_from_world.rotation * center.coords);
            let rotation_only = scene(
                &mut random,
                rotated,
                Shape::Volume,
                200,
                true_ratio,
                noise_px,
            );
            let (calibrated, uncalibrated) = two_view(&rotation_only);
            assert_eq!(
                calibrated.configuration,
                Configuration::Panoramic,
                "{context}"
            );
            let motion = calibrated.cam2_from_cam1.unwrap();
            assert_eq!(motion.translation.vector, Vector3::zeros());
            assert!(
                rotation_error(&motion, &rotation_only.motion()) < 0.005,
                "{context}"
            );
            // Without intrinsics a rotation looks like a plane.
            assert_eq!(
                uncalibrated.configuration,
                Configuration::Planar,
                "{context}"
            );
        }
    }
    println!("of {planes} planes one of two motions was right for {one_of_two}");
    assert!(20 * one_of_two >= 19 * planes, "{one_of_two} of {planes}");
    assert!(50 * generals >= 49 * planes, "{generals} of {planes}");
}

/// Matches that have nothing to do with one another agree by the dozen if there are thousands of
/// them; that is no pair.
#[test]
fn random_matches_are_no_pair() {
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
            let choice = TwoViewOptions::default().with_ransac(
                options(seed)
                    .with_max_error_px(max_error_px)
                    .with_max_iterations(2000),
            );
            let calibrated = estimate_two_view_calibrated(
                &a,
                &b,
                [&Camera::pinhole(k, 640, 480); 2],
                &choice,
                &mut (),
            )
            .unwrap();
            assert_eq!(calibrated.configuration, Configuration::Degenerate);
            assert_eq!(calibrated.cam2_from_cam1, None);
            let uncalibrated = estimate_two_view(&a, &b, &choice, &mut ()).unwrap();
            assert_eq!(uncalibrated.configuration, Configuration::Degenerate);
            assert!(
                estimate_fundamental(&a, &b, &choice.ransac, &mut ())
                    .unwrap()
                    .could_be_random()
            );
            assert!(
                estimate_homography(&a, &b, &choice.ransac, &mut ())
                    .unwrap()
                    .could_be_random()
            );
            assert!(
                estimate_similarity(&a, &b, &choice.ransac, &mut ())
                    .unwrap()
                    .could_be_random()
            );
            let points: Vec<_> = a
                .iter()
                .map(|p| Point3::new(p.x / 100.0, p.y / 100.0, random.uniform(4.0, 9.0)))
                .collect();
            let pose = estimate_absolute_pose(
                &points,
                &b,
                &Camera::pinhole(k, 640, 480),
                &choice.ransac,
                &mut (),
            );
            assert!(pose.is_err() || pose.unwrap().could_be_random());
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
        let (k1, k2) = (pair.0.camera.intrinsics, pair.1.camera.intrinsics);
        let choose = TwoViewOptions::default()
            .with_ransac(options(seed))
            // E cannot have twice F's inliers.
            .with_min_essential_ratio(2.0);
        let found = estimate_two_view_calibrated(
            &scene.p1,
            &scene.p2,
            [
                &Camera::pinhole(k1, 640, 480),
                &Camera::pinhole(k2, 640, 480),
            ],
            &choose,
            &mut (),
        )
        .unwrap();
        assert!(matches!(found.model, TwoViewModel::Fundamental(_)));
        let motion = found.cam2_from_cam1.unwrap();
        let truth = scene.motion();
        by_e.push(direction_error(&motion, &truth));
        assert!(rotation_error(&motion, &truth) < 0.01 && by_e[by_e.len() - 1] < 0.05);
        // Decomposition of the chosen F, for comparison.
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
