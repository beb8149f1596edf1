//! Jobs that Python runs step by step.

use crate::options::Options;
use crate::progress;
use epipole::progress::Monitor;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Mutex;

/// Job, until it is finished.
pub(crate) type Job<T> = Mutex<Option<T>>;

/// Starts a job with keyword options, without the GIL.
///
/// # Errors
/// As [`progress::run_with`].
pub(crate) fn start<O: Options, T: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
    work: impl FnOnce(&O, &mut dyn Monitor) -> epipole::Result<T> + Send,
) -> PyResult<Job<T>> {
    let started = progress::run_with(py, progress, options, work)?;
    Ok(Mutex::new(Some(started)))
}

/// Takes a step of an unfinished job, without the GIL.
///
/// # Errors
/// As [`with`] and [`progress::run`].
pub(crate) fn step<T: Send, R: Send>(
    job: &Job<T>,
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    step: impl FnOnce(&mut T, &mut dyn Monitor) -> epipole::Result<R> + Send,
) -> PyResult<R> {
    with(job, |work| {
        progress::run(py, progress, |monitor| step(work, monitor))
    })
}

/// Calls a function with an unfinished job.
///
/// # Errors
/// `RuntimeError` after `finish`, or if another thread uses it.
pub(crate) fn with<T, R>(work: &Job<T>, run: impl FnOnce(&mut T) -> PyResult<R>) -> PyResult<R> {
    // Waiting for the lock would hold the GIL that the other thread needs.
    let Ok(mut work) = work.try_lock() else {
        return Err(PyRuntimeError::new_err("another thread takes a step"));
    };
    match work.as_mut() {
        Some(work) => run(work),
        None => Err(PyRuntimeError::new_err("the work is finished")),
    }
}

/// Takes the job to finish it.
///
/// # Errors
/// As [`with`].
pub(crate) fn take<T>(work: &Job<T>) -> PyResult<T> {
    let Ok(mut work) = work.try_lock() else {
        return Err(PyRuntimeError::new_err("another thread takes a step"));
    };
    work.take()
        .ok_or_else(|| PyRuntimeError::new_err("the work is finished"))
}
