//! E and the relative pose from matches of which many are wrong.

use super::essential_estimator::EssentialEstimator;
use super::{RelativePose, decompose_essential, select_pose};
use crate::Result;
use crate::camera::Intrinsics;
use crate::progress::Monitor;
use crate::robust::{MatchSet, RansacOptions, RansacReport, ransac};
use nalgebra::{Matrix3, Point2};

/// The relative pose of two calibrated cameras that most matches agree on.
///
/// * `pixels1`, `pixels2`: matching pixels; wrong matches are expected
/// * `k1`, `k2`: intrinsics of the two cameras
/// * `options`: [`RansacOptions::max_error_px`] bounds the Sampson error of an inlier, pixels; an inlier
///   is in front of both cameras as well, or so far away that this cannot be told
///
/// Of the four motions that the essential matrix allows, the one that puts the most inliers in front
/// of both cameras is returned. If the camera hardly moved, the direction means nothing;
/// [`find_explaining_turn`](crate::two_view::find_explaining_turn) tells whether this may be so.
///
/// # Errors
/// As [`MatchSet::new`], [`EssentialEstimator::new`] and [`ransac`].
///
/// Source: as [`EssentialEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::estimate_relative_pose;
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point2, Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// // Every fifth match is wrong.
/// for i in (0..40).step_by(5) {
///     p2[i] = Point2::new((i * 37 % 640) as f64, (i * 71 % 480) as f64);
/// }
/// let report = estimate_relative_pose(&p1, &p2, &k, &k, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 32);
/// // The direction of t is found; its length is not to be seen.
/// let found = report.model.cam2_from_cam1();
/// assert!(found.rotation.angle_to(&cam2_from_cam1.rotation) < 1e-5);
/// assert!((found.translation.vector - cam2_from_cam1.translation.vector.normalize()).norm() < 1e-5);
/// # Ok(()) }
/// ```
#[doc(alias = "recoverPose")]
pub fn estimate_relative_pose(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<RelativePose>> {
    let matches = MatchSet::new(pixels1, pixels2)?;
    let estimator = EssentialEstimator::new(matches, *k1, *k2)?;
    let mut report = ransac(estimator, options, monitor)?;
    let inliers_of = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
        pixels
            .iter()
            .zip(&report.inliers)
            .filter(|(_, inlier)| **inlier)
            .map(|(p, _)| *p)
            .collect()
    };
    let (inliers1, inliers2) = (inliers_of(pixels1), inliers_of(pixels2));
    let motions = decompose_essential(&report.model.essential())?;
    let chosen = select_pose(&motions, &inliers1, &inliers2, k1, k2)?;
    let rotation = chosen.cam2_from_cam1.rotation.to_rotation_matrix();
    let direction = chosen.cam2_from_cam1.translation.vector;
    report.model = RelativePose::checked(rotation.into_inner(), direction, k1, k2)?;
    Ok(report)
}

/// The essential matrix that most matches agree on, unit Frobenius norm; as
/// [`estimate_relative_pose`].
///
/// # Errors
/// As [`estimate_relative_pose`].
///
/// Source: as [`EssentialEstimator`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Intrinsics, RigidTransform};
/// use epipole::epipolar::{essential_from_motion, estimate_essential};
/// use epipole::robust::RansacOptions;
/// use nalgebra::{Point3, Vector3};
/// let k = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
/// let cam2_from_cam1 = RigidTransform::new(Vector3::new(-1.0, 0.2, 0.1), Vector3::new(0.0, 0.1, 0.0));
/// let (mut p1, mut p2) = (Vec::new(), Vec::new());
/// for i in 0..40 {
///     let x = Point3::new(f64::from(i * 7 % 5) - 2.0, f64::from(i * 3 % 4) - 1.5, 5.0 + f64::from(i * i % 7));
///     p1.push(k.project(&x)?);
///     p2.push(k.project(&(cam2_from_cam1 * x))?);
/// }
/// let report = estimate_essential(&p1, &p2, &k, &k, &RansacOptions::default(), &mut ())?;
/// let truth = essential_from_motion(&cam2_from_cam1)?;
/// assert_eq!(report.num_inliers, 40);
/// assert!((report.model - truth).norm() < 1e-5);
/// # Ok(()) }
/// ```
#[doc(alias = "findEssentialMat")]
pub fn estimate_essential(
    pixels1: &[Point2<f64>],
    pixels2: &[Point2<f64>],
    k1: &Intrinsics,
    k2: &Intrinsics,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<Matrix3<f64>>> {
    estimate_relative_pose(pixels1, pixels2, k1, k2, options, monitor)
        .map(|report| report.map(|pose| pose.essential()))
}
