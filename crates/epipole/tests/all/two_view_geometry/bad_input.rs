//! Bad input: an error for everyone, and what is found is what it is said to be.

use super::scene::{Points, Shape, cameras, intrinsics, options, scene};
use epipole::camera::{Camera, Intrinsics, PosedCamera};
use epipole::epipolar::sampson_px;
use epipole::homography::transfer_error_px;
use epipole::math::random::Random;
use epipole::robust::{RansacOptions, RansacReport, StopReason, estimate_similarity};
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view_calibrated,
};
use epipole::{
    Error, estimate_absolute_pose, estimate_fundamental, estimate_homography,
    estimate_relative_pose, estimate_two_view,
};
use nalgebra::{Matrix3, Point2, Point3};

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
        let is_panoramic = matches!(report.configuration, Configuration::Panoramic);
        assert!(length == 0.0 || (length - 1.0).abs() < 1e-9, "{length}");
        assert!(!is_panoramic || length == 0.0, "{length}");
    }
    if let Some(angle) = report.median_triangulation_angle_rad {
        assert!((0.0..=std::f64::consts::PI).contains(&angle), "{angle}");
    }
}

/// Every estimator on one pair of lists: no panic, no endless loop, and whatever is found is what
/// it is said to be.
fn errors_of_all(p1: &Points, p2: &Points) -> Vec<Option<Error>> {
    let k = intrinsics(600.0);
    let budget = RansacOptions::default().with_max_iterations(500);
    let points: Vec<_> = p1.iter().map(|p| Point3::new(p.x, p.y, 900.0)).collect();
    let errors_px = |error: &dyn Fn(&Point2<f64>, &Point2<f64>) -> f64| -> Vec<f64> {
        p1.iter().zip(p2).map(|(a, b)| error(a, b)).collect()
    };
    let mut errors = Vec::new();
    let mut note = |result: Result<(), Error>| errors.push(result.err());
    note(estimate_fundamental(p1, p2, &budget, &mut ()).map(|r| {
        check_epipolar(&r.model);
        check_report(&r, &budget, &errors_px(&|a, b| sampson_px(&r.model, a, b)));
    }));
    note(estimate_homography(p1, p2, &budget, &mut ()).map(|r| {
        check_unit(&r.model);
        check_report(
            &r,
            &budget,
            &errors_px(&|a, b| transfer_error_px(&r.model, a, b)),
        );
    }));
    note(
        estimate_relative_pose(p1, p2, [&Camera::pinhole(k, 640, 480); 2], &budget, &mut ()).map(
            |r| {
                let pose = &r.model;
                check_rotation(&pose.rotation);
                assert!((pose.direction.norm() - 1.0).abs() < 1e-9);
                let f = pose.fundamental(&k, &k).unwrap();
                check_epipolar(&f);
                check_epipolar(&pose.essential());
                check_report(&r, &budget, &errors_px(&|a, b| sampson_px(&f, a, b)));
            },
        ),
    );
    note(estimate_similarity(p1, p2, &budget, &mut ()).map(|r| {
        let matrix = r.model.matrix();
        assert!(matrix.iter().all(|x| x.is_finite()), "{matrix}");
        check_report(
            &r,
            &budget,
            &errors_px(&|a, b| (r.model.apply(a) - b).norm()),
        );
    }));
    note(
        estimate_absolute_pose(&points, p2, &Camera::pinhole(k, 640, 480), &budget, &mut ()).map(
            |r| {
                check_rotation(r.model.rotation.to_rotation_matrix().matrix());
                let center = r.model.inverse().translation.vector;
                assert!(center.iter().all(|x| x.is_finite()), "{center}");
                let camera = PosedCamera {
                    camera: Camera::pinhole(k, 640, 480),
                    cam_from_world: r.model,
                };
                let errors: Vec<f64> = (points.iter().zip(p2))
                    .map(|(point, pixel)| match camera.project(point) {
                        Ok(projected) => (projected - pixel).norm(),
                        Err(_) => f64::INFINITY,
                    })
                    .collect();
                check_report(&r, &budget, &errors);
            },
        ),
    );
    let choice = TwoViewOptions::default().with_ransac(budget);
    note(
        estimate_two_view(p1, p2, &choice, &mut ()).map(|r| check_two_view(&r, p1.len(), &choice)),
    );
    note(
        estimate_two_view_calibrated(p1, p2, [&Camera::pinhole(k, 640, 480); 2], &choice, &mut ())
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
        for error in errors_of_all(p1, p2) {
            let sentence = error.expect("bad input must be refused").to_string();
            assert!(sentence.len() > 10);
        }
    }
    // Lines: F, E and H are open, a similarity is not.
    let line: Points = (0..40)
        .map(|i| Point2::new(f64::from(i) * 7.0, 2.0 * f64::from(i)))
        .collect();
    let errors = errors_of_all(&line, &line);
    for (i, name) in ["F", "H", "E"].iter().enumerate() {
        assert!(errors[i].is_some(), "{name}");
    }
    assert!(errors[3].is_none());
    // One image on a line only.
    let errors = errors_of_all(&line, &a);
    assert!(errors[0].is_some() && errors[2].is_some());
}

/// One match at infinity, or where no image reaches, is no reason to refuse the others; every room
/// finds what it finds without it, and says that it was left out.
#[test]
fn a_match_beyond_all_images_is_left_out() {
    let mut random = Random::new(21);
    let pair = cameras(&mut random);
    let s = scene(&mut random, pair, Shape::Volume, 200, 0.8, 0.3);
    let k = Intrinsics::centered(700.0, 640, 480).unwrap();
    let options = options(1);
    let choice = TwoViewOptions::default().with_ransac(options);
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
                estimate_fundamental(&p1, &p2, &options, &mut ()).unwrap(),
                estimate_fundamental(&s.p1, &s.p2, &options, &mut ()).unwrap(),
            );
            assert_eq!(with.model, without.model);
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_homography(&p1, &p2, &options, &mut ()).unwrap(),
                estimate_homography(&s.p1, &s.p2, &options, &mut ()).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_relative_pose(
                    &p1,
                    &p2,
                    [&Camera::pinhole(k, 640, 480); 2],
                    &options,
                    &mut (),
                )
                .unwrap(),
                estimate_relative_pose(
                    &s.p1,
                    &s.p2,
                    [&Camera::pinhole(k, 640, 480); 2],
                    &options,
                    &mut (),
                )
                .unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_similarity(&p1, &p2, &options, &mut ()).unwrap(),
                estimate_similarity(&s.p1, &s.p2, &options, &mut ()).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_two_view(&p1, &p2, &choice, &mut ()).unwrap(),
                estimate_two_view(&s.p1, &s.p2, &choice, &mut ()).unwrap(),
            );
            check(&with.inliers, &without.inliers, with.num_left_out);
            let (with, without) = (
                estimate_two_view_calibrated(
                    &p1,
                    &p2,
                    [&Camera::pinhole(k, 640, 480); 2],
                    &choice,
                    &mut (),
                )
                .unwrap(),
                estimate_two_view_calibrated(
                    &s.p1,
                    &s.p2,
                    [&Camera::pinhole(k, 640, 480); 2],
                    &choice,
                    &mut (),
                )
                .unwrap(),
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
    let options = RansacOptions::default().with_max_iterations(2000);
    let report = estimate_fundamental(&a, &b, &options, &mut ()).unwrap();
    assert!(report.num_inliers < 30);
    assert_eq!(report.stop, StopReason::Exhausted);
    assert!(report.required_iterations > 100_000);
    let report = estimate_homography(&a, &b, &options, &mut ()).unwrap();
    assert!(report.num_inliers < 15);
}
