//! Scenes with known truth, and how far a motion is from it.

use epipole::camera::{Camera, Intrinsics, PosedCamera, RigidTransform, look_at, relative_motion};
use epipole::math::random::Random;
use epipole::robust::RansacOptions;
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// Distribution of a scene's points.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Volume,
    Plane,
    /// This share on a plane, the rest off it.
    Mostly(f64),
}

pub(crate) struct Scene {
    pub(crate) cam1: PosedCamera,
    pub(crate) cam2: PosedCamera,
    pub(crate) points: Vec<Point3<f64>>,
    pub(crate) p1: Vec<Point2<f64>>,
    pub(crate) p2: Vec<Point2<f64>>,
    /// Which matches are true.
    pub(crate) truth: Vec<bool>,
}

impl Scene {
    pub(crate) fn motion(&self) -> RigidTransform {
        relative_motion(&self.cam1.cam_from_world, &self.cam2.cam_from_world)
    }
}

pub(crate) fn intrinsics(focal_px: f64) -> Intrinsics {
    Intrinsics::centered(focal_px, 640, 480).unwrap()
}

/// A random pair of cameras that look at the scene around the origin from 4 to 6 units away.
pub(crate) fn cameras(random: &mut Random) -> (PosedCamera, PosedCamera) {
    let mut camera = |focal_px: f64| {
        let mut near = |size: f64| random.uniform(-size, size);
        let center = Point3::new(near(1.5), near(1.0), -5.0 + near(1.0));
        let target = Point3::new(near(0.3), near(0.3), 0.0);
        let up = Vector3::new(near(0.3), -1.0, 0.0);
        PosedCamera {
            camera: Camera::pinhole(intrinsics(focal_px), 640, 480),
            cam_from_world: look_at(&center, &target, &up).unwrap(),
        }
    };
    (camera(600.0), camera(650.0))
}

pub(crate) fn scene(
    random: &mut Random,
    (cam1, cam2): (PosedCamera, PosedCamera),
    shape: Shape,
    num_matches: usize,
    true_ratio: f64,
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
    let num_true = (true_ratio * num_matches as f64).round() as usize;
    while found.p1.len() < num_matches {
        let on_plane = match shape {
            Shape::Volume => false,
            Shape::Plane => true,
            Shape::Mostly(ratio) => (found.p1.len() as f64) < ratio * num_true as f64,
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

pub(crate) fn rotation_error(a: &RigidTransform, b: &RigidTransform) -> f64 {
    a.rotation.angle_to(&b.rotation)
}

pub(crate) fn direction_error(a: &RigidTransform, b: &RigidTransform) -> f64 {
    (a.translation.vector.normalize() - b.translation.vector.normalize()).norm()
}

pub(crate) fn options(seed: u64) -> RansacOptions {
    RansacOptions::default().with_seed(seed)
}

pub(crate) fn same_up_to_sign(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    let (a, b) = (a / a.norm(), b / b.norm());
    (a - b).norm().min((a + b).norm())
}

pub(crate) type Points = Vec<Point2<f64>>;
