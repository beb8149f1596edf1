//! Jobs that Python runs step by step.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::Mutex;

/// Calls a function with an unfinished job.
///
/// # Errors
/// `RuntimeError` after `finish`, or if another thread uses it.
pub(crate) fn with<T, R>(
    work: &Mutex<Option<T>>,
    run: impl FnOnce(&mut T) -> PyResult<R>,
) -> PyResult<R> {
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
pub(crate) fn take<T>(work: &Mutex<Option<T>>) -> PyResult<T> {
    let Ok(mut work) = work.try_lock() else {
        return Err(PyRuntimeError::new_err("another thread takes a step"));
    };
    work.take()
        .ok_or_else(|| PyRuntimeError::new_err("the work is finished"))
}
