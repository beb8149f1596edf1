//! Robust estimation of F, E and relative poses.

use super::relative_pose::{PoseWithFocal, RelativePose};
use crate::arrays::{pixel_pairs, vector};
use crate::camera::Camera;
use crate::robust::{RansacReport, estimate, estimator, give_matrix, give_object};
use epipole::epipolar;
use epipole::nalgebra::Point2;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyDict;

estimator! {
    /// Estimates a fundamental matrix from matches with outliers, by RANSAC.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : RansacOptions
    ///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
    ///
    /// Returns
    /// -------
    /// RansacReport of ndarray
    ///     Its model is F, shape (3, 3), with ``x2 @ F @ x1 == 0`` and unit norm.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 7 different matches.
    /// epipole.DegenerateError
    ///     If all pixels of an image are on a line.
    /// epipole.NoConsensusError
    ///     If no matrix has 7 inliers.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    fn estimate_fundamental(pixels1, pixels2) -> PyResult<RansacReport> {
        epipolar::estimate_fundamental, give_matrix
    }
}

estimator! {
    /// Estimates an essential matrix from matches with outliers, by RANSAC.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// camera1, camera2 : Camera
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : RansacOptions
    ///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
    ///
    /// Returns
    /// -------
    /// RansacReport of ndarray
    ///     Its model is E, shape (3, 3), of unit norm.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 5 different matches.
    /// epipole.DegenerateError
    ///     If all pixels of an image of a pinhole camera are on a line.
    /// epipole.NoConsensusError
    ///     If no matrix has 5 inliers.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    fn estimate_essential(pixels1, pixels2, camera1, camera2) -> PyResult<RansacReport> {
        epipolar::estimate_essential, give_matrix
    }
}

estimator! {
    /// Estimates the relative pose of two calibrated cameras from matches with outliers, by RANSAC.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// camera1, camera2 : Camera
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : RansacOptions
    ///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
    ///
    /// Returns
    /// -------
    /// RansacReport of RelativePose
    ///     Its model is a `RelativePose`.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 5 different matches.
    /// epipole.DegenerateError
    ///     If all pixels of an image of a pinhole camera are on a line.
    /// epipole.NoConsensusError
    ///     If no pose has 5 inliers.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    fn estimate_relative_pose(pixels1, pixels2, camera1, camera2) -> PyResult<RansacReport> {
        epipolar::estimate_relative_pose, give_object::<_, RelativePose>
    }
}

/// Estimates the relative pose of two calibrated cameras with known gravity, by RANSAC.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches.
/// camera1, camera2 : Camera
/// gravity1, gravity2 : array_like, shape (3,)
///     Direction of gravity in each camera's frame.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RansacOptions
///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
///
/// Returns
/// -------
/// RansacReport of RelativePose
///     Its model is a `RelativePose`.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 5 different matches.
/// epipole.DegenerateError
///     If a gravity vector has length 0, or all pixels of an image of a pinhole camera are on a
///     line.
/// epipole.NoConsensusError
///     If no pose has 3 inliers.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
#[pyfunction]
#[pyo3(signature = (
    pixels1, pixels2, camera1, camera2, gravity1, gravity2, *, progress=None, **options
))]
#[allow(clippy::too_many_arguments)]
pub(super) fn estimate_relative_pose_with_gravity(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    camera1: &Camera,
    camera2: &Camera,
    gravity1: &Bound<'_, PyAny>,
    gravity2: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<RansacReport> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let gravity1 = vector("gravity1", gravity1)?;
    let gravity2 = vector("gravity2", gravity2)?;
    let cameras = [&camera1.0, &camera2.0];
    let gravity = [&gravity1, &gravity2];
    let give = give_object::<_, RelativePose>;
    estimate(pixels1.py(), progress, options, give, |options, monitor| {
        epipolar::estimate_relative_pose_with_gravity(
            &first, &second, cameras, gravity, options, monitor,
        )
    })
}

/// Estimates the relative pose and common focal length of two cameras, by RANSAC.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches.
/// principal1, principal2 : array_like, shape (2,)
///     Principal points, pixels.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RansacOptions
///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
///
/// Returns
/// -------
/// RansacReport of PoseWithFocal
///     Its model is a `PoseWithFocal`.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 6 different matches.
/// epipole.DegenerateError
///     If all pixels of an image are on a line.
/// epipole.NoConsensusError
///     If no pose has 6 inliers.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
#[pyfunction]
#[pyo3(signature = (pixels1, pixels2, principal1, principal2, *, progress=None, **options))]
pub(super) fn estimate_relative_pose_and_focal(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    principal1: &Bound<'_, PyAny>,
    principal2: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<RansacReport> {
    let [first, second] = pixel_pairs(pixels1, pixels2)?;
    let principal1 = Point2::from(vector("principal1", principal1)?);
    let principal2 = Point2::from(vector("principal2", principal2)?);
    let give = |py, model| PoseWithFocal::from_core(py, model)?.into_bound_py_any(py);
    estimate(pixels1.py(), progress, options, give, |options, monitor| {
        epipolar::estimate_relative_pose_and_focal(
            &first,
            &second,
            &principal1,
            &principal2,
            options,
            monitor,
        )
    })
}
