//! Run for a model of any kind, with Python objects.

use crate::errors::OrRaise;
use crate::record::record;
use crate::robust::RansacReport;
use crate::robust::model::Raised;
use crate::{options, progress};
use epipole::robust::{self, Estimator, Step};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Mutex;

record! {
    /// One sample of `Ransac` and its outcome.
    "epipole.robust" Trial {
        /// Number of the sample, from 1.
        iteration: usize,
        /// Indices of the data drawn, int64 array of shape (sample_size,).
        sample: Py<PyArray1<i64>>,
        /// Number of models from the sample.
        num_models: usize,
        /// Best of these models, or None.
        model: Option<Py<PyAny>>,
        /// Score of `model`; an upper bound if it cannot win and ``score_every_trial`` is not set.
        score: f64,
        /// Number of inliers of `model`; a lower bound in the same case.
        num_inliers: usize,
        /// Number of samples required by the best model so far; None before the first model.
        required_iterations: Option<u64>,
        /// Whether this step found the best model so far.
        is_best: bool,
        /// Best model after local optimization, or None if it was not improved.
        refined: Option<Py<PyAny>>,
    }
}

/// Run until it is finished.
pub(super) type Work = Mutex<Option<Box<dyn Run>>>;

/// Run for a model of any kind.
pub(super) trait Run: Send {
    fn step(&mut self, py: Python<'_>) -> PyResult<Option<Trial>>;
    fn start_from(&mut self, model: &Bound<'_, PyAny>) -> PyResult<()>;
    fn best_model(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>>;
    fn best_score(&self) -> Option<f64>;
    fn iterations(&self) -> usize;
    fn required_iterations(&self) -> Option<u64>;
    fn expected_iterations(&self) -> usize;
    fn finish(self: Box<Self>, py: Python<'_>) -> PyResult<RansacReport>;
}

struct Of<E: Estimator> {
    run: robust::Ransac<E>,
    /// Converts a model to a Python object.
    give: fn(Python<'_>, &E::Model) -> PyResult<Py<PyAny>>,
    /// Reads a model from a Python object.
    read: fn(&E, &Bound<'_, PyAny>) -> PyResult<E::Model>,
    raised: Raised,
}

fn required(iterations: u64) -> Option<u64> {
    (iterations < u64::MAX).then_some(iterations)
}

impl<E> Run for Of<E>
where
    E: Estimator<Model: Send + Sync> + Send,
{
    fn step(&mut self, py: Python<'_>) -> PyResult<Option<Trial>> {
        let run = &mut self.run;
        let trial = match progress::detach(py, || run.step()) {
            Step::Finished(_) => return Ok(None),
            Step::Trial(trial) => trial,
        };
        self.raised.or(Ok(()))?;
        let sample = trial.sample.iter().map(|&index| index as i64);
        let give = |model: &Option<E::Model>| {
            let model = model.as_ref().map(|model| (self.give)(py, model));
            model.transpose()
        };
        Ok(Some(Trial {
            iteration: trial.iteration,
            sample: PyArray1::from_iter(py, sample).unbind(),
            num_models: trial.num_models,
            model: give(&trial.model)?,
            score: trial.score,
            num_inliers: trial.num_inliers,
            required_iterations: required(trial.required_iterations),
            is_best: trial.is_best,
            refined: give(&trial.refined)?,
        }))
    }

    fn start_from(&mut self, model: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = model.py();
        let known = (self.read)(self.run.estimator(), model);
        let known = self.raised.or(known)?;
        let run = &mut self.run;
        progress::detach(py, || run.start_from(known));
        self.raised.or(Ok(()))
    }

    fn best_model(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        let best = self.run.best();
        best.map(|(model, _)| (self.give)(py, model)).transpose()
    }

    fn best_score(&self) -> Option<f64> {
        Some(self.run.best()?.1)
    }

    fn iterations(&self) -> usize {
        self.run.iterations()
    }

    fn required_iterations(&self) -> Option<u64> {
        required(self.run.required_iterations())
    }

    fn expected_iterations(&self) -> usize {
        self.run.expected_iterations()
    }

    fn finish(self: Box<Self>, py: Python<'_>) -> PyResult<RansacReport> {
        let Self {
            run, give, raised, ..
        } = *self;
        let report = progress::detach(py, || run.finish()).or_raise();
        let report = raised.or(report)?;
        RansacReport::give(py, report, |model| Ok(give(py, &model)?.into_bound(py)))
    }
}

/// Starts a run.
///
/// * `give`: converts a model to a Python object
/// * `read`: reads a model from a Python object
///
/// # Errors
/// Exceptions of the estimator and of the options.
pub(super) fn start<E>(
    estimator: epipole::Result<E>,
    options: Option<&Bound<'_, PyDict>>,
    give: fn(Python<'_>, &E::Model) -> PyResult<Py<PyAny>>,
    read: fn(&E, &Bound<'_, PyAny>) -> PyResult<E::Model>,
    raised: Raised,
) -> PyResult<Work>
where
    E: Estimator<Model: Send + Sync> + Send + 'static,
{
    let run = robust::Ransac::new(estimator.or_raise()?, options::read(options)?);
    let run = run.or_raise()?;
    let run: Box<dyn Run> = Box::new(Of {
        run,
        give,
        read,
        raised,
    });
    Ok(Mutex::new(Some(run)))
}
