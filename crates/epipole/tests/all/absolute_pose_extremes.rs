//! Camera poses far from the world's origin, and in any unit of length.

use epipole::absolute_pose::{
    estimate_absolute_pose, pose_dlt, refine_absolute_pose, reprojection_error_px,
};
use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform};
use epipole::math::random::Random;
use epipole::optim::RobustLoss;
use epipole::robust::RansacOptions;
use nalgebra::{Point2, Point3, Quaternion, UnitQuaternion, Vector3};

fn vector(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.normal())
}

fn any_rotation(random: &mut Random) -> UnitQuaternion<f64> {
    let mut number = || random.normal();
    UnitQuaternion::from_quaternion(Quaternion::new(number(), number(), number(), number()))
}

/// `cam_from_world` of a camera at a center.
fn placed(rotation: &UnitQuaternion<f64>, center: &Vector3<f64>) -> RigidTransform {
    RigidTransform::from_parts((-(rotation * center)).into(), *rotation)
}

/// 60 points from 4 to 10 units in front of a camera near the origin, seen with half a pixel of
/// noise.
struct Scene {
    intrinsics: Intrinsics,
    rotation: UnitQuaternion<f64>,
    center: Vector3<f64>,
    points: Vec<Vector3<f64>>,
    pixels: Vec<Point2<f64>>,
}

impl Scene {
    fn new(random: &mut Random) -> Self {
        let intrinsics = Intrinsics::new(800.0, 800.0, 320.0, 240.0).unwrap();
        let (rotation, center) = (any_rotation(random), vector(random));
        let (mut points, mut pixels) = (Vec::new(), Vec::new());
        for _ in 0..60 {
            let pixel = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
            let x_in_cam = intrinsics.ray(&pixel) * random.uniform(4.0, 10.0);
            points.push(rotation.inverse() * x_in_cam + center);
            pixels.push(Point2::new(
                pixel.x + 0.5 * random.normal(),
                pixel.y + 0.5 * random.normal(),
            ));
        }
        Self {
            intrinsics,
            rotation,
            center,
            points,
            pixels,
        }
    }

    /// Its points, enlarged and then moved.
    fn points(&self, shift: &Vector3<f64>, scale: f64) -> Vec<Point3<f64>> {
        let moved = |x: &Vector3<f64>| Point3::from(x * scale + shift);
        self.points.iter().map(moved).collect()
    }

    fn truth(&self, shift: &Vector3<f64>, scale: f64) -> RigidTransform {
        placed(&self.rotation, &(self.center * scale + shift))
    }

    fn cost(&self, cam_from_world: &RigidTransform, points: &[Point3<f64>]) -> f64 {
        let camera = PosedCamera {
            camera: Camera::pinhole(self.intrinsics, 640, 480),
            cam_from_world: *cam_from_world,
        };
        let errors = points
            .iter()
            .zip(&self.pixels)
            .map(|(x, p)| reprojection_error_px(&camera, x, p));
        errors.map(|e| e * e).sum()
    }
}

fn center_of(cam_from_world: &RigidTransform) -> Vector3<f64> {
    -(cam_from_world.rotation.inverse() * cam_from_world.translation.vector)
}

/// Coordinates of surveyors have six and seven digits before the point.
#[test]
fn refinement_does_not_depend_on_where_the_origin_is() {
    let mut random = Random::new(1);
    for _ in 0..20 {
        let scene = Scene::new(&mut random);
        let rotation_vector = vector(&mut random) * 0.01;
        let refined = |shift: &Vector3<f64>| {
            let points = scene.points(shift, 1.0);
            let truth = scene.truth(shift, 1.0);
            let start =
                RigidTransform::new(Vector3::new(0.02, -0.01, 0.03), rotation_vector) * truth;
            let loss = RobustLoss::Trivial;
            let found = refine_absolute_pose(
                &start,
                &points,
                &scene.pixels,
                &Camera::pinhole(scene.intrinsics, 640, 480),
                loss,
            )
            .unwrap();
            // A least squares estimate fits better than the truth, by six squares of the noise on
            // average.
            let cost = scene.cost(&found, &points);
            assert!(cost < scene.cost(&truth, &points), "{shift}: {cost}");
            found
        };
        let near = refined(&Vector3::zeros());
        for size in [1e3, 1e5, 5e6] {
            let shift = Vector3::new(0.1, 1.0, 0.3) * size;
            let far = refined(&shift);
            // Only the rounding of the coordinates makes a difference.
            assert!(far.rotation.angle_to(&near.rotation) < 1e-15 * size + 1e-7);
            let center = center_of(&far) - shift;
            assert!((center - center_of(&near)).norm() < 1e-14 * size + 1e-6);
        }
    }
}

#[test]
fn robust_estimation_does_not_depend_on_where_the_origin_is() {
    let mut random = Random::new(2);
    for seed in 0..10 {
        let mut scene = Scene::new(&mut random);
        for pixel in scene.pixels.iter_mut().step_by(3) {
            *pixel = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
        }
        for local_optimization in [true, false] {
            let options = RansacOptions::default()
                .with_max_error_px(2.0)
                .with_seed(seed)
                .with_local_optimization(local_optimization);
            let found = |shift: &Vector3<f64>| {
                let points = scene.points(shift, 1.0);
                estimate_absolute_pose(
                    &points,
                    &scene.pixels,
                    &Camera::pinhole(scene.intrinsics, 640, 480),
                    &options,
                    &mut (),
                )
                .unwrap()
            };
            let near = found(&Vector3::zeros());
            let shift = Vector3::new(5e5, 5e6, 1.5e6);
            let far = found(&shift);
            assert_eq!(far.num_inliers, near.num_inliers);
            assert!(far.model.rotation.angle_to(&near.model.rotation) < 1e-6);
            let center = center_of(&far.model) - shift;
            assert!((center - center_of(&near.model)).norm() < 1e-5);
        }
    }
}

#[test]
fn linear_poses_do_not_depend_on_where_the_origin_is() {
    let mut random = Random::new(3);
    for _ in 0..10 {
        let scene = Scene::new(&mut random);
        let found = |shift: &Vector3<f64>| {
            let points = scene.points(shift, 1.0);
            pose_dlt(&points, &scene.pixels, &scene.intrinsics).unwrap()
        };
        let (near, shift) = (found(&Vector3::zeros()), Vector3::new(5e5, 5e6, 1.5e6));
        let far = found(&shift);
        assert!(far.rotation.angle_to(&near.rotation) < 1e-7);
        assert!((center_of(&far) - shift - center_of(&near)).norm() < 1e-6);
    }
}

/// Atoms are measured in meters, and stars.
#[test]
fn refinement_does_not_depend_on_the_unit_of_length() {
    let mut random = Random::new(4);
    let scene = Scene::new(&mut random);
    let refined = |scale: f64| {
        let zero = Vector3::zeros();
        let mut start = RigidTransform::new(
            Vector3::new(0.02, -0.01, 0.03),
            Vector3::new(0.0, 0.01, 0.0),
        ) * scene.truth(&zero, 1.0);
        start.translation.vector *= scale;
        let points = scene.points(&zero, scale);
        let loss = RobustLoss::Cauchy { width: 1.0 };
        refine_absolute_pose(
            &start,
            &points,
            &scene.pixels,
            &Camera::pinhole(scene.intrinsics, 640, 480),
            loss,
        )
        .unwrap()
    };
    let expected = refined(1.0);
    for scale in [1e-15, 1e-10, 1e-3, 1e3, 1e10, 1e15] {
        let found = refined(scale);
        assert!(found.rotation.angle_to(&expected.rotation) < 1e-7);
        let off = found.translation.vector / scale - expected.translation.vector;
        assert!(off.norm() < 1e-6, "{scale}: {off}");
    }
}
