//! NumPy arrays to points and matrices, and back.
//!
//! Arguments are copied once, straight from the array's memory: the GIL is released while they are
//! used, and another thread could change the array meanwhile.

use epipole::nalgebra;
use nalgebra::{Matrix3, OPoint, Point2, Point3, SMatrix, SVector};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayDyn, PyUntypedArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// One point, or N of them, of D coordinates, as functions of single points take them.
pub(crate) struct Batch<const D: usize> {
    /// The points.
    pub(crate) rows: Vec<SVector<f64, D>>,
    /// Whether the caller gave one point, not an array of points.
    pub(crate) is_one: bool,
}

impl<const D: usize> Batch<D> {
    /// Reads an array of shape `(D,)` or `(N, D)`.
    pub(crate) fn read(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (numbers, shape) = numbers(name, value, || format!("({D},) or (N, {D})"))?;
        let is_one = shape.len() == 1;
        let rows = match *shape {
            [columns] | [_, columns] if columns == D => rows_of(&numbers),
            _ => {
                return Err(wrong_shape(
                    name,
                    &format!("({D},) or (N, {D})"),
                    value,
                    &shape,
                ));
            }
        };
        Ok(Self { rows, is_one })
    }

    /// One number for each point: a float, or an array of shape `(N,)`.
    pub(crate) fn numbers<'py>(
        &self,
        py: Python<'py>,
        number: impl Fn(&SVector<f64, D>) -> f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        give_numbers(py, self.is_one, self.rows.iter().map(number).collect())
    }

    /// One vector for each point: shape `(E,)` or `(N, E)`. An error is raised if there is one
    /// point, and is a row of NaN among others.
    pub(crate) fn vectors<'py, const E: usize>(
        &self,
        py: Python<'py>,
        vector: impl Fn(&SVector<f64, D>) -> epipole::Result<SVector<f64, E>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        give_vectors(py, self.is_one, self.rows.iter().map(vector).collect())
    }
}

/// Two batches of the same length, one of which may be a single point.
pub(crate) struct Pairs<const D: usize, const E: usize> {
    first: Batch<D>,
    second: Batch<E>,
}

impl<const D: usize, const E: usize> Pairs<D, E> {
    /// Reads two arrays of equal length.
    pub(crate) fn read(
        (name1, value1): (&str, &Bound<'_, PyAny>),
        (name2, value2): (&str, &Bound<'_, PyAny>),
    ) -> PyResult<Self> {
        let first = Batch::read(name1, value1)?;
        let second = Batch::read(name2, value2)?;
        let (n1, n2) = (first.rows.len(), second.rows.len());
        if n1 != n2 || first.is_one != second.is_one {
            return Err(PyValueError::new_err(format!(
                "{name1} and {name2} must have the same number of points, but have {n1} and {n2}"
            )));
        }
        Ok(Self { first, second })
    }

    /// As [`Batch::numbers`].
    pub(crate) fn numbers<'py>(
        &self,
        py: Python<'py>,
        number: impl Fn(&SVector<f64, D>, &SVector<f64, E>) -> f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let pairs = self.first.rows.iter().zip(&self.second.rows);
        let values = pairs.map(|(a, b)| number(a, b)).collect();
        give_numbers(py, self.first.is_one, values)
    }

    /// As [`Batch::vectors`].
    pub(crate) fn vectors<'py, const F: usize>(
        &self,
        py: Python<'py>,
        vector: impl Fn(&SVector<f64, D>, &SVector<f64, E>) -> epipole::Result<SVector<f64, F>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let pairs = self.first.rows.iter().zip(&self.second.rows);
        let values = pairs.map(|(a, b)| vector(a, b)).collect();
        give_vectors(py, self.first.is_one, values)
    }
}

fn give_numbers(py: Python<'_>, is_one: bool, values: Vec<f64>) -> PyResult<Bound<'_, PyAny>> {
    match *values {
        [value] if is_one => Ok(value.into_pyobject(py)?.into_any()),
        _ => Ok(PyArray1::from_vec(py, values).into_any()),
    }
}

fn give_vectors<const E: usize>(
    py: Python<'_>,
    is_one: bool,
    values: Vec<epipole::Result<SVector<f64, E>>>,
) -> PyResult<Bound<'_, PyAny>> {
    match &*values {
        [value] if is_one => {
            use crate::errors::OrRaise;
            let value = value.clone().or_raise()?;
            Ok(PyArray1::from_slice(py, value.as_slice()).into_any())
        }
        _ => {
            let or_nan = |v: epipole::Result<SVector<f64, E>>| {
                v.unwrap_or_else(|_| SVector::repeat(f64::NAN))
            };
            let rows: Vec<_> = values.into_iter().map(or_nan).collect();
            Ok(from_rows(py, &rows)?.into_any())
        }
    }
}

/// Reads an array of shape `(N, 2)`.
pub(crate) fn points2(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Point2<f64>>> {
    Ok(vectors::<2>(name, value)?
        .into_iter()
        .map(Point2::from)
        .collect())
}

/// Reads an array of shape `(N, 3)`.
pub(crate) fn points3(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<Point3<f64>>> {
    Ok(vectors::<3>(name, value)?
        .into_iter()
        .map(Point3::from)
        .collect())
}

/// Reads an array of shape `(N, D)`.
pub(crate) fn vectors<const D: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<Vec<SVector<f64, D>>> {
    let expected = || format!("(N, {D})");
    let (numbers, shape) = numbers(name, value, expected)?;
    match *shape {
        [_, columns] if columns == D => Ok(rows_of(&numbers)),
        _ => Err(wrong_shape(name, &expected(), value, &shape)),
    }
}

/// Reads an array of shape `(N, D)` with N fixed, for minimal solvers.
pub(crate) fn exactly<const N: usize, const D: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<[SVector<f64, D>; N]> {
    let expected = || format!("({N}, {D})");
    let (numbers, shape) = numbers(name, value, expected)?;
    let rows: Vec<SVector<f64, D>> = match *shape {
        [_, columns] if columns == D => rows_of(&numbers),
        _ => Vec::new(),
    };
    <[_; N]>::try_from(rows).map_err(|_| wrong_shape(name, &expected(), value, &shape))
}

/// [`exactly`], as points.
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
    let (numbers, shape) = numbers(name, value, expected)?;
    match *shape {
        [length] if length == D => Ok(SVector::from_column_slice(&numbers)),
        _ => Err(wrong_shape(name, &expected(), value, &shape)),
    }
}

/// Reads an array of shape `(R, C)`.
pub(crate) fn matrix<const R: usize, const C: usize>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<SMatrix<f64, R, C>> {
    let expected = || format!("({R}, {C})");
    let (numbers, shape) = numbers(name, value, expected)?;
    if *shape != [R, C] {
        return Err(wrong_shape(name, &expected(), value, &shape));
    }
    if numbers.iter().any(|number| number.is_infinite()) {
        return Err(PyValueError::new_err(format!("{name} contains infinity")));
    }
    Ok(SMatrix::from_row_slice(&numbers))
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

/// Numbers in row-major order, and the shape. Refuses NaN.
fn numbers(
    name: &str,
    value: &Bound<'_, PyAny>,
    expected: impl Fn() -> String,
) -> PyResult<(Vec<f64>, Vec<usize>)> {
    let array = as_array(name, value, &expected())?;
    let kind: char = array.dtype().kind().into();
    if !matches!(kind, 'f' | 'i' | 'u') {
        // An empty list is an array of floats; only a dtype without numbers ends here.
        let dtype: String = array.dtype().getattr("name")?.extract()?;
        return Err(PyTypeError::new_err(format!(
            "{name} must be an array of real numbers, but its dtype is {dtype}"
        )));
    }
    let shape = array.shape().to_vec();
    let floats = match array.cast::<PyArrayDyn<f64>>() {
        Ok(floats) if array.getattr("flags")?.getattr("aligned")?.extract()? => floats.clone(),
        _ => (array.call_method1("astype", ("float64",))?).cast_into::<PyArrayDyn<f64>>()?,
    };
    let floats = floats.readonly();
    // `as_slice` would also give the column-major memory of Fortran arrays.
    let numbers: Vec<f64> = floats.as_array().iter().copied().collect();
    if let Some(place) = numbers.iter().position(|number| number.is_nan()) {
        let row = place / shape.last().copied().unwrap_or(1).max(1);
        let place = if shape.len() > 1 {
            format!(" in row {row}")
        } else {
            String::new()
        };
        return Err(PyValueError::new_err(format!("{name} contains NaN{place}")));
    }
    Ok((numbers, shape))
}

/// `numpy.asarray`, with an error that names the argument.
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

fn rows_of<const D: usize>(numbers: &[f64]) -> Vec<SVector<f64, D>> {
    numbers
        .chunks_exact(D)
        .map(SVector::from_column_slice)
        .collect()
}

/// Array of shape `(N, D)`.
pub(crate) fn from_rows<'py, const D: usize>(
    py: Python<'py>,
    rows: &[SVector<f64, D>],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers: Vec<f64> = rows.iter().flat_map(|row| row.iter().copied()).collect();
    PyArray1::from_vec(py, numbers).reshape([rows.len(), D])
}

/// Array of shape `(R, C)`.
pub(crate) fn from_matrix<'py, const R: usize, const C: usize>(
    py: Python<'py>,
    matrix: &SMatrix<f64, R, C>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray1::from_slice(py, matrix.transpose().as_slice()).reshape([R, C])
}

/// Array of shape `(K, 3, 3)`.
pub(crate) fn from_matrices<'py>(
    py: Python<'py>,
    matrices: &[Matrix3<f64>],
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let row_major = |m: &Matrix3<f64>| m.transpose().as_slice().to_vec();
    let numbers: Vec<f64> = matrices.iter().flat_map(row_major).collect();
    PyArray1::from_vec(py, numbers).reshape([matrices.len(), 3, 3])
}

/// Array of shape `(D,)`.
pub(crate) fn from_vector<'py, const D: usize>(
    py: Python<'py>,
    vector: &SVector<f64, D>,
) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, vector.as_slice())
}
