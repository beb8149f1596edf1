//! Robust estimation.

mod estimate;
mod least_median;
mod line;
mod model;
mod report;
mod similarity;
mod stepwise;

pub(crate) use estimate::{estimate, estimator, give_matrix, give_object};
pub(crate) use report::{RansacReport, stop_reason};

use crate::errors::OrRaise;
use crate::options;
use crate::register::{classes, functions};
use epipole::robust::{self, LeastMedianOptions, RansacOptions};
use pyo3::prelude::*;

/// Returns the required number of samples if data are drawn with replacement (``w**s``).
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
/// Raises
/// ------
/// ValueError
///     If ``inlier_ratio`` is outside [0, 1], ``sample_size`` is 0, or ``confidence`` is outside
///     (0, 1).
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

/// Returns the required number of samples if data are drawn without replacement.
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
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer data than a sample needs.
/// ValueError
///     If ``num_inliers`` is above ``num_data``, ``sample_size`` is 0, or ``confidence`` is outside
///     (0, 1).
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

/// Returns the expected number of models with this support by chance, as log10.
///
/// Parameters
/// ----------
/// num_inliers, num_data, sample_size, max_models : int
/// random_inlier_probability : float
///     Probability that an unrelated data point fits a model.
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
    random_inlier_probability: f64,
) -> f64 {
    robust::log10_false_alarms(
        num_inliers,
        num_data,
        sample_size,
        max_models,
        random_inlier_probability,
    )
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("FARTHEST_PX", robust::FARTHEST_PX)?;
    options::declare(module, &RansacOptions::default())?;
    options::declare(module, &LeastMedianOptions::default())?;
    classes!(module:
        report::{RansacReport},
        least_median::{LeastMedian},
        stepwise::{Ransac, Trial},
        similarity::{PlaneSimilarity}
    );
    functions!(module:
        num_trials_with_replacement, num_trials_without_replacement, log10_false_alarms,
        line::fit_line_total_least_squares, line::fit_line_huber, line::estimate_line,
        similarity::fit_similarity, similarity::estimate_similarity, least_median::least_median,
        model::ransac
    );
    Ok(())
}
