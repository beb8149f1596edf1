//! Classes around values of the library, and columns of indices and colors.

use crate::arrays::as_array;
use crate::images::{dtype, elements, kind, wrong_shape};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyUntypedArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Implements everything of `shown_class`, and `__eq__`, for a class around a value of the library.
macro_rules! wrapper {
    ($class:ident: $($field:ident),+) => {
        $crate::record::shown_class!($class: $($field),+);

        #[pymethods]
        impl $class {
            fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
                other.cast::<Self>().is_ok_and(|other| other.get().0 == self.0)
            }
        }
    };
}
pub(crate) use wrapper;

/// Calls a class of another module of the package.
pub(crate) fn object<'py>(
    py: Python<'py>,
    module: &str,
    class: &str,
    arguments: impl pyo3::call::PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    py.import(module)?.getattr(class)?.call1(arguments)
}

/// Reads rows of D indices, shape `(N, D)`.
///
/// # Errors
/// `TypeError` for numbers that are not integers, `ValueError` for a wrong shape or a negative
/// index.
pub(crate) fn index_rows<const D: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<Vec<[usize; D]>> {
    let shape = format!("(N, {D})");
    let array = as_array(name, value, &shape)?;
    if array.is_empty() {
        return Ok(Vec::new());
    }
    match *array.shape() {
        [_, columns] if columns == D => {}
        _ => return Err(wrong_shape(name, &shape, &array)?),
    }
    let numbers = unsigned(name, &array)?;
    let row = |row: &[usize]| std::array::from_fn(|column| row[column]);
    Ok(numbers.chunks_exact(D).map(row).collect())
}

/// Reads indices, shape `(N,)`.
///
/// # Errors
/// As [`index_rows`].
pub(crate) fn indices(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    let array = as_array(name, value, "(N,)")?;
    match *array.shape() {
        [0] => Ok(Vec::new()),
        [_] => unsigned(name, &array),
        _ => Err(wrong_shape(name, "(N,)", &array)?),
    }
}

fn unsigned(name: &str, array: &Bound<'_, PyUntypedArray>) -> PyResult<Vec<usize>> {
    if !matches!(kind(array), 'i' | 'u') {
        return Err(PyTypeError::new_err(format!(
            "{name} must be an array of integers, but its dtype is {}",
            dtype(array)?
        )));
    }
    let numbers: Vec<i64> = elements(array, "int64")?;
    let index = |&number: &i64| {
        usize::try_from(number).map_err(|_| {
            PyValueError::new_err(format!("{name} must not be negative, but has {number}"))
        })
    };
    numbers.iter().map(index).collect()
}

/// Returns an int64 array of shape `(N, D)`.
pub(crate) fn give_index_rows<'py, const D: usize>(
    py: Python<'py>,
    rows: impl Iterator<Item = [usize; D]>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let numbers: Vec<i64> = rows.flatten().map(|index| index as i64).collect();
    let count = numbers.len() / D;
    PyArray1::from_vec(py, numbers).reshape([count, D])
}

/// Returns an int64 array of shape `(N,)`.
pub(crate) fn give_indices<'py>(py: Python<'py>, indices: &[usize]) -> Bound<'py, PyArray1<i64>> {
    PyArray1::from_iter(py, indices.iter().map(|&index| index as i64))
}

/// Reads colors, uint8 of shape `(N, 3)`; none for `None`.
///
/// # Errors
/// `TypeError` for another dtype, `ValueError` for another shape.
pub(crate) fn colors(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<[u8; 3]>> {
    let Some(value) = value else {
        return Ok(Vec::new());
    };
    let array = as_array(name, value, "(N, 3)")?;
    let [_, 3] = *array.shape() else {
        return Err(wrong_shape(name, "(N, 3)", &array)?);
    };
    if dtype(&array)? != "uint8" {
        return Err(PyTypeError::new_err(format!(
            "{name} must be uint8, but its dtype is {}",
            dtype(&array)?
        )));
    }
    let bytes: Vec<u8> = elements(&array, "uint8")?;
    Ok(bytes.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect())
}

/// Returns a uint8 array of shape `(N, 3)`.
pub(crate) fn give_colors<'py>(
    py: Python<'py>,
    colors: impl Iterator<Item = [u8; 3]>,
) -> PyResult<Bound<'py, PyArray2<u8>>> {
    let bytes: Vec<u8> = colors.flatten().collect();
    let count = bytes.len() / 3;
    PyArray1::from_vec(py, bytes).reshape([count, 3])
}

/// Rejects columns of different length.
///
/// # Errors
/// `ValueError` naming both.
pub(crate) fn require_equal(
    (name1, count1): (&str, usize),
    (name2, count2): (&str, usize),
) -> PyResult<()> {
    if count1 == count2 {
        return Ok(());
    }
    Err(PyValueError::new_err(format!(
        "{name1} and {name2} must have the same length, but have {count1} and {count2}"
    )))
}
