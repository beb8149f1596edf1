//! Conversion of NumPy arrays of numbers to vectors, by dtype.

use crate::arrays::{as_array, is_aligned};
use numpy::prelude::*;
use numpy::{Element, PyArrayDyn, PyUntypedArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Number of elements tested together.
const BLOCK: usize = 1024;

/// Reads finite numbers of shape `(N,)`.
///
/// # Errors
/// As [`Image::read`].
pub(crate) fn column(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f32>> {
    let array = real_array(name, value, "(N,)")?;
    if array.ndim() != 1 {
        return Err(wrong_shape(name, "(N,)", &array)?);
    }
    finite_elements(name, &array, 1)
}

/// Reads finite numbers of shape `(N, D)`; returns them and D.
///
/// # Errors
/// As [`Image::read`].
pub(crate) fn table(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(Vec<f32>, usize)> {
    let array = real_array(name, value, "(N, D)")?;
    let [_, columns] = *array.shape() else {
        return Err(wrong_shape(name, "(N, D)", &array)?);
    };
    Ok((finite_elements(name, &array, columns)?, columns))
}

/// Reads an array of real numbers.
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

/// Returns elements in row-major order, converted to the dtype of T.
pub(crate) fn elements<T: Element + Copy>(
    array: &Bound<'_, PyUntypedArray>,
    dtype: &str,
) -> PyResult<Vec<T>> {
    Ok(tested_elements(array, dtype, |_| false)?.0)
}

/// Returns [`elements`] with the position of the first invalid one.
fn tested_elements<T: Element + Copy>(
    array: &Bound<'_, PyUntypedArray>,
    dtype: &str,
    is_wrong: impl Fn(T) -> bool,
) -> PyResult<(Vec<T>, Option<usize>)> {
    let typed = match array.cast::<PyArrayDyn<T>>() {
        Ok(typed) if is_aligned(array)? => typed.clone(),
        _ => (array.call_method1("astype", (dtype,))?).cast_into::<PyArrayDyn<T>>()?,
    };
    let typed = typed.readonly();
    let view = typed.as_array();
    // The slice of the view is row-major; the array's slice may be column-major.
    let Some(slice) = view.as_slice() else {
        let values: Vec<T> = view.iter().copied().collect();
        let place = first(&values, is_wrong);
        return Ok((values, place));
    };
    let (mut values, mut place) = (Vec::with_capacity(slice.len()), None);
    for block in slice.chunks(BLOCK) {
        place = place.or_else(|| Some(values.len() + first(block, &is_wrong)?));
        values.extend_from_slice(block);
    }
    Ok((values, place))
}

/// Returns finite numbers in row-major order; rows have the given length.
///
/// # Errors
/// `ValueError` with the argument and the row of NaN or infinity.
pub(super) fn finite_elements(
    name: &str,
    array: &Bound<'_, PyUntypedArray>,
    columns: usize,
) -> PyResult<Vec<f32>> {
    let (values, place) = tested_elements(array, "float32", |x: f32| !x.is_finite())?;
    let Some(place) = place else {
        return Ok(values);
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

/// Returns the position of the first invalid element.
pub(super) fn first<T: Copy>(values: &[T], is_wrong: impl Fn(T) -> bool) -> Option<usize> {
    // Blocks are tested to their end, so that the processor can test several elements at once.
    let fits = |block: &[T]| !(block.iter()).fold(false, |wrong, &x| wrong | is_wrong(x));
    let start = BLOCK * values.chunks(BLOCK).position(|block| !fits(block))?;
    let place = values[start..].iter().position(|&value| is_wrong(value))?;
    Some(start + place)
}

/// Returns the error for an unexpected shape.
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

/// Formats a shape in Python's notation.
pub(super) fn shape_text(array: &Bound<'_, PyUntypedArray>) -> PyResult<String> {
    Ok(PyTuple::new(array.py(), array.shape())?.repr()?.to_string())
}

/// Returns the name of the dtype.
pub(crate) fn dtype(array: &Bound<'_, PyUntypedArray>) -> PyResult<String> {
    array.dtype().getattr("name")?.extract()
}

/// Returns the kind of the dtype, such as 'f' for floats.
pub(crate) fn kind(array: &Bound<'_, PyUntypedArray>) -> char {
    array.dtype().kind().into()
}
