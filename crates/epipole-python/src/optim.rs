//! Least squares: reports, and problems defined in Python.

use crate::arrays::as_array;
use crate::images::{elements, wrong_shape};
use crate::record::record;
use crate::register::{classes, functions};
use crate::{options, progress};
use epipole::nalgebra::{DMatrix, DVector};
use epipole::optim::{self, DenseProblem, LmOptions, RobustLoss, Termination};
use epipole::progress::{Monitor, Status};
use numpy::PyArray1;
use numpy::prelude::*;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

record! {
    /// One attempted step.
    "epipole.optim" Iteration {
        /// Index from 1; 0 is the initial state.
        index: usize,
        /// Best cost so far.
        cost: f64,
        /// Damping of this step.
        damping: f64,
        /// Whether the step reduced the cost and was accepted.
        accepted: bool,
    }
}

record! {
    /// Report of a minimization.
    "epipole.optim" LmReport {
        /// Cost of the initial parameters.
        initial_cost: f64,
        /// Cost of the final parameters.
        final_cost: f64,
        /// Number of steps tried.
        iterations: usize,
        /// Number of steps accepted.
        accepted: usize,
        /// Reason the loop ended: "small_gradient", "small_step", "small_cost_change",
        /// "max_iterations" or "stuck".
        termination: String,
        /// Initial state and every step tried, a list of `Iteration`.
        history: Vec<Py<Iteration>>,
    }
}

#[pymethods]
impl LmReport {
    /// Whether the loop converged.
    fn is_converged(&self) -> bool {
        self.termination.starts_with("small_")
    }
}

impl LmReport {
    /// Converts a report to a Python object.
    pub(crate) fn give(py: Python<'_>, report: optim::LmReport) -> PyResult<Self> {
        let history = report.history.iter().map(|step| Iteration {
            index: step.index,
            cost: step.cost,
            damping: step.damping,
            accepted: step.accepted,
        });
        Ok(Self {
            initial_cost: report.initial_cost,
            final_cost: report.final_cost,
            iterations: report.iterations,
            accepted: report.accepted,
            termination: termination(report.termination),
            history: history
                .map(|step| Py::new(py, step))
                .collect::<PyResult<_>>()?,
        })
    }
}

/// Returns the name of the reason.
pub(crate) fn termination(termination: Termination) -> String {
    let name = match termination {
        Termination::SmallGradient => "small_gradient",
        Termination::SmallStep => "small_step",
        Termination::SmallCostChange => "small_cost_change",
        Termination::MaxIterations => "max_iterations",
        Termination::Stuck => "stuck",
    };
    name.to_owned()
}

/// First exception of a callable. It ends the run.
type Raised = Arc<Mutex<Option<PyErr>>>;

/// Problem whose residuals and Jacobian are Python callables.
struct Callables {
    num_residuals: usize,
    num_parameters: usize,
    residuals: Py<PyAny>,
    jacobian: Py<PyAny>,
    loss: RobustLoss,
    held: Vec<bool>,
    raised: Raised,
}

impl Callables {
    /// Calls a function and reads `count` numbers; NaN after an exception.
    fn call(
        &self,
        callable: &Py<PyAny>,
        name: &str,
        at: &DVector<f64>,
        shape: &[usize],
    ) -> Vec<f64> {
        let count: usize = shape.iter().product();
        let mut raised = self
            .raised
            .lock()
            .unwrap_or_else(|error| error.into_inner());
        if raised.is_some() {
            return vec![f64::NAN; count];
        }
        let answer = Python::attach(|py| {
            let answer = callable
                .bind(py)
                .call1((PyArray1::from_slice(py, at.as_slice()),))?;
            floats(name, &answer, shape)
        });
        answer.unwrap_or_else(|error| {
            *raised = Some(error);
            vec![f64::NAN; count]
        })
    }
}

/// Reads an array of a shape; NaN is allowed, since the loop rejects it.
fn floats(name: &str, value: &Bound<'_, PyAny>, shape: &[usize]) -> PyResult<Vec<f64>> {
    let expected = match *shape {
        [rows] => format!("({rows},)"),
        _ => format!("{shape:?}").replace('[', "(").replace(']', ")"),
    };
    let array = as_array(name, value, &expected)?;
    if array.shape() != shape {
        return Err(wrong_shape(name, &expected, &array)?);
    }
    elements(&array, "float64")
}

impl DenseProblem for Callables {
    fn num_residuals(&self) -> usize {
        self.num_residuals
    }

    fn residuals(&self, parameters: &DVector<f64>, residuals: &mut DVector<f64>) {
        let shape = [self.num_residuals];
        let values = self.call(&self.residuals, "result of residuals", parameters, &shape);
        residuals.copy_from_slice(&values);
    }

    fn jacobian(&self, parameters: &DVector<f64>, jacobian: &mut DMatrix<f64>) {
        let shape = [self.num_residuals, self.num_parameters];
        let values = self.call(&self.jacobian, "result of jacobian", parameters, &shape);
        jacobian.copy_from(&DMatrix::from_row_slice(shape[0], shape[1], &values));
    }

    fn loss(&self) -> RobustLoss {
        self.loss
    }

    fn is_held(&self, index: usize) -> bool {
        self.held.get(index).copied().unwrap_or(false)
    }
}

/// Monitor that stops after an exception of a callable.
struct Guard<'a> {
    monitor: &'a mut dyn Monitor,
    raised: Raised,
}

impl Monitor for Guard<'_> {
    fn report(&mut self, status: Status) -> ControlFlow<()> {
        match self.raised.lock() {
            Ok(raised) if raised.is_none() => {}
            _ => return ControlFlow::Break(()),
        }
        self.monitor.report(status)
    }
}

/// Minimizes the sum of squared residuals by Levenberg-Marquardt with QR.
///
/// Parameters
/// ----------
/// residuals : callable
///     Residuals of shape (M,) at parameters of shape (N,).
/// jacobian : callable
///     Jacobian of shape (M, N) at parameters of shape (N,).
/// parameters : array_like, shape (N,)
///     Initial parameters.
/// loss : str or dict, optional
///     Loss of each residual: ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and
///     ``"truncated"`` likewise.
/// held : list of bool, optional
///     Parameters held fixed; missing entries are free.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : LmOptions
///     ``max_iterations``, ``gradient_tolerance``, ``step_tolerance``, ``cost_tolerance``,
///     ``initial_damping``, ``patience``.
///
/// Returns
/// -------
/// parameters : ndarray, shape (N,)
/// report : LmReport
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are no residuals or no parameters.
/// ValueError
///     If the loss width is not above 0, or the initial cost or gradient is not finite.
#[pyfunction]
#[pyo3(signature = (
    residuals, jacobian, parameters, *, loss=None, held=None, progress=None, **options
))]
#[allow(clippy::too_many_arguments)]
fn minimize_dense<'py>(
    py: Python<'py>,
    residuals: Py<PyAny>,
    jacobian: Py<PyAny>,
    parameters: &Bound<'py, PyAny>,
    loss: Option<&Bound<'py, PyAny>>,
    held: Option<Vec<bool>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<(Bound<'py, PyArray1<f64>>, LmReport)> {
    let array = as_array("parameters", parameters, "(N,)")?;
    let [num_parameters] = *array.shape() else {
        return Err(wrong_shape("parameters", "(N,)", &array)?);
    };
    let start: Vec<f64> = elements(&array, "float64")?;
    let options: LmOptions = options::read(options)?;
    let first = residuals
        .bind(py)
        .call1((PyArray1::from_slice(py, &start),))?;
    let first = as_array("result of residuals", &first, "(M,)")?;
    let [num_residuals] = *first.shape() else {
        return Err(wrong_shape("result of residuals", "(M,)", &first)?);
    };
    let raised = Raised::default();
    let problem = Callables {
        num_residuals,
        num_parameters,
        residuals,
        jacobian,
        loss: options::loss(loss)?,
        held: held.unwrap_or_default(),
        raised: raised.clone(),
    };
    let mut parameters = DVector::from_vec(start);
    let report = progress::run(py, progress, |monitor| {
        let raised = raised.clone();
        let mut guard = Guard { monitor, raised };
        optim::minimize_dense(&problem, &mut parameters, &options, &mut guard)
    });
    if let Some(error) = raised.lock().ok().and_then(|mut raised| raised.take()) {
        return Err(error);
    }
    let parameters = PyArray1::from_slice(py, parameters.as_slice());
    Ok((parameters, LmReport::give(py, report?)?))
}

/// Computes the maximum difference between a Jacobian and central differences.
///
/// Parameters
/// ----------
/// analytic : array_like, shape (M, N)
/// residuals : callable
///     Residuals of shape (M,) after a step of shape (N,).
/// step : float, optional
///     Step size of the differences.
///
/// Returns
/// -------
/// float
///     Each difference is relative to the entry's magnitude or 1, whichever is larger; infinity for
///     other shapes and NaN.
///
/// Raises
/// ------
/// ValueError
///     If ``step`` is not above 0.
///
/// Examples
/// --------
/// >>> check_jacobian(np.eye(2), lambda step: step) < 1e-6
/// True
#[pyfunction]
#[pyo3(signature = (analytic, residuals, step=1e-6))]
fn check_jacobian(
    analytic: &Bound<'_, PyAny>,
    residuals: &Bound<'_, PyAny>,
    step: f64,
) -> PyResult<f64> {
    let array = as_array("analytic", analytic, "(M, N)")?;
    let [rows, columns] = *array.shape() else {
        return Err(wrong_shape("analytic", "(M, N)", &array)?);
    };
    if !(step > 0.0 && step.is_finite()) {
        let message = format!("step must be greater than 0 and finite, but is {step}");
        return Err(PyValueError::new_err(message));
    }
    let analytic = DMatrix::from_row_slice(rows, columns, &elements::<f64>(&array, "float64")?);
    let raised = Mutex::new(None);
    let after = |delta: &DVector<f64>| {
        let at = PyArray1::from_slice(residuals.py(), delta.as_slice());
        let answer = residuals.call1((at,));
        let numbers = answer.and_then(|answer| floats("result of residuals", &answer, &[rows]));
        DVector::from_vec(numbers.unwrap_or_else(|error| {
            if let Ok(mut raised) = raised.lock() {
                raised.get_or_insert(error);
            }
            vec![f64::NAN; rows]
        }))
    };
    let difference = optim::check_jacobian(&analytic, &after, step);
    match raised.into_inner() {
        Ok(Some(error)) => Err(error),
        _ => Ok(difference),
    }
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(module, &epipole::optim::LmOptions::default())?;
    classes!(module: Iteration, LmReport);
    functions!(module: minimize_dense, check_jacobian);
    Ok(())
}
