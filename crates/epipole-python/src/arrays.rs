//! Conversion between NumPy arrays and points or matrices.
//!
//! Arguments are copied once, straight from the array's memory: the GIL is released during the
//! computation, and another thread might change the array meanwhile.

mod batch;

pub(crate) use batch::{Batch, Pairs, match_error};

use epipole::nalgebra;
use nalgebra::{Matrix3, OPoint, Point2, Point3, SMatrix, SVector};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayDyn, PyReadonlyArrayDyn, PyUntypedArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::ops::Range;

/// Reads an array of shape `(N, 2)`.
pub(crate) fn points2(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Point2<f64>>> {
    rows(name, value, |&[u, v]| Point2::new(u, v))
}

/// Reads the arguments `pixels1` and `pixels2`, each an array of shape `(N, 2)`.
pub(crate) fn pixel_pairs(
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
) -> PyResult<[Vec<Point2<f64>>; 2]> {
    Ok([points2("pixels1", pixels1)?, points2("pixels2", pixels2)?])
}

/// Reads an array of shape `(N, 3)`.
pub(crate) fn points3(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Point3<f64>>> {
    rows(name, value, |&[x, y, z]| Point3::new(x, y, z))
}

/// Reads an array of shape `(N, D)`.
pub(crate) fn vectors<const D: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<Vec<SVector<f64, D>>> {
    rows(name, value, |&row| SVector::from(row))
}

fn rows<const D: usize, T>(
    name: &str,
    value: &Bound<'_, PyAny>,
    make: impl Fn(&[f64; D]) -> T,
) -> PyResult<Vec<T>> {
    let expected = || format!("(N, {D})");
    let numbers = Numbers::read(name, value, expected)?;
    match *numbers.shape() {
        [_, columns] if columns == D => {}
        _ => return Err(wrong_shape(name, &expected(), value, numbers.shape())),
    }
    let (rows, _) = numbers.checked(0..numbers.len())?.as_chunks();
    Ok(rows.iter().map(make).collect())
}

/// Reads an array of shape `(N, D)` with N fixed, for minimal solvers.
pub(crate) fn exactly<const N: usize, const D: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<[SVector<f64, D>; N]> {
    let expected = || format!("({N}, {D})");
    let numbers = Numbers::read(name, value, expected)?;
    if *numbers.shape() != [N, D] {
        return Err(wrong_shape(name, &expected(), value, numbers.shape()));
    }
    let numbers = numbers.checked(0..N * D)?;
    Ok(std::array::from_fn(|row| {
        SVector::from_column_slice(&numbers[row * D..(row + 1) * D])
    }))
}

/// Reads points like [`exactly`].
pub(crate) fn exact_points<const N: usize, const D: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<[OPoint<f64, nalgebra::Const<D>>; N]> {
    Ok(exactly::<N, D>(name, value)?.map(OPoint::from))
}

/// Reads an array of shape `(D,)`.
pub(crate) fn vector<const D: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<SVector<f64, D>> {
    let expected = || format!("({D},)");
    let numbers = Numbers::read(name, value, expected)?;
    match *numbers.shape() {
        [length] if length == D => Ok(SVector::from_column_slice(numbers.checked(0..D)?)),
        _ => Err(wrong_shape(name, &expected(), value, numbers.shape())),
    }
}

/// Reads an array of shape `(R, C)`.
pub(crate) fn matrix<const R: usize, const C: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<SMatrix<f64, R, C>> {
    let expected = || format!("({R}, {C})");
    let numbers = Numbers::read(name, value, expected)?;
    if *numbers.shape() != [R, C] {
        return Err(wrong_shape(name, &expected(), value, numbers.shape()));
    }
    let numbers = numbers.checked(0..R * C)?;
    if numbers.iter().any(|number| number.is_infinite()) {
        return Err(PyValueError::new_err(format!("{name} contains infinity")));
    }
    Ok(SMatrix::from_row_slice(numbers))
}

/// Reads a boolean array of shape `(N,)`.
pub(crate) fn mask(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<bool>> {
    let array = as_array(name, value, "(N,)")?;
    match array.cast::<PyArray1<bool>>() {
        Ok(mask) => Ok(mask.readonly().as_array().to_vec()),
        Err(_) => {
            let kind: String = array.dtype().getattr("name")?.extract()?;
            let shape = PyTuple::new(value.py(), array.shape())?.repr()?;
            Err(PyTypeError::new_err(format!(
                "{name} must be a boolean array of shape (N,), but is {kind} of shape {shape}"
            )))
        }
    }
}

/// Argument with real numbers, in row-major order.
struct Numbers<'a, 'py> {
    name: &'a str,
    array: PyReadonlyArrayDyn<'py, f64>,
}

impl<'a, 'py> Numbers<'a, 'py> {
    /// Reads numbers of any real dtype; copies if the dtype or order differs.
    fn read(
        name: &'a str,
        value: &Bound<'py, PyAny>,
        expected: impl Fn() -> String,
    ) -> PyResult<Self> {
        let array = match value.cast::<PyUntypedArray>() {
            Ok(array) => array.clone(),
            Err(_) => as_array(name, value, &expected())?,
        };
        let kind: char = array.dtype().kind().into();
        if !matches!(kind, 'f' | 'i' | 'u') {
            // An empty list is an array of floats; only non-numeric dtypes fail here.
            let dtype: String = array.dtype().getattr("name")?.extract()?;
            return Err(PyTypeError::new_err(format!(
                "{name} must be an array of real numbers, but its dtype is {dtype}"
            )));
        }
        let array = match array.cast::<PyArrayDyn<f64>>() {
            Ok(floats) if floats.is_c_contiguous() && is_aligned(&array)? => floats.clone(),
            _ => (array.call_method1("astype", ("float64", "C"))?).cast_into()?,
        };
        let array = array.readonly();
        Ok(Self { name, array })
    }

    fn shape(&self) -> &[usize] {
        self.array.shape()
    }

    fn len(&self) -> usize {
        self.array.len()
    }

    /// Returns a range of the numbers. Rejects NaN.
    fn checked(&self, range: Range<usize>) -> PyResult<&[f64]> {
        let start = range.start;
        let numbers = &self.array.as_slice()?[range];
        // An early exit would be slower.
        if !numbers.iter().fold(false, |nan, x| nan | x.is_nan()) {
            return Ok(numbers);
        }
        let place = numbers.iter().position(|x| x.is_nan()).unwrap_or(0);
        let place = match *self.shape() {
            [_, columns] => format!(" in row {}", (start + place) / columns.max(1)),
            _ => String::new(),
        };
        let name = self.name;
        Err(PyValueError::new_err(format!("{name} contains NaN{place}")))
    }
}

/// Returns whether elements are aligned in memory.
pub(crate) fn is_aligned(array: &Bound<'_, PyUntypedArray>) -> PyResult<bool> {
    let flags = array.getattr(intern!(array.py(), "flags"))?;
    flags.getattr(intern!(array.py(), "aligned"))?.extract()
}

/// Calls `numpy.asarray`; errors name the argument.
pub(crate) fn as_array<'py>(
    name: &str,
    value: &Bound<'py, PyAny>,
    expected: &str,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    if let Ok(array) = value.cast::<PyUntypedArray>() {
        return Ok(array.clone());
    }
    let array = (value.py().import("numpy")?)
        .call_method1("asarray", (value,))
        .map_err(|error| {
            let why = error.value(value.py());
            PyValueError::new_err(format!(
                "{name} must be an array of shape {expected}: {why}"
            ))
        })?;
    Ok(array.cast_into()?)
}

fn wrong_shape(name: &str, expected: &str, value: &Bound<'_, PyAny>, shape: &[usize]) -> PyErr {
    let shape = match PyTuple::new(value.py(), shape).and_then(|shape| shape.repr()) {
        Ok(text) => text.to_string(),
        Err(error) => return error,
    };
    PyValueError::new_err(format!(
        "{name} must be an array of shape {expected}, but has shape {shape}"
    ))
}

/// Creates an array of shape `(N, D)`.
pub(crate) fn from_rows<const D: usize>(
    py: Python<'_>,
    rows: impl IntoIterator<Item = SVector<f64, D>>,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let rows = rows.into_iter();
    let mut numbers = Vec::with_capacity(rows.size_hint().0 * D);
    rows.for_each(|row| numbers.extend_from_slice(row.as_slice()));
    let count = numbers.len() / D;
    PyArray1::from_vec(py, numbers).reshape([count, D])
}

/// Creates an array of shape `(N, D)`.
pub(crate) fn from_points<'py, const D: usize>(
    py: Python<'py>,
    points: &[OPoint<f64, nalgebra::Const<D>>],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    from_rows(py, points.iter().map(|point| point.coords))
}

/// Creates an array of shape `(R, C)`.
pub(crate) fn from_matrix<'py, const R: usize, const C: usize>(
    py: Python<'py>,
    matrix: &SMatrix<f64, R, C>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray1::from_slice(py, matrix.transpose().as_slice()).reshape([R, C])
}

/// Creates an array of shape `(K, 3, 3)`.
pub(crate) fn from_matrices<'py>(
    py: Python<'py>,
    matrices: &[Matrix3<f64>],
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let row_major = |m: &Matrix3<f64>| m.transpose().as_slice().to_vec();
    let numbers: Vec<f64> = matrices.iter().flat_map(row_major).collect();
    PyArray1::from_vec(py, numbers).reshape([matrices.len(), 3, 3])
}

/// Creates an array of shape `(D,)`.
pub(crate) fn from_vector<'py, const D: usize>(
    py: Python<'py>,
    vector: &SVector<f64, D>,
) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, vector.as_slice())
}
