//! Errors of the library as Python exceptions.
//!
//! An argument that is invalid by itself raises a `ValueError`. Data without a result raise a
//! subclass of `epipole.Error`.

use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

create_exception!(
    epipole,
    Error,
    PyException,
    "Base class of the errors of data without a result."
);
create_exception!(epipole, TooFewError, Error, "Too few data for a result.");
create_exception!(
    epipole,
    DegenerateError,
    Error,
    "Data that do not determine the result."
);
create_exception!(
    epipole,
    NoConsensusError,
    Error,
    "No model with enough support."
);

/// Conversion of library errors.
pub(crate) trait OrRaise<T> {
    /// Returns the value, or raises the error as an exception.
    fn or_raise(self) -> PyResult<T>;
}

impl<T> OrRaise<T> for epipole::Result<T> {
    fn or_raise(self) -> PyResult<T> {
        self.map_err(|error| exception(&error))
    }
}

/// Converts an error to an exception.
pub(crate) fn exception(error: &epipole::Error) -> PyErr {
    use epipole::Error as E;
    let message = error.to_string();
    match error {
        E::TooFew { .. } | E::TooFewDistinct { .. } => TooFewError::new_err(message),
        E::Degenerate { .. } | E::PointAtInfinity | E::PointBehindCamera => {
            DegenerateError::new_err(message)
        }
        E::NoConsensus { .. } => NoConsensusError::new_err(message),
        E::Canceled => PyKeyboardInterrupt::new_err(message),
        _ => PyValueError::new_err(message),
    }
}

pub(crate) fn register(package: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = package.py();
    package.add("Error", py.get_type::<Error>())?;
    package.add("TooFewError", py.get_type::<TooFewError>())?;
    package.add("DegenerateError", py.get_type::<DegenerateError>())?;
    package.add("NoConsensusError", py.get_type::<NoConsensusError>())
}
