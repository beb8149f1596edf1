//! Two views of exact matches: the truth is found up to rounding.

use epipole::Error;
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at, relative_motion};
use epipole::epipolar::{
    decompose_essential, essential_5point, essential_8point, essential_from_fundamental,
    essential_from_motion, estimate_essential, sampson_px, select_pose,
};
use epipole::math::random::Random;
use epipole::robust::RansacOptions;
use epipole::two_view::{
    Configuration, TwoViewModel, TwoViewOptions, TwoViewReport, estimate_two_view,
    estimate_two_view_calibrated,
};
use nalgebra::{Matrix3, Point2, Point3, UnitQuaternion, Vector3};

fn options(seed: u64) -> RansacOptions {
    RansacOptions::default().with_seed(seed)
}

fn same_up_to_sign(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    let (a, b) = (a / a.norm(), b / b.norm());
    (a - b).norm().min((a + b).norm())
}

/// Two random cameras around a cloud of points that both see.
struct Pair {
    cameras: [PosedCamera; 2],
    points: Vec<Point3<f64>>,
    pixels: [Vec<Point2<f64>>; 2],
}

impl Pair {
    fn new(random: &mut Random, num_points: usize) -> Self {
        let cameras = [600.0, 650.0].map(|focal_px| {
            let mut near = |size: f64| random.uniform(-size, size);
            let center = Point3::new(near(1.5), near(1.0), -5.0 + near(1.0));
            let target = Point3::new(near(0.3), near(0.3), 0.0);
            let up = Vector3::new(near(0.3), -1.0, 0.0);
            PosedCamera {
                camera: Camera::pinhole(
                    Intrinsics::centered(focal_px, 640, 480).unwrap(),
                    640,
                    480,
                ),
                cam_from_world: look_at(&center, &target, &up).unwrap(),
            }
        });
        let mut pair = Self {
            cameras,
            points: Vec::new(),
            pixels: [Vec::new(), Vec::new()],
        };
        while pair.points.len() < num_points {
            let mut near = |size: f64| random.uniform(-size, size);
            let point = Point3::new(near(1.6), near(1.2), near(1.5));
            if let [Ok(a), Ok(b)] = cameras.map(|camera| camera.project(&point)) {
                pair.points.push(point);
                pair.pixels[0].push(a);
                pair.pixels[1].push(b);
            }
        }
        pair
    }

    fn motion(&self) -> RigidTransform {
        let [first, second] = self.cameras.map(|camera| camera.cam_from_world);
        relative_motion(&first, &second)
    }

    /// Rotation and direction are true up to `tolerance`.
    fn check(&self, motion: &RigidTransform, tolerance: f64) {
        let truth = self.motion();
        let angle = motion.rotation.angle_to(&truth.rotation);
        let (t, direction) = (motion.translation.vector, truth.translation.vector);
        let off = (t.normalize() - direction.normalize()).norm();
        assert!(angle < tolerance && off < tolerance, "{angle} {off}");
    }

    /// The angles at which the true points see both cameras, in order.
    fn angles_rad(&self) -> Vec<f64> {
        let centers = self.cameras.map(|camera| camera.center_in_world());
        let angle = |point: &Point3<f64>| (centers[0] - point).angle(&(centers[1] - point));
        let mut angles: Vec<f64> = self.points.iter().map(angle).collect();
        angles.sort_by(f64::total_cmp);
        angles
    }
}

/// COLMAP's src/colmap/estimators/two_view_geometry_test.cc: a hundred seeds, 50 exact matches;
/// rotation, direction and the median angle of triangulation within 1e-6.
#[test]
fn a_hundred_pairs_with_known_intrinsics() {
    for seed in 0..100 {
        let pair = Pair::new(&mut Random::new(seed), 50);
        let [p1, p2] = &pair.pixels;
        let [k1, k2] = pair.cameras.map(|camera| camera.camera.intrinsics);
        let choice = TwoViewOptions::default().with_ransac(options(seed));
        let report = estimate_two_view_calibrated(
            p1,
            p2,
            [
                &Camera::pinhole(k1, 640, 480),
                &Camera::pinhole(k2, 640, 480),
            ],
            &choice,
            &mut (),
        )
        .unwrap();
        check_general(&report, seed);
        pair.check(&report.cam2_from_cam1.unwrap(), 1e-6);
        let median = report.median_triangulation_angle_rad.unwrap();
        let angles = pair.angles_rad();
        // Of an even number, anything between the two in the middle is a median.
        let middle = angles[24] - 1e-6..=angles[25] + 1e-6;
        assert!(middle.contains(&median), "{seed}: {median}, {middle:?}");
    }
}

/// The same source without intrinsics: F alone, decomposed afterwards.
#[test]
fn a_hundred_pairs_with_unknown_intrinsics() {
    for seed in 0..100 {
        let pair = Pair::new(&mut Random::new(seed), 50);
        let [p1, p2] = &pair.pixels;
        let [k1, k2] = pair.cameras.map(|camera| camera.camera.intrinsics);
        let choice = TwoViewOptions::default().with_ransac(options(seed));
        let report = estimate_two_view(p1, p2, &choice, &mut ()).unwrap();
        check_general(&report, seed);
        assert!(matches!(report.model, TwoViewModel::Fundamental(_)));
        // Results that need intrinsics are left open.
        assert_eq!(report.cam2_from_cam1, None);
        assert_eq!(report.median_triangulation_angle_rad, None);
        let e = essential_from_fundamental(&report.fundamental.unwrap(), &k1, &k2).unwrap();
        let motions = decompose_essential(&e).unwrap();
        let selected = select_pose(&motions, p1, p2, &k1, &k2).unwrap();
        assert_eq!(selected.num_in_front, 50, "{seed}");
        pair.check(&selected.cam2_from_cam1, 1e-6);
    }
}

fn check_general(report: &TwoViewReport, seed: u64) {
    assert_eq!(report.configuration, Configuration::General, "{seed}");
    assert_eq!(report.num_inliers, 50, "{seed}");
    assert!(report.inliers.iter().all(|inlier| *inlier), "{seed}");
}

/// A motion of length 1 and unit rays to points all around, 0.2 to 2 away. With `well_posed`, no
/// point is close to the second camera and no two rays are nearly parallel.
fn rays(
    random: &mut Random,
    num_rays: usize,
    well_posed: bool,
) -> (RigidTransform, Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
    let direction = |random: &mut Random| Vector3::from_fn(|_, _| random.normal()).normalize();
    let rotation = UnitQuaternion::from_scaled_axis(
        direction(random) * random.uniform(0.0, std::f64::consts::PI),
    );
    let motion = RigidTransform::from_parts(direction(random).into(), rotation);
    let (mut rays1, mut rays2) = (Vec::new(), Vec::new());
    while rays1.len() < num_rays {
        let ray1 = direction(random);
        let x2 = motion * Point3::from(random.uniform(0.2, 2.0) * ray1);
        let ray2 = x2.coords.normalize();
        let cosine = (motion.rotation * ray1).dot(&ray2);
        if well_posed && (x2.coords.norm() < 0.2 || 1.0 - cosine * cosine < 1e-2) {
            continue;
        }
        rays1.push(ray1);
        rays2.push(ray2);
    }
    (motion, rays1, rays2)
}

/// COLMAP's src/colmap/estimators/solvers/essential_matrix_test.cc: a hundred motions, 5, 20 and
/// 1000 rays.
#[test]
fn essential_matrices_of_few_and_of_many_rays() {
    let mut random = Random::new(1);
    for (num_rays, tolerance) in [(5, 5e-3), (20, 1e-4), (1000, 1e-4)] {
        let mut worst: f64 = 0.0;
        for trial in 0..100 {
            let (motion, rays1, rays2) = rays(&mut random, num_rays, num_rays == 5);
            let truth = essential_from_motion(&motion).unwrap();
            let solutions = match num_rays {
                5 => {
                    let five = |rays: &[Vector3<f64>]| core::array::from_fn(|i| rays[i]);
                    essential_5point(&five(&rays1), &five(&rays2))
                }
                _ => [essential_8point(&rays1, &rays2).unwrap()]
                    .into_iter()
                    .collect(),
            };
            let off = |e: &&Matrix3<f64>| same_up_to_sign(e, &truth);
            let nearest = solutions
                .iter()
                .min_by(|a, b| off(a).total_cmp(&off(b)))
                .unwrap();
            let error = off(&nearest);
            assert!(error < tolerance, "{num_rays} rays, {trial}: {error}");
            worst = worst.max(error);
            for (ray1, ray2) in rays1.iter().zip(&rays2) {
                let residual = ray2.dot(&(*nearest * ray1));
                assert!(residual * residual < 1e-5, "{residual}");
            }
        }
        println!("{num_rays} rays: ‖E − E*‖ {worst:.1e} at most");
    }
}

/// The same through pixels and RANSAC, which ends in least squares over all matches.
#[test]
fn essential_matrices_of_few_and_of_many_matches() {
    for (num_matches, trials) in [(20, 100), (1000, 100)] {
        let mut worst: f64 = 0.0;
        for seed in 0..trials {
            let pair = Pair::new(&mut Random::new(1000 + seed), num_matches);
            let [p1, p2] = &pair.pixels;
            let [k1, k2] = pair.cameras.map(|camera| camera.camera.intrinsics);
            let report = estimate_essential(
                p1,
                p2,
                [
                    &Camera::pinhole(k1, 640, 480),
                    &Camera::pinhole(k2, 640, 480),
                ],
                &options(seed),
                &mut (),
            )
            .unwrap();
            let truth = essential_from_motion(&pair.motion()).unwrap();
            let error = same_up_to_sign(&report.model, &truth);
            assert!(error < 1e-4, "{num_matches} matches, {seed}: {error}");
            worst = worst.max(error);
            assert_eq!(report.num_inliers, num_matches);
            let f = k2.inverse_matrix().transpose() * report.model * k1.inverse_matrix();
            for (a, b) in p1.iter().zip(p2) {
                assert!(sampson_px(&f, a, b) < 3e-3, "{seed}");
            }
        }
        println!("{num_matches} matches: ‖E − E*‖ {worst:.1e} at most");
    }
}

/// Repeated matches do not change the result.
#[test]
fn repeated_matches_do_not_change_the_result() {
    let k = Intrinsics::centered(700.0, 800, 600).unwrap();
    let motion = RigidTransform::new(Vector3::new(-0.8, 0.1, 0.1), Vector3::new(0.02, 0.1, -0.03));
    let mut random = Random::new(8);
    // 70 matches of a scene with depth, then 30 of a wall in it; and a wall with six matches beside
    // it.
    for (num_elsewhere, num_on_wall) in [(70, 30), (6, 94)] {
        let (mut p1, mut p2) = (Vec::new(), Vec::new());
        while p1.len() < num_elsewhere + num_on_wall {
            let mut near = |size: f64| random.uniform(-size, size);
            let (x, y) = (near(1.6), near(1.2));
            let z = if p1.len() < num_elsewhere {
                5.0 + near(1.5)
            } else {
                5.0 + 0.2 * x
            };
            let point = Point3::new(x, y, z);
            p1.push(k.project(&point).unwrap());
            p2.push(k.project(&(motion * point)).unwrap());
        }
        let choice = TwoViewOptions::default();
        let estimate = |p1: &[Point2<f64>], p2: &[Point2<f64>]| {
            [
                estimate_two_view(p1, p2, &choice, &mut ())
                    .unwrap()
                    .configuration,
                estimate_two_view_calibrated(
                    p1,
                    p2,
                    [&Camera::pinhole(k, 640, 480); 2],
                    &choice,
                    &mut (),
                )
                .unwrap()
                .configuration,
            ]
        };
        let once = estimate(&p1, &p2);
        let repeated = if num_elsewhere > 6 {
            num_elsewhere..100
        } else {
            0..num_elsewhere
        };
        let (more1, more2) = (p1[repeated.clone()].repeat(40), p2[repeated].repeat(40));
        p1.extend(more1);
        p2.extend(more2);
        assert_eq!(estimate(&p1, &p2), once);
        let expected = if num_elsewhere > 6 {
            Configuration::General
        } else {
            Configuration::Planar
        };
        assert_eq!(once, [expected; 2]);
    }
}

#[test]
fn too_few_matches_are_reported_with_the_number_needed() {
    let k = Intrinsics::centered(700.0, 800, 600).unwrap();
    let at = |i: usize| Point2::new((i * 37 % 100) as f64, (i * 71 % 90) as f64);
    let p1: Vec<_> = (0..3).map(at).collect();
    let p2: Vec<_> = (3..6).map(at).collect();
    let error = estimate_two_view(&p1, &p2, &TwoViewOptions::default(), &mut ()).unwrap_err();
    assert!(
        matches!(
            error,
            Error::TooFew {
                needed: 4,
                got: 3,
                ..
            }
        ),
        "{error}"
    );
    let error = estimate_two_view_calibrated(
        &p1[..1],
        &p2[..1],
        [&Camera::pinhole(k, 640, 480); 2],
        &TwoViewOptions::default(),
        &mut (),
    );
    assert!(
        matches!(
            error,
            Err(Error::TooFew {
                needed: 4,
                got: 1,
                ..
            })
        ),
        "{error:?}"
    );
    for ratio in [-0.1, f64::NAN] {
        let options = TwoViewOptions::default().with_max_homography_ratio(ratio);
        assert!(
            matches!(options.check(), Err(Error::OutOfRange { .. })),
            "{ratio}"
        );
    }
}
