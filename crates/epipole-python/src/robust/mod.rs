//! Robust estimation.

mod model;
mod report;
mod similarity;

pub(crate) use report::{RansacReport, estimate, stop_reason};

use crate::arrays::{from_vector, points2};
use crate::errors::OrRaise;
use crate::options;
use epipole::robust::{self, RansacOptions};
use numpy::PyArray1;
use pyo3::prelude::*;

/// Number of samples that suffices, if data are drawn with replacement (``w**s``).
///
/// Parameters
/// ----------
/// inlier_ratio : float
///     In [0, 1].
/// sample_size : int
/// confidence : float
///     In (0, 1).
///
/// Returns
/// -------
/// int
///
/// Examples
/// --------
/// >>> num_trials_with_replacement(0.5, 7, 0.99)
/// 588
#[pyfunction]
fn num_trials_with_replacement(
    inlier_ratio: f64,
    sample_size: usize,
    confidence: f64,
) -> PyResult<u64> {
    robust::num_trials_with_replacement(inlier_ratio, sample_size, confidence).or_raise()
}

/// Number of samples that suffices, if data are drawn without replacement.
///
/// Parameters
/// ----------
/// num_inliers, num_data, sample_size : int
/// confidence : float
///     In (0, 1).
///
/// Returns
/// -------
/// int
#[pyfunction]
fn num_trials_without_replacement(
    num_inliers: usize,
    num_data: usize,
    sample_size: usize,
    confidence: f64,
) -> PyResult<u64> {
    robust::num_trials_without_replacement(num_inliers, num_data, sample_size, confidence)
        .or_raise()
}

/// Expected number of models with this support in data without structure, as log10.
///
/// Parameters
/// ----------
/// num_inliers, num_data, sample_size, max_models : int
/// chance : float
///     Probability that an unrelated datum is an inlier.
///
/// Returns
/// -------
/// float
#[pyfunction]
fn log10_false_alarms(
    num_inliers: usize,
    num_data: usize,
    sample_size: usize,
    max_models: usize,
    chance: f64,
) -> f64 {
    robust::log10_false_alarms(num_inliers, num_data, sample_size, max_models, chance)
}

/// Line with the least sum of squared distances.
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
#[pyfunction]
fn fit_line_total_least_squares<'py>(
    points: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let line = robust::fit_line_total_least_squares(&points2("points", points)?).or_raise()?;
    Ok(from_vector(points.py(), &line.homogeneous()))
}

/// Line with the least sum of Huber losses of the distances.
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
#[pyfunction]
fn fit_line_huber<'py>(
    points: &Bound<'py, PyAny>,
    width_px: f64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let line = robust::fit_line_huber(&points2("points", points)?, width_px).or_raise()?;
    Ok(from_vector(points.py(), &line.homogeneous()))
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("FARTHEST_PX", robust::FARTHEST_PX)?;
    options::declare(module, &RansacOptions::default())?;
    module.add_class::<RansacReport>()?;
    module.add_class::<similarity::PlaneSimilarity>()?;
    module.add_function(wrap_pyfunction!(num_trials_with_replacement, module)?)?;
    module.add_function(wrap_pyfunction!(num_trials_without_replacement, module)?)?;
    module.add_function(wrap_pyfunction!(log10_false_alarms, module)?)?;
    module.add_function(wrap_pyfunction!(fit_line_total_least_squares, module)?)?;
    module.add_function(wrap_pyfunction!(fit_line_huber, module)?)?;
    module.add_function(wrap_pyfunction!(similarity::fit_similarity, module)?)?;
    module.add_function(wrap_pyfunction!(similarity::estimate_similarity, module)?)?;
    module.add_function(wrap_pyfunction!(model::ransac, module)?)
}
