//! Invariance to the world's origin, the unit of length, the order of matches, and the order of
//! views.

use epipole::absolute_pose::{estimate_absolute_pose, pose_dlt, pose_p3p, refine_absolute_pose};
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at, relative_motion};
use epipole::epipolar::{
    RelativePose, essential_5point, essential_8point, essential_from_motion, refine_relative_pose,
};
use epipole::math::random::Random;
use epipole::optim::RobustLoss;
use epipole::robust::RansacOptions;
use epipole::triangulation::{
    point_covariance, triangulate_angular, triangulate_midpoint, triangulate_nview,
    triangulate_nview_dlt, triangulate_optimal, triangulate_weighted_midpoint,
};
use nalgebra::{Matrix3, Point2, Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// A change of the world's frame and of its unit of length, `x' = s R x + t`.
#[derive(Clone, Copy)]
struct Change {
    rotation: UnitQuaternion<f64>,
    shift: Vector3<f64>,
    scale: f64,
}

impl Change {
    fn new(rotation_vector: [f64; 3], shift: [f64; 3], scale: f64) -> Self {
        Self {
            rotation: UnitQuaternion::from_scaled_axis(Vector3::from(rotation_vector)),
            shift: Vector3::from(shift) * scale,
            scale,
        }
    }

    fn point(&self, x: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.rotation * x.coords * self.scale + self.shift)
    }

    /// A camera frame has the new unit of length, too: `x_in_cam' = s x_in_cam`.
    fn pose(&self, cam_from_world: &RigidTransform) -> RigidTransform {
        let rotation = cam_from_world.rotation * self.rotation.inverse();
        let t = cam_from_world.translation.vector * self.scale - rotation * self.shift;
        RigidTransform::from_parts(t.into(), rotation)
    }

    fn camera(&self, camera: &PosedCamera) -> PosedCamera {
        PosedCamera {
            cam_from_world: self.pose(&camera.cam_from_world),
            ..*camera
        }
    }
}

fn near(random: &mut Random, size: f64) -> f64 {
    random.uniform(-size, size)
}

/// A camera about 5 units from the origin, which it looks at.
fn camera(random: &mut Random, side: f64) -> PosedCamera {
    let center = Point3::new(
        side + near(random, 0.5),
        near(random, 1.0),
        -5.0 + near(random, 0.8),
    );
    let target = Point3::new(near(random, 0.3), near(random, 0.3), 0.0);
    let up = Vector3::new(near(random, 0.3), -1.0, 0.0);
    PosedCamera {
        camera: Camera::pinhole(
            Intrinsics::new(600.0 + near(random, 50.0), 620.0, 320.0, 240.0).unwrap(),
            640,
            480,
        ),
        cam_from_world: look_at(&center, &target, &up).unwrap(),
    }
}

fn point(random: &mut Random) -> Point3<f64> {
    Point3::new(near(random, 1.5), near(random, 1.2), near(random, 1.2))
}

/// Projection of a point, with Gaussian noise.
fn observe(
    random: &mut Random,
    camera: &PosedCamera,
    x: &Point3<f64>,
    noise_px: f64,
) -> Point2<f64> {
    let p = camera.project(x).unwrap();
    Point2::new(
        p.x + noise_px * random.normal(),
        p.y + noise_px * random.normal(),
    )
}

/// Frobenius distance of matrices up to sign.
fn apart(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    let (a, b) = (a / a.norm(), b / b.norm());
    (a - b).norm().min((a + b).norm())
}

fn pose_error(a: &RigidTransform, b: &RigidTransform, length: f64) -> f64 {
    a.rotation.angle_to(&b.rotation) + (a.translation.vector - b.translation.vector).norm() / length
}

fn rotated<T: Clone>(list: &[T], places: usize) -> Vec<T> {
    let mut list = list.to_vec();
    let count = list.len();
    list.rotate_left(places % count);
    list
}

const TRIVIAL: RobustLoss = RobustLoss::Trivial;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// A triangulated point moves with the world, and its covariance is rotated with it.
    #[test]
    fn points_move_with_the_world(
        seed in 0_u64..1000,
        rotation_vector in prop::array::uniform3(-3.0_f64..3.0),
        shift in prop::array::uniform3(-50.0_f64..50.0),
        scale_exponent in -6.0_f64..6.0,
    ) {
        let change = Change::new(rotation_vector, shift, libm::exp10(scale_exponent));
        let mut random = Random::new(seed);
        let truth = point(&mut random);
        let cameras: Vec<PosedCamera> = [-2.0, 0.0, 2.0].map(|x| camera(&mut random, x)).to_vec();
        let pixels: Vec<_> =
            cameras.iter().map(|c| observe(&mut random, c, &truth, 1.0)).collect();
        let moved: Vec<PosedCamera> = cameras.iter().map(|c| change.camera(c)).collect();
        let same = |before: &Point3<f64>, after: &Point3<f64>, tolerance: f64| {
            (change.point(before) - after).norm() < tolerance * change.scale
        };

        let before = triangulate_optimal(&cameras[0], &cameras[2], &pixels[0], &pixels[2]).unwrap();
        let after = triangulate_optimal(&moved[0], &moved[2], &pixels[0], &pixels[2]).unwrap();
        prop_assert!(same(&before, &after, 1e-9));

        let before = triangulate_nview(&cameras, &pixels, TRIVIAL).unwrap();
        let after = triangulate_nview(&moved, &pixels, TRIVIAL).unwrap();
        prop_assert!(same(&before.point_in_world, &after.point_in_world, 1e-6));
        prop_assert!((before.rms_error_px - after.rms_error_px).abs() < 1e-6);

        // Exact pixels: the algebraic error of noisy ones depends on the unit of length.
        let exact: Vec<_> = cameras.iter().map(|c| c.project(&truth).unwrap()).collect();
        let after = triangulate_nview_dlt(&moved, &exact).unwrap();
        prop_assert!(same(&truth, &after, 1e-9));

        let before = point_covariance(&cameras, &truth, 0.5).unwrap();
        let after = point_covariance(&moved, &change.point(&truth), 0.5).unwrap();
        let rotation = change.rotation.to_rotation_matrix();
        let expected = rotation * before * rotation.transpose() * (change.scale * change.scale);
        prop_assert!((after - expected).norm() < 1e-8 * expected.norm());
    }

    /// Methods that work on rays know nothing of the world, but of the unit of length.
    #[test]
    fn points_between_rays_scale_with_the_baseline(
        seed in 0_u64..1000,
        scale_exponent in -200.0_f64..200.0,
    ) {
        let scale = libm::exp10(scale_exponent);
        let mut random = Random::new(seed);
        let truth = point(&mut random);
        let cameras = [-2.0, 2.0].map(|x| camera(&mut random, x));
        let rays = cameras.map(|c| c.camera.intrinsics.ray(&observe(&mut random, &c, &truth, 1.0)));
        let motion = relative_motion(&cameras[0].cam_from_world, &cameras[1].cam_from_world);
        let mut enlarged = motion;
        enlarged.translation.vector *= scale;
        for method in [triangulate_midpoint, triangulate_weighted_midpoint, triangulate_angular] {
            let before = method(&motion, &rays[0], &rays[1]).unwrap();
            let after = method(&enlarged, &rays[0], &rays[1]).unwrap();
            prop_assert!((after / scale - before).norm() < 1e-12 * before.coords.norm());
            // The other way round, in the frame of the other camera.
            let swapped = method(&motion.inverse(), &rays[1], &rays[0]).unwrap();
            prop_assert!((swapped - motion * before).norm() < 1e-9);
        }
    }

    /// Neither the order of the views matters, nor which is called the first.
    #[test]
    fn views_may_come_in_any_order(seed in 0_u64..1000, places in 1_usize..5) {
        let mut random = Random::new(seed);
        let truth = point(&mut random);
        let cameras: Vec<PosedCamera> =
            (0..5).map(|i| camera(&mut random, f64::from(i) - 2.0)).collect();
        let pixels: Vec<_> =
            cameras.iter().map(|c| observe(&mut random, c, &truth, 1.0)).collect();
        let (other_cameras, other_pixels) = (rotated(&cameras, places), rotated(&pixels, places));

        // One pixel of noise moves the point by 0.01 and more. Beside the bend of a loss the search
        // ends a little before the optimum, elsewhere for another order of the sums.
        for (loss, tolerance) in [(TRIVIAL, 1e-5), (RobustLoss::Huber { width: 1.0 }, 1e-3)] {
            let one = triangulate_nview(&cameras, &pixels, loss).unwrap();
            let other = triangulate_nview(&other_cameras, &other_pixels, loss).unwrap();
            prop_assert!((one.point_in_world - other.point_in_world).norm() < tolerance);
        }
        let one = point_covariance(&cameras, &truth, 1.0).unwrap();
        let other = point_covariance(&other_cameras, &truth, 1.0).unwrap();
        prop_assert!((one - other).norm() < 1e-12 * one.norm());
        let one = triangulate_optimal(&cameras[0], &cameras[4], &pixels[0], &pixels[4]).unwrap();
        let other = triangulate_optimal(&cameras[4], &cameras[0], &pixels[4], &pixels[0]).unwrap();
        prop_assert!((one - other).norm() < 1e-9);
    }

    /// The pose of a camera moves with the world; the order of the points does not matter.
    #[test]
    fn absolute_poses_move_with_the_world(
        seed in 0_u64..1000,
        rotation_vector in prop::array::uniform3(-3.0_f64..3.0),
        shift in prop::array::uniform3(-50.0_f64..50.0),
        scale_exponent in -3.0_f64..3.0,
        places in 1_usize..30,
    ) {
        let change = Change::new(rotation_vector, shift, libm::exp10(scale_exponent));
        let mut random = Random::new(seed);
        let truth = camera(&mut random, 0.0);
        let points: Vec<_> = (0..30).map(|_| point(&mut random)).collect();
        let pixels: Vec<_> = points.iter().map(|x| observe(&mut random, &truth, x, 0.5)).collect();
        let moved: Vec<_> = points.iter().map(|x| change.point(x)).collect();
        let k = truth.camera.intrinsics;
        // The world's origin may be far away, and a rotation moves it.
        let length = change.scale * (5.0 + change.shift.norm() / change.scale);

        let before = pose_dlt(&points, &pixels, &k).unwrap();
        let after = pose_dlt(&moved, &pixels, &k).unwrap();
        prop_assert!(pose_error(&after, &change.pose(&before), length) < 1e-7);
        let order = pose_dlt(&rotated(&points, places), &rotated(&pixels, places), &k).unwrap();
        prop_assert!(pose_error(&order, &before, 5.0) < 1e-7);

        let refine = |start: &RigidTransform, points: &[Point3<f64>], pixels: &[Point2<f64>]| {
            refine_absolute_pose(start, points, pixels, &Camera::pinhole(k, 640, 480), TRIVIAL).unwrap()
        };
        let start = before;
        let before = refine(&start, &points, &pixels);
        let after = refine(&change.pose(&start), &moved, &pixels);
        prop_assert!(pose_error(&after, &change.pose(&before), length) < 1e-5);
        let order = refine(&start, &rotated(&points, places), &rotated(&pixels, places));
        prop_assert!(pose_error(&order, &before, 5.0) < 1e-7);

        let options = RansacOptions::default().with_max_error_px(4.0).with_seed(seed);
        let before = estimate_absolute_pose(&points, &pixels, &Camera::pinhole(k, 640, 480), &options, &mut ()).unwrap();
        let after = estimate_absolute_pose(&moved, &pixels, &Camera::pinhole(k, 640, 480), &options, &mut ()).unwrap();
        let order = estimate_absolute_pose(&rotated(&points, places), &rotated(&pixels, places), &Camera::pinhole(k, 640, 480), &options, &mut ()).unwrap();
        prop_assert_eq!(after.num_inliers, before.num_inliers);
        prop_assert_eq!(order.num_inliers, before.num_inliers);
        prop_assert!(pose_error(&after.model, &change.pose(&before.model), length) < 1e-6);
        prop_assert!(pose_error(&order.model, &before.model, 5.0) < 1e-5);
    }

    /// Three points: the true pose is found in every frame and in every order.
    #[test]
    fn three_points_move_with_the_world(
        seed in 0_u64..1000,
        rotation_vector in prop::array::uniform3(-3.0_f64..3.0),
        shift in prop::array::uniform3(-5.0_f64..5.0),
        scale_exponent in -3.0_f64..3.0,
        places in 0_usize..3,
    ) {
        let change = Change::new(rotation_vector, shift, libm::exp10(scale_exponent));
        let mut random = Random::new(seed);
        let truth = camera(&mut random, 0.0);
        // A triangle that is neither small nor flat, for any seed.
        let points = [(-1.0, -0.8), (1.0, -0.6), (0.2, 1.0)].map(|(x, y)| {
            Point3::new(x + near(&mut random, 0.2), y + near(&mut random, 0.2), near(&mut random, 0.5))
        });
        let rays = points.map(|x| (truth.cam_from_world * x).coords);
        let at = |i: usize| (i + places) % 3;
        let rays = [rays[at(0)], rays[at(1)], rays[at(2)]];
        let points = [points[at(0)], points[at(1)], points[at(2)]].map(|x| change.point(&x));
        let expected = change.pose(&truth.cam_from_world);
        let best = pose_p3p(&rays, &points)
            .iter()
            .map(|found| pose_error(found, &expected, change.scale))
            .fold(f64::INFINITY, f64::min);
        prop_assert!(best < 1e-5, "{}", best);
    }

    /// Exchanging the views transposes E; the order of the matches does not matter.
    #[test]
    fn essential_matrices_transpose_when_views_are_exchanged(
        seed in 0_u64..1000,
        places in 1_usize..40,
    ) {
        let mut random = Random::new(seed);
        let (cam1, cam2) = (camera(&mut random, -1.0), camera(&mut random, 1.0));
        let motion = relative_motion(&cam1.cam_from_world, &cam2.cam_from_world);
        let points: Vec<_> = (0..40).map(|_| point(&mut random)).collect();
        let p1: Vec<_> = points.iter().map(|x| observe(&mut random, &cam1, x, 0.5)).collect();
        let p2: Vec<_> = points.iter().map(|x| observe(&mut random, &cam2, x, 0.5)).collect();
        let (k1, k2) = (cam1.camera.intrinsics, cam2.camera.intrinsics);
        let rays1: Vec<_> = p1.iter().map(|p| k1.ray(p)).collect();
        let rays2: Vec<_> = p2.iter().map(|p| k2.ray(p)).collect();

        let e = essential_8point(&rays1, &rays2).unwrap();
        let swapped = essential_8point(&rays2, &rays1).unwrap();
        prop_assert!(apart(&swapped.transpose(), &e) < 1e-9);
        let order = essential_8point(&rotated(&rays1, places), &rotated(&rays2, places)).unwrap();
        prop_assert!(apart(&order, &e) < 1e-9);

        // Five of the noisy pairs have several solutions, rarely none, and rounding decides on
        // those that have nearly merged with another. The one nearest to the truth is found every
        // time.
        let truth = essential_from_motion(&motion).unwrap();
        let five = |rays: &[Vector3<f64>]| -> [Vector3<f64>; 5] {
            core::array::from_fn(|i| rays[i])
        };
        let nearest = |list: &[Matrix3<f64>], e: &Matrix3<f64>| {
            let off = |m: &Matrix3<f64>| apart(m, e);
            list.iter().min_by(|a, b| off(a).total_cmp(&off(b))).copied()
        };
        if let Some(best) = nearest(&essential_5point(&five(&rays1), &five(&rays2)), &truth) {
            let swapped = essential_5point(&five(&rays2), &five(&rays1));
            let swapped = nearest(&swapped, &best.transpose()).unwrap();
            prop_assert!(apart(&swapped.transpose(), &best) < 1e-4);
            let rotate = |rays: &[Vector3<f64>]| five(&rotated(&rays[..5], places));
            let order = essential_5point(&rotate(&rays1), &rotate(&rays2));
            prop_assert!(apart(&nearest(&order, &best).unwrap(), &best) < 1e-4);
        }

        let [one, two] = [k1, k2].map(|k| Camera::pinhole(k, 640, 480));
        let start = RelativePose::from_motion(&motion).unwrap();
        let refined = refine_relative_pose(&start, &p1, &p2, [&one, &two], TRIVIAL).unwrap();
        let start_back = RelativePose::from_motion(&motion.inverse()).unwrap();
        let back = refine_relative_pose(&start_back, &p2, &p1, [&two, &one], TRIVIAL).unwrap();
        prop_assert!(apart(&back.essential().transpose(), &refined.essential()) < 1e-5);
        let order = refine_relative_pose(&start, &rotated(&p1, places), &rotated(&p2, places), [&one, &two], TRIVIAL).unwrap();
        prop_assert!(apart(&order.essential(), &refined.essential()) < 1e-7);
    }
}
