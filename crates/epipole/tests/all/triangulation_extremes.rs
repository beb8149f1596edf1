//! Triangulation in any unit of length, and with a view that is wrong.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::math::random::Random;
use epipole::optim::RobustLoss;
use epipole::triangulation::{
    triangulate_dlt, triangulate_nview, triangulate_nview_dlt, triangulate_optimal,
};
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

/// Cameras side by side, half a unit apart, turned at random by up to 0.15 radians.
fn row_of_cameras(random: &mut Random, count: usize) -> Vec<PosedCamera> {
    let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0).unwrap();
    (0..count)
        .map(|i| {
            let axis = Vector3::from_fn(|_, _| random.normal()).normalize();
            let rotation = UnitQuaternion::from_scaled_axis(axis * random.uniform(0.0, 0.15));
            let center = Vector3::new(i as f64 * 0.5, 0.2 * random.normal(), 0.2 * random.normal());
            PosedCamera {
                camera: Camera::pinhole(intrinsics, 640, 480),
                cam_from_world: RigidTransform::from_parts((-(rotation * center)).into(), rotation),
            }
        })
        .collect()
}

fn point(random: &mut Random) -> Point3<f64> {
    Point3::new(
        random.uniform(-1.0, 3.0),
        random.normal(),
        random.uniform(5.0, 10.0),
    )
}

fn noisy(random: &mut Random, pixel: Point2<f64>, sigma_px: f64) -> Point2<f64> {
    Point2::new(
        pixel.x + sigma_px * random.normal(),
        pixel.y + sigma_px * random.normal(),
    )
}

fn pixels(
    random: &mut Random,
    cameras: &[PosedCamera],
    x: &Point3<f64>,
    sigma: f64,
) -> Vec<Point2<f64>> {
    cameras
        .iter()
        .map(|c| noisy(random, c.project(x).unwrap(), sigma))
        .collect()
}

/// The same cameras in another unit of length.
fn enlarged(cameras: &[PosedCamera], scale: f64) -> Vec<PosedCamera> {
    let mut cameras = cameras.to_vec();
    for camera in &mut cameras {
        camera.cam_from_world.translation.vector *= scale;
    }
    cameras
}

/// A robust loss finds what the right views say, wherever the wrong one points.
#[test]
fn one_wrong_view_does_not_matter() {
    for loss in [
        RobustLoss::Cauchy { width: 1.0 },
        RobustLoss::Truncated { width: 3.0 },
    ] {
        for count in [3, 4, 6, 10, 20] {
            let mut random = Random::new(5);
            let mut close_to_truth = 0;
            for _ in 0..200 {
                let cameras = row_of_cameras(&mut random, count);
                let truth = point(&mut random);
                let mut observed = pixels(&mut random, &cameras, &truth, 0.5);
                let wrong = random.below(count);
                let right = observed[wrong];
                // Clearly wrong: a view that is off by a few pixels may fit where all views do.
                while (observed[wrong] - right).norm() < 20.0 {
                    observed[wrong] = noisy(&mut random, right, 100.0);
                }
                let found = triangulate_nview(&cameras, &observed, loss).unwrap();
                let off = (found.point_in_world - truth).norm();
                close_to_truth += usize::from(off < 0.5);
                // As good a minimum as the right views alone lead to.
                let (mut right_cameras, mut right_observed) = (cameras.clone(), observed.clone());
                right_cameras.remove(wrong);
                right_observed.remove(wrong);
                let right = triangulate_nview(&right_cameras, &right_observed, loss).unwrap();
                let cost = |x: &Point3<f64>| -> f64 {
                    let views = cameras.iter().zip(&observed);
                    let residuals = views.map(|(c, p)| c.project(x).map(|q| q - p));
                    let costs =
                        residuals.map(|r| r.map_or(f64::INFINITY, |r| loss.rho(r.norm_squared())));
                    costs.sum()
                };
                let (ours, theirs) = (cost(&found.point_in_world), cost(&right.point_in_world));
                assert!(ours < theirs + 1e-6, "{loss:?} {count}: {ours} {theirs}");
            }
            // Two views half a unit apart are as good as that, not always better.
            assert!(
                close_to_truth >= 195,
                "{loss:?} {count}: {close_to_truth} of 200"
            );
        }
    }
}

/// Views that are all wrong, or not numbers, are refused as they are with plain least squares.
#[test]
fn views_without_a_point_are_refused_with_every_loss() {
    let mut random = Random::new(6);
    let cameras = row_of_cameras(&mut random, 4);
    let truth = point(&mut random);
    let observed = pixels(&mut random, &cameras, &truth, 0.0);
    let loss = RobustLoss::Truncated { width: 3.0 };
    for bad in [f64::NAN, f64::INFINITY] {
        let mut observed = observed.clone();
        observed[1].x = bad;
        let found = triangulate_nview(&cameras, &observed, loss);
        assert!(matches!(found, Err(Error::NotFinite { .. })), "{found:?}");
    }
    // All rays run apart.
    let apart: Vec<_> = (0..4)
        .map(|i| Point2::new(200.0 * f64::from(i), 240.0))
        .collect();
    let intrinsics = cameras[0].camera.intrinsics;
    let straight: Vec<_> = (0..4)
        .map(|i| PosedCamera {
            camera: Camera::pinhole(intrinsics, 640, 480),
            cam_from_world: RigidTransform::translation(-f64::from(i), 0.0, 0.0),
        })
        .collect();
    let found = triangulate_nview(&straight, &apart, loss);
    assert_eq!(found, Err(Error::PointBehindCamera));
    let parallel = triangulate_nview(&straight, &[Point2::new(320.0, 240.0); 4], loss);
    assert_eq!(parallel, Err(Error::PointAtInfinity));
}

#[test]
fn points_do_not_depend_on_the_unit_of_length() {
    let mut random = Random::new(7);
    for _ in 0..30 {
        let cameras = row_of_cameras(&mut random, 4);
        let truth = point(&mut random);
        let exact = pixels(&mut random, &cameras, &truth, 0.0);
        let observed = pixels(&mut random, &cameras, &truth, 0.5);
        for scale in [1e-100, 1e-30, 1e-12, 1e-6, 1e6, 1e12, 1e30, 1e100] {
            let other = enlarged(&cameras, scale);
            let same = |found: Point3<f64>, expected: &Point3<f64>, tolerance: f64| {
                let off = (found / scale - expected).norm();
                assert!(off < tolerance, "{scale}: off by {off}");
            };
            // The search ends where steps are negligible. One pixel of noise moves a point by 0.01
            // and more.
            for loss in [RobustLoss::Trivial, RobustLoss::Cauchy { width: 1.0 }] {
                let expected = triangulate_nview(&cameras, &observed, loss).unwrap();
                let found = triangulate_nview(&other, &observed, loss).unwrap();
                same(found.point_in_world, &expected.point_in_world, 1e-6);
                assert!((found.rms_error_px - expected.rms_error_px).abs() < 1e-6);
            }
            same(triangulate_nview_dlt(&other, &exact).unwrap(), &truth, 1e-9);
            let (p1, p2) = (other[0].projection_matrix(), other[3].projection_matrix());
            let found = triangulate_dlt(&p1, &p2, &exact[0], &exact[3]).unwrap();
            same(found, &truth, 1e-9);
            let expected =
                triangulate_optimal(&cameras[0], &cameras[3], &observed[0], &observed[3]).unwrap();
            let found =
                triangulate_optimal(&other[0], &other[3], &observed[0], &observed[3]).unwrap();
            same(found, &expected, 1e-9);
        }
    }
}

/// A point at infinity is one that is too many baselines away, in whatever unit.
#[test]
fn parallel_rays_are_parallel_in_every_unit() {
    let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0).unwrap();
    let center = Point2::new(320.0, 240.0);
    for scale in [1e-100, 1e-15, 1e-12, 1.0, 1e12, 1e15, 1e100] {
        let camera = |x: f64| PosedCamera {
            camera: Camera::pinhole(intrinsics, 640, 480),
            cam_from_world: RigidTransform::translation(-x * scale, 0.0, 0.0),
        };
        let cameras = [camera(0.0), camera(1.0)];
        let [p1, p2] = [0, 1].map(|i| cameras[i].projection_matrix());
        // A disparity of 700 / 10¹³ pixels would be 10¹³ baselines away.
        for (disparity_px, expected) in [
            (0.0, Err(Error::PointAtInfinity)),
            (70.0, Ok(10.0)),
            (7e-4, Ok(1e6)),
        ] {
            let observed = [center, Point2::new(320.0 - disparity_px, 240.0)];
            for found in [
                triangulate_dlt(&p1, &p2, &observed[0], &observed[1]),
                triangulate_nview_dlt(&cameras, &observed),
                triangulate_optimal(&cameras[0], &cameras[1], &observed[0], &observed[1]),
            ] {
                match (&found, &expected) {
                    (Ok(x), Ok(depth)) => {
                        assert!((x.z / scale / depth - 1.0).abs() < 1e-6, "{scale}: {x}");
                    }
                    _ => assert_eq!(found.map(|x| x.z), expected.clone(), "{scale}"),
                }
            }
        }
    }
}
