//! RANSAC for models defined in Python.

use super::{RansacReport, estimate};
use epipole::progress::{Monitor, Status};
use epipole::robust::{self, Data, Estimator, Problem};
use numpy::PyArray1;
use numpy::prelude::*;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Model with its errors, computed once.
pub(super) struct Scored {
    pub(super) model: Py<PyAny>,
    errors_sq: Vec<f64>,
}

/// First exception of a callable. It ends the run.
#[derive(Clone, Default)]
pub(super) struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    fn lock(&self) -> MutexGuard<'_, Option<PyErr>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns a monitor that also cancels after an exception.
    pub(super) fn watch(&self, monitor: &mut dyn Monitor) -> impl FnMut(Status) -> ControlFlow<()> {
        |status| match *self.lock() {
            None => monitor.report(status),
            Some(_) => ControlFlow::Break(()),
        }
    }

    /// Returns the exception, if any, or else the result of the run.
    pub(super) fn or<T>(&self, found: PyResult<T>) -> PyResult<T> {
        match self.lock().take() {
            Some(error) => Err(error),
            None => found,
        }
    }
}

/// Estimator whose parts are Python callables.
pub(super) struct Callables {
    num_data: usize,
    sample_size: usize,
    fit: Py<PyAny>,
    errors: Py<PyAny>,
    refine: Option<Py<PyAny>>,
    raised: Raised,
}

impl Callables {
    /// Creates an estimator and the store for exceptions of its callables.
    pub(super) fn new(
        num_data: usize,
        sample_size: usize,
        fit: Py<PyAny>,
        errors: Py<PyAny>,
        refine: Option<Py<PyAny>>,
    ) -> (Self, Raised) {
        let raised = Raised::default();
        let model = Self {
            num_data,
            sample_size,
            fit,
            errors,
            refine,
            raised: raised.clone(),
        };
        (model, raised)
    }

    /// Scores a model from the caller; none if `errors` raises.
    pub(super) fn model(&self, model: Py<PyAny>) -> Option<Arc<Scored>> {
        self.scored(|_| Ok(vec![model])).into_iter().next()
    }

    /// Computes the errors of models; none after an exception.
    fn scored(
        &self,
        make: impl FnOnce(Python<'_>) -> PyResult<Vec<Py<PyAny>>>,
    ) -> Vec<Arc<Scored>> {
        if self.raised.lock().is_some() {
            return Vec::new();
        }
        let scored = Python::attach(|py| {
            let score = |model| self.score(py, model);
            make(py)?
                .into_iter()
                .map(score)
                .collect::<PyResult<Vec<_>>>()
        });
        scored.unwrap_or_else(|error| {
            *self.raised.lock() = Some(error);
            Vec::new()
        })
    }

    fn score(&self, py: Python<'_>, model: Py<PyAny>) -> PyResult<Arc<Scored>> {
        let errors = self.errors.bind(py).call1((&model,))?;
        let errors = py
            .import("numpy")?
            .call_method1("asarray", (errors, "float64"))?;
        let errors = errors.cast_into::<PyArray1<f64>>().map_err(|_| {
            PyValueError::new_err("errors must return an array of shape (num_data,)")
        })?;
        let errors = errors.readonly();
        let errors_sq: Vec<f64> = errors.as_array().iter().map(|e| e * e).collect();
        if errors_sq.len() != self.num_data {
            return Err(PyValueError::new_err(format!(
                "errors must return an array of shape ({},), but it has length {}",
                self.num_data,
                errors_sq.len()
            )));
        }
        Ok(Arc::new(Scored { model, errors_sq }))
    }
}

impl Estimator for Callables {
    type Model = Arc<Scored>;

    fn problem(&self) -> Problem<'_> {
        Problem {
            name: "a model",
            sample_size: self.sample_size,
            max_models: 1,
            codimension: 1,
            data: Data::Other(self.num_data),
        }
    }

    fn fit_sample(&mut self, sample: &[usize], models: &mut Vec<Self::Model>) {
        models.extend(self.scored(|py| {
            let found = self.fit.bind(py).call1((sample.to_pyarray(py),))?;
            if let Ok(list) = found.cast::<PyList>() {
                return Ok(list.iter().map(Bound::unbind).collect());
            }
            Ok(if found.is_none() {
                Vec::new()
            } else {
                vec![found.unbind()]
            })
        }));
    }

    fn error_sq(&self, model: &Self::Model, index: usize) -> f64 {
        model.errors_sq[index]
    }

    fn refine(&mut self, model: &Self::Model, inliers: &[usize], _: f64) -> Option<Self::Model> {
        let refine = self.refine.as_ref()?;
        let refined = self.scored(|py| {
            let refined = refine
                .bind(py)
                .call1((&model.model, inliers.to_pyarray(py)))?;
            Ok(if refined.is_none() {
                Vec::new()
            } else {
                vec![refined.unbind()]
            })
        });
        refined.into_iter().next()
    }
}

/// Estimates a custom model by RANSAC.
///
/// Parameters
/// ----------
/// num_data : int
///     Number of data points.
/// sample_size : int
///     Number of data points in a minimal sample.
/// fit : callable
///     ``fit(indices)`` returns the model of a minimal sample, a list of models, or None.
/// errors : callable
///     ``errors(model)`` returns the errors of all data points, shape (num_data,), in the unit of
///     ``max_error_px``.
/// refine : callable, optional
///     ``refine(model, indices)`` returns a better model from the inliers, or None.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RansacOptions
///     For example ``max_error_px=1.0``, ``confidence=0.999``, ``seed=0``.
///
/// Returns
/// -------
/// RansacReport of Any
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer data than a sample needs.
/// epipole.NoConsensusError
///     If every model has fewer inliers than a sample has data.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
///
/// Notes
/// -----
/// An exception in a callable ends the run and propagates. See `Ransac` for step-by-step runs.
#[pyfunction]
#[pyo3(signature = (num_data, sample_size, fit, errors, refine=None, *, progress=None, **options))]
#[allow(clippy::too_many_arguments)]
pub(super) fn ransac(
    py: Python<'_>,
    num_data: usize,
    sample_size: usize,
    fit: Py<PyAny>,
    errors: Py<PyAny>,
    refine: Option<Py<PyAny>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<RansacReport> {
    let (model, raised) = Callables::new(num_data, sample_size, fit, errors, refine);
    let give = |py, best: Arc<Scored>| Ok(best.model.clone_ref(py).into_bound(py));
    let found = estimate(py, progress, options, give, |options, monitor| {
        robust::ransac(model, options, &mut raised.watch(monitor))
    });
    raised.or(found)
}
