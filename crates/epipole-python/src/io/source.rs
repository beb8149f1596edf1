//! Sources and targets of files: paths, or bytes in memory.

use crate::progress;
use epipole_io::Error;
use pyo3::exceptions::{PyOSError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::{Path, PathBuf};

/// Content of a file, with its path, if any.
pub(super) struct Source {
    /// Path as given.
    path: Option<PathBuf>,
    /// Content.
    pub(super) bytes: Vec<u8>,
}

impl Source {
    /// Reads a file, or takes bytes as they are.
    ///
    /// # Errors
    /// `OSError` naming the file, `TypeError` for another type.
    pub(super) fn read(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(bytes) = source.cast::<PyBytes>() {
            let bytes = bytes.as_bytes().to_vec();
            return Ok(Self { path: None, bytes });
        }
        let path = path(source)?;
        let bytes = progress::detach(source.py(), || std::fs::read(&path));
        Ok(Self {
            bytes: bytes.map_err(|error| os_error(&error, &path))?,
            path: Some(path),
        })
    }

    /// Returns the content as text.
    ///
    /// # Errors
    /// `ValueError` for bytes that are not UTF-8.
    pub(super) fn text(&self) -> PyResult<&str> {
        std::str::from_utf8(&self.bytes).map_err(|_| self.error("the file is not text"))
    }

    /// Returns the result of a reader, with the path at the start of an error.
    ///
    /// # Errors
    /// `ValueError`.
    pub(super) fn done<T>(&self, result: epipole_io::Result<T>) -> PyResult<T> {
        result.map_err(|error| self.error(&error.to_string()))
    }

    fn error(&self, message: &str) -> PyErr {
        PyValueError::new_err(match &self.path {
            Some(path) => format!("{}: {message}", path.display()),
            None => message.to_owned(),
        })
    }
}

/// Reads a str or an `os.PathLike`.
///
/// # Errors
/// `TypeError` for another type.
pub(super) fn path(value: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    value.extract().map_err(|_| {
        let class = value.get_type();
        let name = class
            .name()
            .map_or_else(|_| String::new(), |name| name.to_string());
        PyTypeError::new_err(format!("path must be str or os.PathLike, but is {name}"))
    })
}

/// Returns the `OSError` subclass of the errno, such as `FileNotFoundError`.
pub(super) fn os_error(error: &std::io::Error, path: &Path) -> PyErr {
    match error.raw_os_error() {
        Some(code) => {
            let text = error.to_string();
            let text = text
                .split(" (os error")
                .next()
                .unwrap_or_default()
                .to_owned();
            PyOSError::new_err((code, text, path.display().to_string()))
        }
        None => PyOSError::new_err(format!("{}: {error}", path.display())),
    }
}

/// Writes a file.
///
/// # Errors
/// `OSError` naming the file, `TypeError` for another type of path.
pub(super) fn write(target: &Bound<'_, PyAny>, bytes: &[u8]) -> PyResult<()> {
    let path = path(target)?;
    let written = progress::detach(target.py(), || std::fs::write(&path, bytes));
    written.map_err(|error| os_error(&error, &path))
}

/// Returns the result of a writer.
///
/// # Errors
/// `ValueError`.
pub(super) fn or_raise<T>(result: Result<T, Error>) -> PyResult<T> {
    result.map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Finds a format by its Python name.
///
/// # Errors
/// `ValueError` that lists the choices.
pub(super) fn format_of<F: Copy>(all: &[(&str, F)], requested: &str) -> PyResult<F> {
    let found = all.iter().find(|(name, _)| *name == requested);
    found.map(|&(_, format)| format).ok_or_else(|| {
        let names: Vec<_> = all.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let names = names.join(", ");
        PyValueError::new_err(format!(
            "format must be one of {names}, but is \"{requested}\""
        ))
    })
}
