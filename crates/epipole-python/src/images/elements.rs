//! NumPy arrays of numbers to vectors, by dtype.

use crate::arrays::as_array;
use numpy::prelude::*;
use numpy::{Element, PyArrayDyn, PyUntypedArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Reads finite numbers of shape `(N,)`.
///
/// # Errors
/// As [`Image::read`].
pub(crate) fn column(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
    let array = real_array(name, value, "(N,)")?;
    if array.ndim() != 1 {
        return Err(wrong_shape(name, "(N,)", &array)?);
    }
    let values: Vec<f32> = elements(&array, "float32")?;
    require_finite(name, &values, 1)?;
    Ok(values)
}

/// Reads finite numbers of shape `(N, D)`: the numbers and D.
///
/// # Errors
/// As [`Image::read`].
pub(crate) fn table(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(Vec<f32>, usize)> {
    let array = real_array(name, value, "(N, D)")?;
    let [_, columns] = *array.shape() else {
        return Err(wrong_shape(name, "(N, D)", &array)?);
    };
    let values: Vec<f32> = elements(&array, "float32")?;
    require_finite(name, &values, columns)?;
    Ok((values, columns))
}

/// Array of real numbers.
pub(super) fn real_array<'py>(
    name: &str,
    value: &Bound<'py, PyAny>,
    expected: &str,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    let array = as_array(name, value, expected)?;
    if matches!(kind(&array), 'f' | 'i' | 'u') {
        return Ok(array);
    }
    Err(PyTypeError::new_err(format!(
        "{name} must be an array of real numbers, but its dtype is {}",
        dtype(&array)?
    )))
}

/// Elements in row-major order, converted to the dtype of T.
pub(crate) fn elements<T: Element + Copy>(
    array: &Bound<'_, PyUntypedArray>,
    dtype: &str,
) -> PyResult<Vec<T>> {
    let typed = match array.cast::<PyArrayDyn<T>>() {
        Ok(typed) if array.getattr("flags")?.getattr("aligned")?.extract()? => typed.clone(),
        _ => (array.call_method1("astype", (dtype,))?).cast_into::<PyArrayDyn<T>>()?,
    };
    let typed = typed.readonly();
    let view = typed.as_array();
    // The slice of the view is row-major; that of the array may be column-major.
    Ok(match view.as_slice() {
        Some(slice) => slice.to_vec(),
        None => view.iter().copied().collect(),
    })
}

/// Refuses NaN and infinity, naming the row.
///
/// # Errors
/// `ValueError` naming the argument.
pub(super) fn require_finite(name: &str, values: &[f32], columns: usize) -> PyResult<()> {
    let Some(place) = values.iter().position(|value| !value.is_finite()) else {
        return Ok(());
    };
    let what = if values[place].is_nan() {
        "NaN"
    } else {
        "infinity"
    };
    let row = place / columns.max(1);
    Err(PyValueError::new_err(format!(
        "{name} contains {what} in row {row}"
    )))
}

/// Error of an unexpected shape.
pub(crate) fn wrong_shape(
    name: &str,
    expected: &str,
    array: &Bound<'_, PyUntypedArray>,
) -> PyResult<PyErr> {
    Ok(PyValueError::new_err(format!(
        "{name} must be an array of shape {expected}, but has shape {}",
        shape_text(array)?
    )))
}

/// Shape in Python's notation.
pub(super) fn shape_text(array: &Bound<'_, PyUntypedArray>) -> PyResult<String> {
    Ok(PyTuple::new(array.py(), array.shape())?.repr()?.to_string())
}

/// Name of the dtype.
pub(crate) fn dtype(array: &Bound<'_, PyUntypedArray>) -> PyResult<String> {
    array.dtype().getattr("name")?.extract()
}

/// Kind of the dtype, such as 'f' for floats.
pub(crate) fn kind(array: &Bound<'_, PyUntypedArray>) -> char {
    array.dtype().kind().into()
}
