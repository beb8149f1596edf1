//! One point from two noisy pixels by every method of the core, with repetitions.

use super::uncertainty::{Curves, axes_of};
use epipole::Error;
use epipole::camera::{PosedCamera, relative_motion};
use epipole::epipolar::{epipolar_line1, epipolar_line2, fundamental_from_cameras};
use epipole::math::Line2;
use epipole::math::random::Random;
use epipole::triangulation::{
    triangulate_angular, triangulate_dlt, triangulate_midpoint, triangulate_optimal,
    triangulation_angle_rad,
};
use nalgebra::{Point2, Point3, Vector2, Vector3};

/// Number of repetitions with new noise.
const NUM_REPEATS: usize = 200;
/// Names of the methods, as in the core.
pub(super) const METHODS: [&str; 4] = ["midpoint", "DLT", "angular", "optimal"];

/// Two cameras, a point, and its estimates from noisy pixels.
pub(super) struct Estimates {
    pub(super) cameras: [PosedCamera; 2],
    pub(super) truth: Point3<f64>,
    /// Noisy projections of the point, pixels.
    pub(super) pixels: [Point2<f64>; 2],
    /// Estimate by each of [`METHODS`], or the error.
    pub(super) points: [Result<Point3<f64>, Error>; 4],
    /// Optimal estimates for repetitions with the same noise level.
    pub(super) repeats: Vec<Point3<f64>>,
    /// Semi-axes of the one-sigma ellipsoid, longest first, in the world.
    pub(super) axes: Option<[Vector3<f64>; 3]>,
    pub(super) angle_deg: f64,
    /// In each photograph, the epipolar line of the pixel in the other one.
    pub(super) lines: Option<[Line2; 2]>,
    pub(super) curves: Curves,
}

impl Estimates {
    /// * `sigma_px`: standard deviation of each coordinate of a pixel
    pub(super) fn new(
        cameras: [PosedCamera; 2],
        truth: Point3<f64>,
        sigma_px: f64,
        seed: u64,
    ) -> Result<Self, Error> {
        let mut random = Random::new(seed);
        let exact = [cameras[0].project(&truth)?, cameras[1].project(&truth)?];
        let mut photographed =
            || exact.map(|pixel| pixel + Vector2::new(random.normal(), random.normal()) * sigma_px);
        let pixels = photographed();
        let optimal = |pixels: [Point2<f64>; 2]| {
            triangulate_optimal(&cameras[0], &cameras[1], &pixels[0], &pixels[1])
        };
        let repeats = (0..NUM_REPEATS).filter_map(|_| optimal(photographed()).ok());
        let repeats = repeats.collect();
        let [center1, center2] = cameras.map(|camera| camera.center_in_world());
        Ok(Self {
            points: by_all(&cameras, &pixels),
            repeats,
            axes: axes_of(&cameras, &truth, sigma_px),
            angle_deg: triangulation_angle_rad(&center1, &center2, &truth).to_degrees(),
            lines: lines(&cameras, &pixels),
            curves: Curves::new(&cameras, &truth, sigma_px),
            cameras,
            truth,
            pixels,
        })
    }

    /// Returns the reprojection residual of one of [`METHODS`] in a photograph, pixels.
    pub(super) fn miss_px(&self, method: usize, camera: usize) -> Option<Vector2<f64>> {
        let point = self.points[method].as_ref().ok()?;
        Some(self.cameras[camera].project(point).ok()? - self.pixels[camera])
    }

    /// Returns the root mean square reprojection error of one of [`METHODS`], pixels.
    pub(super) fn reprojection_px(&self, method: usize) -> Option<f64> {
        let [one, two] = [0, 1].map(|camera| self.miss_px(method, camera));
        Some(((one?.norm_squared() + two?.norm_squared()) / 2.0).sqrt())
    }

    /// Returns the root mean square distance of the repeated estimates from the truth, meters.
    pub(super) fn scatter_m(&self) -> Option<f64> {
        let squares = (self.repeats.iter()).map(|point| (point - self.truth).norm_squared());
        let count = self.repeats.len();
        (count > 0).then(|| (squares.sum::<f64>() / count as f64).sqrt())
    }

    /// Returns the longest semi-axis of the one-sigma ellipsoid, meters.
    pub(super) fn uncertainty_m(&self) -> Option<f64> {
        self.axes.map(|axes| axes[0].norm())
    }
}

fn by_all(
    cameras: &[PosedCamera; 2],
    pixels: &[Point2<f64>; 2],
) -> [Result<Point3<f64>, Error>; 4] {
    let [first, second] = cameras;
    let motion = relative_motion(&first.cam_from_world, &second.cam_from_world);
    let ray = |index: usize| {
        let camera = &cameras[index];
        camera.cam_from_world.rotation * camera.ray_in_world(&pixels[index])
    };
    let (ray1, ray2) = (ray(0), ray(1));
    let in_world = |found: Result<Point3<f64>, Error>| {
        found.map(|point| first.cam_from_world.inverse() * point)
    };
    let projections = [first.projection_matrix(), second.projection_matrix()];
    [
        in_world(triangulate_midpoint(&motion, &ray1, &ray2)),
        triangulate_dlt(&projections[0], &projections[1], &pixels[0], &pixels[1]),
        in_world(triangulate_angular(&motion, &ray1, &ray2)),
        triangulate_optimal(first, second, &pixels[0], &pixels[1]),
    ]
}

fn lines(cameras: &[PosedCamera; 2], pixels: &[Point2<f64>; 2]) -> Option<[Line2; 2]> {
    let fundamental = fundamental_from_cameras(&cameras[0], &cameras[1]).ok()?;
    let in_first = epipolar_line1(&fundamental, &pixels[1]).ok()?;
    Some([in_first, epipolar_line2(&fundamental, &pixels[0]).ok()?])
}
