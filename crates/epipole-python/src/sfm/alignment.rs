//! Alignment and comparison of trajectories.

use super::similarity::Similarity3;
use crate::arrays::points3;
use crate::camera::RigidTransform;
use crate::errors::OrRaise;
use crate::options;
use crate::record::record;
use epipole::sfm::{self, AlignmentKind};
use pyo3::prelude::*;

record! {
    /// Statistics of non-negative errors.
    "epipole.sfm" ErrorStatistics {
        /// Root of the mean square.
        rmse: f64,
        /// Mean.
        mean: f64,
        /// Median; the lower of the middle two for an even number.
        median: f64,
        /// Maximum.
        max: f64,
    }
}

impl From<sfm::ErrorStatistics> for ErrorStatistics {
    fn from(errors: sfm::ErrorStatistics) -> Self {
        Self {
            rmse: errors.rmse,
            mean: errors.mean,
            median: errors.median,
            max: errors.max,
        }
    }
}

record! {
    /// Errors of the motions between frames.
    "epipole.sfm" RelativePoseError {
        /// `ErrorStatistics` of the translation, in the unit of the trajectories.
        translation: Py<ErrorStatistics>,
        /// `ErrorStatistics` of the rotation, degrees.
        rotation_deg: Py<ErrorStatistics>,
    }
}

fn alignment_kind(kind: Option<&Bound<'_, PyAny>>) -> PyResult<AlignmentKind> {
    kind.map_or(Ok(AlignmentKind::default()), |kind| {
        options::value("kind", kind)
    })
}

/// Aligns points: finds the ``T`` that minimizes ``sum(|T @ from - to|**2)`` (Umeyama).
///
/// Parameters
/// ----------
/// from_points, to_points : array_like, shape (N, 3)
///     Matched points, N >= 3, not on a line.
/// kind : {"similarity", "rigid"}, optional
///     With or without a scale.
///
/// Returns
/// -------
/// Similarity3
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 3 points.
/// epipole.DegenerateError
///     If the points of either set are equal or on a line.
///
/// Examples
/// --------
/// >>> round(align_points(np.eye(3), 2 * np.eye(3)).scale, 6)
/// 2.0
#[pyfunction]
#[pyo3(signature = (from_points, to_points, kind=None))]
pub(super) fn align_points(
    from_points: &Bound<'_, PyAny>,
    to_points: &Bound<'_, PyAny>,
    kind: Option<&Bound<'_, PyAny>>,
) -> PyResult<Similarity3> {
    let from = points3("from_points", from_points)?;
    let to = points3("to_points", to_points)?;
    let aligned = sfm::align_points(&from, &to, alignment_kind(kind)?);
    Ok(Similarity3(aligned.or_raise()?))
}

/// Computes the absolute trajectory error: distances of camera centers after alignment.
///
/// Parameters
/// ----------
/// estimated, truth : array_like, shape (N, 3)
///     Centers of the same cameras, in the same order.
/// kind : {"similarity", "rigid"}, optional
///     Alignment with or without a scale.
///
/// Returns
/// -------
/// errors : ErrorStatistics
///     In the unit of `truth`.
/// truth_from_estimated : Similarity3
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 3 points.
/// epipole.DegenerateError
///     If the points of either set are equal or on a line.
#[pyfunction]
#[pyo3(signature = (estimated, truth, kind=None))]
pub(super) fn absolute_trajectory_error(
    estimated: &Bound<'_, PyAny>,
    truth: &Bound<'_, PyAny>,
    kind: Option<&Bound<'_, PyAny>>,
) -> PyResult<(ErrorStatistics, Similarity3)> {
    let estimated = points3("estimated", estimated)?;
    let truth = points3("truth", truth)?;
    let kind = alignment_kind(kind)?;
    let (errors, aligned) = sfm::absolute_trajectory_error(&estimated, &truth, kind).or_raise()?;
    Ok((errors.into(), Similarity3(aligned)))
}

/// Computes the relative pose error: differences of the motions over a number of frames.
///
/// Parameters
/// ----------
/// estimated, truth : list of RigidTransform
///     ``world_from_cam`` of the same frames, in order.
/// step : int, optional
///     Number of frames from the start to the end of a motion, >= 1.
///
/// Returns
/// -------
/// RelativePoseError
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are no more poses than ``step``.
/// ValueError
///     If ``step`` is 0.
#[pyfunction]
#[pyo3(signature = (estimated, truth, step=1))]
pub(super) fn relative_pose_error(
    py: Python<'_>,
    estimated: Vec<RigidTransform>,
    truth: Vec<RigidTransform>,
    step: usize,
) -> PyResult<RelativePoseError> {
    let poses = |list: Vec<RigidTransform>| list.into_iter().map(|pose| pose.0).collect::<Vec<_>>();
    let error = sfm::relative_pose_error(&poses(estimated), &poses(truth), step).or_raise()?;
    Ok(RelativePoseError {
        translation: Py::new(py, ErrorStatistics::from(error.translation))?,
        rotation_deg: Py::new(py, ErrorStatistics::from(error.rotation_deg))?,
    })
}
