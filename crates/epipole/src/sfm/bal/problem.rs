//! Cameras, points and observations of a BAL problem.

use crate::sfm::BundleObservation;
use nalgebra::{Point3, Vector3};

/// BAL camera: looks along −z; the image has its origin in the middle and v up.
///
/// `P = R X + t`, `p = −(P.x, P.y)/P.z`, `pixel = f (1 + k1 ‖p‖² + k2 ‖p‖⁴) p`.
///
/// Source: Agarwal, Snavely, Seitz & Szeliski 2010, "Bundle adjustment in the large".
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BalCamera {
    /// Rotation vector of R (axis times angle), radians.
    pub rotation: Vector3<f64>,
    /// Translation t.
    pub translation: Vector3<f64>,
    /// Focal length f, pixels.
    pub focal_px: f64,
    /// Second-order radial distortion.
    pub k1: f64,
    /// Fourth-order radial distortion.
    pub k2: f64,
}

/// Bundle adjustment problem: cameras, points and observations.
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
