//! Two cameras, and points that flatten to a plane: each slides along its ray of camera 1.

use crate::kit::matches::Match;
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, in_picture};
use epipole::camera::{Camera, Intrinsics, PosedCamera};
use epipole::math::random::Random;
use nalgebra::{Isometry3, Point2, Point3, Translation3, UnitQuaternion, Vector3};

/// Number of matches used to estimate F, and of points used to evaluate it.
const NUM_USED: usize = 40;
const NUM_NEW: usize = 40;
/// Maximum number of pixels tried in image 1.
const MAX_TRIED: usize = 4000;
const FOCAL_PX: f64 = 560.0;
/// Pose of the second camera: center in the frame of the first, meters, and rotation to the left.
const CENTER_M: [f64; 3] = [1.3, -0.35, 0.2];
const LEFT_DEG: f64 = 13.0;
/// Distance of the plane on the optical axis of camera 1, meters, and its slope to the right.
const PLANE_M: f64 = 4.6;
const SLOPE: f64 = 0.35;
/// Maximum distance from the plane in depth at full spread, meters.
const DEEP_M: f64 = 1.7;
/// Minimum distance between points in image 1 and from its edge, pixels.
const APART_PX: f64 = 26.0;
const MARGIN_PX: f64 = 24.0;

/// A pixel of image 1, and the depth of its point behind the plane at full spread, meters.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Spot {
    pixel1: Point2<f64>,
    behind_m: f64,
    /// Standard normal noise of both pixels.
    noise: [f64; 4],
}

/// Points for one seed.
#[derive(Debug, Clone)]
pub(super) struct Scene {
    used: Vec<Spot>,
    new: Vec<Spot>,
}

/// Returns both cameras, the first at the origin.
pub(super) fn cameras() -> Option<[PosedCamera; 2]> {
    let intrinsics = Intrinsics::centered(FOCAL_PX, PHOTO_WIDTH, PHOTO_HEIGHT).ok()?;
    let camera = Camera::pinhole(intrinsics, PHOTO_WIDTH, PHOTO_HEIGHT);
    // y points down: rotating the camera to the left rotates the scene to the right in its frame,
    // by +y.
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), LEFT_DEG.to_radians());
    let to_center = Translation3::from(-Vector3::from(CENTER_M));
    let second = Isometry3::from_parts(Translation3::identity(), turn) * to_center;
    Some(
        [Isometry3::identity(), second].map(|cam_from_world| PosedCamera {
            camera,
            cam_from_world,
        }),
    )
}

/// Returns the point on the ray of a pixel of image 1 at this depth behind the plane, meters.
pub(super) fn point(pixel1: &Point2<f64>, behind_m: f64) -> Point3<f64> {
    let middle = Point2::from([PHOTO_SIZE.0, PHOTO_SIZE.1].map(|n| (f64::from(n) - 1.0) / 2.0));
    let ray = (pixel1 - middle) / FOCAL_PX;
    let depth = PLANE_M / (1.0 - SLOPE * ray.x) + behind_m;
    Point3::new(ray.x * depth, ray.y * depth, depth)
}

/// Returns the pixel of image 2 for the point on the ray of a pixel of image 1 at this depth behind
/// the plane, meters, if it is inside.
pub(super) fn pixel2(pixel1: &Point2<f64>, behind_m: f64) -> Option<Point2<f64>> {
    let [_, second] = cameras()?;
    let pixel2 = second.project(&point(pixel1, behind_m)).ok()?;
    in_picture(&pixel2).then_some(pixel2)
}

impl Scene {
    /// Draws points that are visible in both images at every spread.
    pub(super) fn draw(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut spots: Vec<Spot> = Vec::new();
        for _ in 0..MAX_TRIED {
            if spots.len() == NUM_USED + NUM_NEW {
                break;
            }
            let mut along = |size: u32| random.uniform(MARGIN_PX, f64::from(size) - MARGIN_PX);
            let pixel1 = Point2::new(along(PHOTO_WIDTH), along(PHOTO_HEIGHT));
            let behind_m = random.uniform(-DEEP_M, DEEP_M);
            let noise = core::array::from_fn(|_| random.normal());
            let is_near = |other: &Spot| (other.pixel1 - pixel1).norm() < APART_PX;
            let is_crowded = spots.len() < NUM_USED && spots.iter().any(is_near);
            let is_seen = |behind_m: f64| pixel2(&pixel1, behind_m).is_some();
            if !is_crowded && is_seen(0.0) && is_seen(behind_m) {
                spots.push(Spot {
                    pixel1,
                    behind_m,
                    noise,
                });
            }
        }
        let new = spots.split_off(NUM_USED.min(spots.len()));
        Self { used: spots, new }
    }

    /// Returns the points at a spread from 0, a plane, to 1.
    pub(super) fn points(&self, spread: f64) -> Vec<Point3<f64>> {
        let points = self.used.iter();
        points
            .map(|spot| point(&spot.pixel1, spread * spot.behind_m))
            .collect()
    }

    /// Returns the matches at this spread, with normal noise on their coordinates.
    pub(super) fn matches(&self, spread: f64, noise_px: f64) -> Vec<Match> {
        let noisy = |p: Point2<f64>, by: &[f64]| {
            Point2::new(p.x + noise_px * by[0], p.y + noise_px * by[1])
        };
        let pair = |spot: &Spot| {
            let pixel2 = pixel2(&spot.pixel1, spread * spot.behind_m)?;
            Some((
                noisy(spot.pixel1, &spot.noise[..2]),
                noisy(pixel2, &spot.noise[2..]),
            ))
        };
        self.used.iter().filter_map(pair).collect()
    }

    /// Returns exact matches of points that were not used, never flattened.
    pub(super) fn new_points(&self) -> Vec<Match> {
        let pair = |spot: &Spot| Some((spot.pixel1, pixel2(&spot.pixel1, spot.behind_m)?));
        self.new.iter().filter_map(pair).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::epipolar::{fundamental_from_cameras, sampson_px};

    #[test]
    fn every_seed_has_points_that_obey_the_cameras_and_flatten_to_a_plane() {
        let [first, second] = cameras().unwrap();
        let fundamental = fundamental_from_cameras(&first, &second).unwrap();
        for seed in 1..=99 {
            let scene = Scene::draw(seed);
            assert_eq!(
                (scene.used.len(), scene.new.len()),
                (NUM_USED, NUM_NEW),
                "{seed}"
            );
            for spread in [0.0, 0.4, 1.0] {
                let matches = scene.matches(spread, 0.0);
                assert_eq!(matches.len(), NUM_USED);
                for (pixel1, pixel2) in matches.iter().chain(&scene.new_points()) {
                    assert!(sampson_px(&fundamental, pixel1, pixel2) < 1e-9);
                }
                for (point, (pixel1, _)) in scene.points(spread).iter().zip(&matches) {
                    assert!((first.project(point).unwrap() - pixel1).norm() < 1e-9);
                    let is_on_plane = (point.z - SLOPE * point.x - PLANE_M).abs() < 1e-9;
                    assert_eq!(is_on_plane, spread == 0.0);
                }
            }
        }
    }
}
