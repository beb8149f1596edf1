//! Published problems: cameras of their format, points and observations.

use crate::sfm::BundleObservation;
use nalgebra::{Point3, Vector3};

/// The camera of the format: it looks along −z, and its image has the origin in the middle and v
/// up.
///
/// `P = R X + t`, `p = −(P.x, P.y)/P.z`, `pixel = f (1 + k1 ‖p‖² + k2 ‖p‖⁴) p`.
///
/// Source: Agarwal, Snavely, Seitz & Szeliski 2010, "Bundle adjustment in the large".
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BalCamera {
    /// Axis times angle of R, radians.
    pub rotation: Vector3<f64>,
    /// t.
    pub translation: Vector3<f64>,
    /// f, pixels.
    pub focal_px: f64,
    /// Radial distortion of second order.
    pub k1: f64,
    /// Radial distortion of fourth order.
    pub k2: f64,
}

/// A bundle adjustment problem: cameras, points and what was seen where.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::nalgebra::{Point2, Point3};
/// use epipole::optim::RobustLoss;
/// use epipole::sfm::{BalCamera, BalProblem, BundleObservation};
/// // One camera at the origin with f = 100 sees a point at (1, 2, −10), 1 px too far right.
/// let problem = BalProblem {
///     cameras: vec![BalCamera { focal_px: 100.0, ..BalCamera::default() }],
///     points: vec![Point3::new(1.0, 2.0, -10.0)],
///     observations: vec![BundleObservation { camera: 0, point: 0, pixel: Point2::new(11.0, 20.0) }],
/// };
/// assert_eq!(problem.cost(RobustLoss::Trivial), 0.5);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BalProblem {
    /// The cameras.
    pub cameras: Vec<BalCamera>,
    /// The points, in the world.
    pub points: Vec<Point3<f64>>,
    /// The observations; their pixels have the origin in the middle of the image and v up.
    pub observations: Vec<BundleObservation>,
}
