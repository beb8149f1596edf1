//! RANSAC, one sample at a time. Half of the lines are docstrings.

mod run;

pub(super) use run::Trial;

use super::RansacReport;
use super::model::{Callables, Raised, Scored};
use super::similarity::PlaneSimilarity;
use crate::arrays::{from_matrix, from_vector, matrix, pixel_pairs, points2, vector};
use crate::errors::OrRaise;
use crate::steps::{take, with};
use epipole::epipolar::FundamentalEstimator;
use epipole::homography::HomographyEstimator;
use epipole::math::Line2;
use epipole::nalgebra::Matrix3;
use epipole::robust::{self, Estimator, LineEstimator, MatchSet, SimilarityEstimator};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use run::{Work, start};
use std::sync::Arc;

/// RANSAC, one sample at a time: to visualize it, or to stop it by a custom rule.
///
/// The constructor takes a custom model; `line`, `similarity`, `fundamental` and `homography` start
/// runs for models of the library.
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
/// **options : RansacOptions
///     See `ransac`.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer data than a sample needs.
/// ValueError
///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
///
/// Notes
/// -----
/// A step raises the exceptions of its callables; the next step continues the run.
///
/// Examples
/// --------
/// >>> run = Ransac.line([[0, 2], [1, 2], [2, 2], [3, 2], [4, 9]])
/// >>> trial = run.step()
/// >>> trial.iteration, trial.num_models, len(trial.sample)
/// (1, 1, 2)
/// >>> sum(trial.is_best for trial in run) <= 199  # draws the other samples
/// True
/// >>> run.finish().num_inliers
/// 4
#[pyclass(frozen, module = "epipole.robust")]
pub(super) struct Ransac(Work);

fn give_matrix(py: Python<'_>, model: &Matrix3<f64>) -> PyResult<Py<PyAny>> {
    Ok(from_matrix(py, model)?.into_any().unbind())
}

fn read_matrix<E>(_: &E, model: &Bound<'_, PyAny>) -> PyResult<Matrix3<f64>> {
    matrix("model", model)
}

fn match_set(pixels1: &Bound<'_, PyAny>, pixels2: &Bound<'_, PyAny>) -> PyResult<MatchSet> {
    let [pixels1, pixels2] = pixel_pairs(pixels1, pixels2)?;
    MatchSet::new(&pixels1, &pixels2).or_raise()
}

impl Ransac {
    /// Starts a run for a model of the library.
    fn start<E>(
        estimator: epipole::Result<E>,
        options: Option<&Bound<'_, PyDict>>,
        give: fn(Python<'_>, &E::Model) -> PyResult<Py<PyAny>>,
        read: fn(&E, &Bound<'_, PyAny>) -> PyResult<E::Model>,
    ) -> PyResult<Self>
    where
        E: Estimator<Model: Send + Sync> + Send + 'static,
    {
        Ok(Self(start(
            estimator,
            options,
            give,
            read,
            Raised::default(),
        )?))
    }
}

#[pymethods]
impl Ransac {
    #[new]
    #[pyo3(signature = (num_data, sample_size, fit, errors, refine=None, **options))]
    fn new(
        num_data: usize,
        sample_size: usize,
        fit: Py<PyAny>,
        errors: Py<PyAny>,
        refine: Option<Py<PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let (model, raised) = Callables::new(num_data, sample_size, fit, errors, refine);
        let give = |py: Python<'_>, best: &Arc<Scored>| Ok(best.model.clone_ref(py));
        let read = |model: &Callables, argument: &Bound<'_, PyAny>| {
            (model.model(argument.clone().unbind()))
                .ok_or_else(|| PyTypeError::new_err("errors gave no errors of the model"))
        };
        Ok(Self(start(Ok(model), options, give, read, raised)?))
    }

    /// Starts a run for a line through points; see `estimate_line`.
    ///
    /// Parameters
    /// ----------
    /// points : array_like, shape (N, 2)
    ///     Pixels.
    /// **options : RansacOptions
    ///     See `ransac`.
    ///
    /// Returns
    /// -------
    /// Ransac
    ///     Its models are lines (a, b, c).
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 2 points.
    /// epipole.DegenerateError
    ///     If the points are equal.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    #[staticmethod]
    #[pyo3(signature = (points, **options))]
    fn line(points: &Bound<'_, PyAny>, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let estimator = LineEstimator::new(&points2("points", points)?);
        let give = |py: Python<'_>, line: &Line2| {
            Ok(from_vector(py, &line.homogeneous()).into_any().unbind())
        };
        let read = |_: &_, line: &Bound<'_, PyAny>| {
            Line2::from_homogeneous(&vector("model", line)?).or_raise()
        };
        Self::start(estimator, options, give, read)
    }

    /// Starts a run for a similarity of the plane; see `estimate_similarity`.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// **options : RansacOptions
    ///     See `ransac`.
    ///
    /// Returns
    /// -------
    /// Ransac
    ///     Its models are `PlaneSimilarity`.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 2 different matches.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    #[staticmethod]
    #[pyo3(signature = (pixels1, pixels2, **options))]
    fn similarity(
        pixels1: &Bound<'_, PyAny>,
        pixels2: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let estimator = SimilarityEstimator::new(match_set(pixels1, pixels2)?);
        let give = |py: Python<'_>, &model: &robust::PlaneSimilarity| {
            Ok(Py::new(py, PlaneSimilarity::from(model))?.into_any())
        };
        let read = |_: &_, model: &Bound<'_, PyAny>| match model.cast::<PlaneSimilarity>() {
            Ok(model) => Ok(model.get().core()),
            Err(_) => Err(PyTypeError::new_err(format!(
                "model must be a PlaneSimilarity, but is {}",
                model.get_type().name()?
            ))),
        };
        Self::start(Ok(estimator), options, give, read)
    }

    /// Starts a run for a fundamental matrix; see `epipole.epipolar.estimate_fundamental`.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// **options : RansacOptions
    ///     See `ransac`.
    ///
    /// Returns
    /// -------
    /// Ransac
    ///     Its models are F, shape (3, 3).
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 7 different matches.
    /// epipole.DegenerateError
    ///     If all pixels of an image are on a line.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    #[staticmethod]
    #[pyo3(signature = (pixels1, pixels2, **options))]
    fn fundamental(
        pixels1: &Bound<'_, PyAny>,
        pixels2: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let estimator = FundamentalEstimator::new(match_set(pixels1, pixels2)?);
        Self::start(estimator, options, give_matrix, read_matrix)
    }

    /// Starts a run for a homography; see `epipole.homography.estimate_homography`.
    ///
    /// Parameters
    /// ----------
    /// pixels1, pixels2 : array_like, shape (N, 2)
    ///     Matches.
    /// **options : RansacOptions
    ///     See `ransac`.
    ///
    /// Returns
    /// -------
    /// Ransac
    ///     Its models are H, shape (3, 3).
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 4 different matches.
    /// epipole.DegenerateError
    ///     If all pixels of an image are on a line.
    /// ValueError
    ///     If ``max_error_px``, ``confidence`` or ``max_iterations`` is out of range.
    #[staticmethod]
    #[pyo3(signature = (pixels1, pixels2, **options))]
    fn homography(
        pixels1: &Bound<'_, PyAny>,
        pixels2: &Bound<'_, PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let estimator = HomographyEstimator::new(match_set(pixels1, pixels2)?);
        Self::start(estimator, options, give_matrix, read_matrix)
    }

    /// Improves a known model, such as that of the previous frame, and starts from it.
    ///
    /// Parameters
    /// ----------
    /// model : object
    ///     Model of the kind that the run estimates.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If the line of a run of `line` is (0, 0, c).
    /// RuntimeError
    ///     If the run is finished, or another thread uses it.
    fn start_from(&self, model: &Bound<'_, PyAny>) -> PyResult<()> {
        with(&self.0, |run| run.start_from(model))
    }

    /// Draws a sample and returns a `Trial`; None once enough samples were drawn.
    ///
    /// Raises
    /// ------
    /// RuntimeError
    ///     If the run is finished, or another thread uses it.
    fn step(&self, py: Python<'_>) -> PyResult<Option<Trial>> {
        with(&self.0, |run| run.step(py))
    }

    /// Returns an iterator over the remaining trials.
    fn __iter__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    /// Returns the next trial.
    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Trial>> {
        self.step(py)
    }

    /// Best model so far, or None.
    ///
    /// Returns
    /// -------
    /// Any
    #[getter]
    fn best_model(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        with(&self.0, |run| run.best_model(py))
    }

    /// Score of the best model so far, or None.
    #[getter]
    fn best_score(&self) -> PyResult<Option<f64>> {
        with(&self.0, |run| Ok(run.best_score()))
    }

    /// Number of samples drawn so far.
    #[getter]
    fn iterations(&self) -> PyResult<usize> {
        with(&self.0, |run| Ok(run.iterations()))
    }

    /// Number of samples required by the best model so far; None before the first model.
    #[getter]
    fn required_iterations(&self) -> PyResult<Option<u64>> {
        with(&self.0, |run| Ok(run.required_iterations()))
    }

    /// Number of samples after which the run ends unless a better model is found.
    #[getter]
    fn expected_iterations(&self) -> PyResult<usize> {
        with(&self.0, |run| Ok(run.expected_iterations()))
    }

    /// Improves the best model once more and ends the run.
    ///
    /// Returns
    /// -------
    /// RansacReport of Any
    ///     ``stop`` is "interrupted" if more samples were required.
    ///
    /// Raises
    /// ------
    /// epipole.NoConsensusError
    ///     If every model has fewer inliers than a sample has data.
    /// RuntimeError
    ///     If the run is finished, or another thread uses it.
    fn finish(&self, py: Python<'_>) -> PyResult<RansacReport> {
        take(&self.0)?.finish(py)
    }
}
