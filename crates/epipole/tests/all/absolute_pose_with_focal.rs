//! The pose and the focal length of a camera from points in space and on planes, with wrong ones
//! among them.

use epipole::Error;
use epipole::absolute_pose::{estimate_absolute_pose, estimate_absolute_pose_and_focal};
use epipole::camera::{Camera, Intrinsics, RigidTransform, look_at};
use epipole::math::random::Random;
use epipole::robust::RansacOptions;
use nalgebra::{Point2, Point3, Vector3};

const CENTER: Point2<f64> = Point2::new(330.0, 235.0);

struct Scene {
    pose: RigidTransform,
    k: Intrinsics,
    points: Vec<Point3<f64>>,
    pixels: Vec<Point2<f64>>,
}

/// * `depth`: how thick the cloud of points is, 0 for a plane
fn scene(seed: u64, depth: f64, noise_px: f64, wrong: f64) -> Scene {
    let mut random = Random::new(seed);
    let focal_px = 400.0 * libm::exp(random.uniform(0.0, 1.6));
    let k = Intrinsics::new(focal_px, focal_px, CENTER.x, CENTER.y).unwrap();
    // As far away as the focal length needs, and never straight in front of the plane.
    let side = if random.uniform(-1.0, 1.0) > 0.0 {
        1.0
    } else {
        -1.0
    };
    let direction = Vector3::new(
        side * random.uniform(0.6, 1.2),
        random.uniform(-0.8, 0.8),
        -1.0,
    );
    let center = Point3::from(direction.normalize() * (focal_px / 130.0));
    let pose = look_at(&center, &Point3::origin(), &Vector3::new(0.1, -1.0, 0.0)).unwrap();
    let (mut points, mut pixels) = (Vec::new(), Vec::new());
    while points.len() < 120 {
        let mut any = |size: f64| random.uniform(-size, size);
        let x = Point3::new(any(1.5), any(1.2), any(1.0) * depth);
        let Ok(p) = k.project(&(pose * x)) else {
            continue;
        };
        let p = if random.uniform(0.0, 1.0) < wrong {
            Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0))
        } else {
            Point2::new(
                p.x + noise_px * random.normal(),
                p.y + noise_px * random.normal(),
            )
        };
        points.push(x);
        pixels.push(p);
    }
    Scene {
        pose,
        k,
        points,
        pixels,
    }
}

/// Relative error of the focal length, and error of the camera's center relative to its distance
/// from the points.
fn errors(scene: &Scene, focal_px: f64, pose: &RigidTransform) -> (f64, f64) {
    let center = |pose: &RigidTransform| pose.inverse().translation.vector;
    let distance = center(&scene.pose).norm();
    (
        (focal_px / scene.k.fu_px() - 1.0).abs(),
        (center(pose) - center(&scene.pose)).norm() / distance,
    )
}

#[test]
fn half_of_the_points_are_wrong() {
    let options = RansacOptions::default().with_max_error_px(3.0);
    for depth in [1.0, 0.0] {
        let (mut focals, mut centers, mut as_good) = (Vec::new(), Vec::new(), 0);
        for seed in 0..60 {
            let scene = scene(seed, depth, 0.5, 0.5);
            let (points, pixels) = (&scene.points, &scene.pixels);
            let report =
                estimate_absolute_pose_and_focal(points, pixels, &CENTER, &options, &mut ())
                    .unwrap();
            let known = estimate_absolute_pose(
                points,
                pixels,
                &Camera::pinhole(scene.k, 640, 480),
                &options,
                &mut (),
            )
            .unwrap();
            as_good += usize::from(report.num_inliers + 3 >= known.num_inliers);
            let (focal, center) =
                errors(&scene, report.model.focal_px, &report.model.cam_from_world);
            focals.push(focal);
            centers.push(center);
            // The reported standard deviation holds: errors stay below five of them.
            let std_px = report.model.focal_std_px.unwrap();
            let off_px = (report.model.focal_px - scene.k.fu_px()).abs();
            assert!(
                off_px < 5.0 * std_px,
                "seed {seed}: {off_px} px, {std_px} px"
            );
        }
        for list in [&mut focals, &mut centers] {
            list.sort_by(f64::total_cmp);
        }
        println!(
            "depth {depth}: focal length off by {:.4}, {:.4} at most; center {:.4}",
            focals[30], focals[59], centers[30]
        );
        assert!(as_good >= 59, "{as_good}");
        assert!(focals[30] < 0.02 && focals[55] < 0.1, "{focals:?}");
        assert!(centers[30] < 0.02, "{centers:?}");
    }
}

#[test]
fn exact_points_give_the_truth() {
    for depth in [1.0, 0.0] {
        for seed in 0..20 {
            let scene = scene(seed, depth, 0.0, 0.3);
            let options = RansacOptions::default().with_seed(seed);
            let report = estimate_absolute_pose_and_focal(
                &scene.points,
                &scene.pixels,
                &CENTER,
                &options,
                &mut (),
            )
            .unwrap();
            let found = errors(&scene, report.model.focal_px, &report.model.cam_from_world);
            assert!(found.0 < 1e-4 && found.1 < 1e-4, "{found:?}");
            assert!(report.model.constrains_focal());
        }
    }
}

/// A plane that faces the camera looks the same from every distance with its focal length.
#[test]
fn a_frontal_plane_determines_no_focal_length() {
    let mut random = Random::new(3);
    let k = Intrinsics::new(700.0, 700.0, CENTER.x, CENTER.y).unwrap();
    let (mut points, mut pixels) = (Vec::new(), Vec::new());
    for _ in 0..100 {
        let x = Point3::new(random.uniform(-1.0, 1.0), random.uniform(-0.7, 0.7), 5.0);
        let p = k.project(&x).unwrap();
        points.push(x);
        pixels.push(Point2::new(
            p.x + 0.5 * random.normal(),
            p.y + 0.5 * random.normal(),
        ));
    }
    match estimate_absolute_pose_and_focal(
        &points,
        &pixels,
        &CENTER,
        &RansacOptions::default(),
        &mut (),
    ) {
        Ok(report) => assert!(!report.model.constrains_focal(), "{:?}", report.model),
        Err(error) => assert!(matches!(error, Error::NoConsensus { .. }), "{error}"),
    }
}

#[test]
fn bad_input_is_refused() {
    let scene = scene(1, 1.0, 0.5, 0.0);
    let options = RansacOptions::default();
    let run = |points: &[Point3<f64>], pixels: &[Point2<f64>], center: &Point2<f64>| {
        estimate_absolute_pose_and_focal(points, pixels, center, &options, &mut ())
    };
    let (points, pixels) = (&scene.points, &scene.pixels);
    assert!(matches!(
        run(&points[..4], &pixels[..4], &CENTER),
        Err(Error::TooFew { .. })
    ));
    assert!(matches!(
        run(&points[..9], &pixels[..8], &CENTER),
        Err(Error::SizeMismatch { .. })
    ));
    let nowhere = Point2::new(f64::NAN, 0.0);
    assert!(matches!(
        run(points, pixels, &nowhere),
        Err(Error::NotFinite { .. })
    ));
    let mut holed = points.clone();
    holed[7].y = f64::NAN;
    assert!(matches!(
        run(&holed, pixels, &CENTER),
        Err(Error::NotFinite { .. })
    ));
    // One at infinity is left out.
    holed[7].y = f64::INFINITY;
    let report = run(&holed, pixels, &CENTER).unwrap();
    assert_eq!((report.num_left_out, report.inliers[7]), (1, false));
    let line: Vec<_> = (0..50)
        .map(|i| Point3::new(f64::from(i), 2.0 * f64::from(i), 90.0 - f64::from(i)))
        .collect();
    let line_pixels: Vec<_> = line.iter().map(|x| scene.k.project(x).unwrap()).collect();
    assert!(matches!(
        run(&line, &line_pixels, &CENTER),
        Err(Error::NoConsensus { .. })
    ));
}

/// A few wrong pixels far outside of the image take no focal length from the plausible ones.
#[test]
fn far_pixels_do_not_move_the_focal_length() {
    for seed in 0..10 {
        let mut scene = scene(seed, 1.0, 0.0, 0.0);
        scene.points.truncate(50);
        scene.pixels.truncate(50);
        for i in 0..5 {
            scene.pixels[i * 7] = Point2::new(20_000.0 + 300.0 * i as f64, 40.0 * i as f64);
        }
        let options = RansacOptions::default();
        let report = estimate_absolute_pose_and_focal(
            &scene.points,
            &scene.pixels,
            &CENTER,
            &options,
            &mut (),
        )
        .unwrap();
        let ratio = report.model.focal_px / scene.k.fu_px();
        assert!((ratio - 1.0).abs() < 1e-3, "{seed}: {ratio}");
        assert_eq!(report.num_inliers, 45, "{seed}");
    }
}
