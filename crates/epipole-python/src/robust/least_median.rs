//! Least median of squares for models defined in Python.

use super::model::Callables;
use super::report::alias;
use crate::progress;
use crate::record::record;
use epipole::robust;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

record! {
    /// Result of `least_median`.
    "epipole.robust" LeastMedian {
        /// Model, fitted to its inliers.
        model: Py<PyAny>,
        /// Median error of the best model from a sample, in the unit of the errors.
        median_px: f64,
        /// Standard deviation of the noise, derived from the median, in the same unit.
        sigma_px: f64,
        /// Number of data points within 2.5 standard deviations of the model.
        num_inliers: usize,
    }
}

#[pymethods]
impl LeastMedian {
    /// Supports ``LeastMedian[MyModel]`` in annotations.
    #[classmethod]
    fn __class_getitem__(cls: &Bound<'_, PyType>, model: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        alias(cls, model)
    }
}

/// Estimates a custom model by least median of squares, without a threshold.
///
/// Parameters
/// ----------
/// num_data : int
///     Number of data points, fewer than half of them outliers.
/// sample_size : int
///     Number of data points in a minimal sample.
/// fit : callable
///     ``fit(indices)`` returns the model of a minimal sample, a list of models, or None.
/// errors : callable
///     ``errors(model)`` returns the errors of all data points, shape (num_data,).
/// refine : callable, optional
///     ``refine(model, indices)`` returns a better model from the inliers, or None.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : LeastMedianOptions
///     ``num_samples=500``, ``seed=0``.
///
/// Returns
/// -------
/// LeastMedian of Any
///
/// Raises
/// ------
/// epipole.TooFewError
///     If ``num_data`` does not exceed ``sample_size``.
/// epipole.DegenerateError
///     If no sample gives a model.
/// ValueError
///     If ``num_samples`` is 0.
///
/// Notes
/// -----
/// An exception in a callable ends the run and propagates.
///
/// Examples
/// --------
/// >>> import numpy as np
/// >>> values = np.array([1.0, 1.1, 0.9, 1.0, 30.0])
/// >>> found = least_median(5, 1, lambda i: values[i[0]], lambda model: np.abs(values - model))
/// >>> found.num_inliers
/// 4
#[pyfunction]
#[pyo3(signature = (num_data, sample_size, fit, errors, refine=None, *, progress=None, **options))]
#[allow(clippy::too_many_arguments)]
pub(super) fn least_median(
    py: Python<'_>,
    num_data: usize,
    sample_size: usize,
    fit: Py<PyAny>,
    errors: Py<PyAny>,
    refine: Option<Py<PyAny>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<LeastMedian> {
    let (model, raised) = Callables::new(num_data, sample_size, fit, errors, refine);
    let found = progress::run_with(py, progress, options, |options, monitor| {
        robust::least_median(model, options, &mut raised.watch(monitor))
    });
    let found = raised.or(found)?;
    Ok(LeastMedian {
        model: found.model.model.clone_ref(py),
        median_px: found.median_px,
        sigma_px: found.sigma_px,
        num_inliers: found.num_inliers,
    })
}
