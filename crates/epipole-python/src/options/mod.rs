//! Conversion of keyword options to the library's option structs.
//!
//! A struct's defaults become a dictionary, the caller's options replace entries of it, and serde
//! reads the result back. Names and defaults are defined in the library only.

mod hints;

use epipole::optim::RobustLoss;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use pythonize::{Depythonizer, pythonize};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Option struct of the library, with defaults.
pub(crate) trait Options: Default + Serialize + DeserializeOwned + Sync {}

impl<T: Default + Serialize + DeserializeOwned + Sync> Options for T {}

/// Reads keyword options on top of the defaults.
///
/// # Errors
/// `TypeError` for an unknown name or a wrong type, `ValueError` for a negative count.
pub(crate) fn read<T: Options>(options: Option<&Bound<'_, PyDict>>) -> PyResult<T> {
    match options {
        Some(options) if !options.is_empty() => read_onto(&T::default(), options),
        _ => Ok(T::default()),
    }
}

/// Reads keyword options on top of a value.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_onto<T>(defaults: &T, options: &Bound<'_, PyDict>) -> PyResult<T>
where
    T: Serialize + DeserializeOwned,
{
    let merged = pythonize(options.py(), defaults)?.cast_into::<PyDict>()?;
    merge(&merged, options, "")?;
    parse(&merged, "option")
}

/// Reads one argument, such as a loss, via serde: `"trivial"` or `{"huber": {"width": 2.0}}`.
///
/// # Errors
/// `TypeError` naming the argument.
pub(crate) fn value<T: DeserializeOwned>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<T> {
    parse(value, name)
}

/// Reads a robust loss; plain least squares by default.
///
/// # Errors
/// `TypeError` naming the argument `loss`.
pub(crate) fn loss(loss: Option<&Bound<'_, PyAny>>) -> PyResult<RobustLoss> {
    loss.map_or(Ok(RobustLoss::Trivial), |loss| value("loss", loss))
}

/// Adds an option struct to the table `_options` of a module, for the type stubs: its type hints by
/// name, and its defaults by name, without those of nested structs.
pub(crate) fn declare<T>(module: &Bound<'_, PyModule>, defaults: &T) -> PyResult<()>
where
    T: Serialize + DeserializeOwned,
{
    let py = module.py();
    if !module.hasattr("_options")? {
        module.setattr("_options", PyDict::new(py))?;
    }
    let table = module.getattr("_options")?;
    let mut structs = Vec::new();
    let name = hints::hint(&epipole_schema::describe::<T>(), &mut structs);
    for (struct_name, fields) in structs {
        let defaults = match struct_name == name {
            true => pythonize(py, defaults)?.cast_into::<PyDict>()?,
            false => PyDict::new(py),
        };
        table.set_item(struct_name, (fields.into_py_dict(py)?, defaults))?;
    }
    Ok(())
}

/// Replaces entries of `merged`. Nested structs keep entries that are not given.
fn merge(merged: &Bound<'_, PyDict>, options: &Bound<'_, PyDict>, path: &str) -> PyResult<()> {
    for (key, value) in options {
        let Some(default) = merged.get_item(&key)? else {
            let known: Vec<String> = merged.keys().extract()?;
            return Err(PyTypeError::new_err(format!(
                "unknown option {path}{key}; the options are {}",
                known.join(", ")
            )));
        };
        match (default.cast::<PyDict>(), value.cast::<PyDict>()) {
            (Ok(nested), Ok(given)) if nested.len() > 1 => {
                merge(nested, given, &format!("{path}{key}."))?;
            }
            _ => merged.set_item(key, value)?,
        }
    }
    Ok(())
}

fn parse<T: DeserializeOwned>(value: &Bound<'_, PyAny>, what: &str) -> PyResult<T> {
    let mut source = Depythonizer::from_object(value);
    serde_path_to_error::deserialize(&mut source).map_err(|error| {
        let path = error.path().to_string();
        let name = if path == "." {
            what.to_owned()
        } else {
            format!("{what} {path}")
        };
        let message = error.inner().to_string();
        // Negative or too large integers for a count.
        if message.contains("OverflowError") {
            return PyValueError::new_err(format!("{name} is out of range: {message}"));
        }
        PyTypeError::new_err(format!("{name}: {message}"))
    })
}
