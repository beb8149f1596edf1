//! Lines through points.

use super::{RansacReport, estimate};
use crate::arrays::{from_vector, points2};
use crate::errors::OrRaise;
use epipole::math::Line2;
use epipole::robust::{self, LineEstimator};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Fits the line with the smallest sum of squared distances.
///
/// Parameters
/// ----------
/// points : array_like, shape (N, 2)
///     Pixels, N >= 2.
///
/// Returns
/// -------
/// ndarray, shape (3,)
///     Line (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 points.
/// epipole.DegenerateError
///     If the points are equal, or spread equally in all directions.
#[pyfunction]
pub(super) fn fit_line_total_least_squares<'py>(
    points: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let line = robust::fit_line_total_least_squares(&points2("points", points)?).or_raise()?;
    Ok(from_vector(points.py(), &line.homogeneous()))
}

/// Fits the line with the smallest sum of Huber losses of the distances.
///
/// Parameters
/// ----------
/// points : array_like, shape (N, 2)
///     Pixels, N >= 2.
/// width_px : float
///     Distance at which the loss becomes linear, pixels, > 0.
///
/// Returns
/// -------
/// ndarray, shape (3,)
///     Line (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 points.
/// epipole.DegenerateError
///     If the points are equal, or spread equally in all directions.
/// ValueError
///     If ``width_px`` is not above 0.
#[pyfunction]
pub(super) fn fit_line_huber<'py>(
    points: &Bound<'py, PyAny>,
    width_px: f64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let line = robust::fit_line_huber(&points2("points", points)?, width_px).or_raise()?;
    Ok(from_vector(points.py(), &line.homogeneous()))
}

/// Estimates a line from points with outliers, by RANSAC.
///
/// Parameters
/// ----------
/// points : array_like, shape (N, 2)
///     Pixels.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RansacOptions
///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
///
/// Returns
/// -------
/// RansacReport of ndarray
///     Its model is the line (a, b, c): ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 points.
/// epipole.DegenerateError
///     If the points are equal.
/// epipole.NoConsensusError
///     If no line has 2 inliers.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
///
/// Examples
/// --------
/// >>> report = estimate_line([[0, 2], [1, 2], [2, 2], [3, 2], [4, 9]])
/// >>> report.num_inliers
/// 4
#[pyfunction]
#[pyo3(signature = (points, *, progress=None, **options))]
pub(super) fn estimate_line(
    py: Python<'_>,
    points: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<RansacReport> {
    let points = points2("points", points)?;
    let give = |py, model: Line2| Ok(from_vector(py, &model.homogeneous()).into_any());
    estimate(py, progress, options, give, |options, monitor| {
        robust::ransac(LineEstimator::new(&points)?, options, monitor)
    })
}
