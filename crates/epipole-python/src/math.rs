//! Lines, positions on the earth, singular values, seeded random numbers.

use crate::arrays::{as_array, from_matrix, from_vector, matrix, vector};
use crate::errors::OrRaise;
use crate::images::{elements, wrong_shape};
use crate::record::record;
use crate::register::{classes, functions};
use crate::sfm::wrapper::wrapper;
use epipole::math;
use epipole::nalgebra::{Point2, Vector3, Vector4};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Position on the earth (WGS 84).
///
/// Parameters
/// ----------
/// latitude_deg : float
///     Latitude north of the equator, degrees, -90 to 90.
/// longitude_deg : float
///     Longitude east of Greenwich, degrees, -180 to 180.
/// height_m : float
///     Height above the ellipsoid, meters.
#[pyclass(frozen, from_py_object, module = "epipole.math")]
#[derive(Clone)]
pub(crate) struct Geodetic(pub(crate) math::Geodetic);

wrapper!(Geodetic: latitude_deg, longitude_deg, height_m);

#[pymethods]
impl Geodetic {
    #[new]
    fn new(latitude_deg: f64, longitude_deg: f64, height_m: f64) -> Self {
        Self(math::Geodetic {
            latitude_deg,
            longitude_deg,
            height_m,
        })
    }

    /// Latitude north of the equator, degrees.
    #[getter]
    fn latitude_deg(&self) -> f64 {
        self.0.latitude_deg
    }

    /// Longitude east of Greenwich, degrees.
    #[getter]
    fn longitude_deg(&self) -> f64 {
        self.0.longitude_deg
    }

    /// Height above the ellipsoid, meters.
    #[getter]
    fn height_m(&self) -> f64 {
        self.0.height_m
    }
}

/// Converts a position to east, north and up relative to an origin.
///
/// Parameters
/// ----------
/// place, origin : Geodetic
///
/// Returns
/// -------
/// ndarray, shape (3,)
///     Meters.
///
/// Raises
/// ------
/// ValueError
///     If the latitude is outside -90° to 90°, or the longitude outside -180° to 180°.
#[pyfunction]
fn local_from_geodetic<'py>(
    py: Python<'py>,
    place: &Geodetic,
    origin: &Geodetic,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let local = math::local_from_geodetic(&place.0, &origin.0).or_raise()?;
    Ok(from_vector(py, &local.coords))
}

/// Line ``a*u + b*v + c == 0`` with ``a**2 + b**2 == 1``.
///
/// Parameters
/// ----------
/// line : array_like, shape (3,)
///     Homogeneous line, at any scale.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the line is (0, 0, c).
#[pyclass(frozen, module = "epipole.math")]
struct Line2(math::Line2);

wrapper!(Line2: line);

#[pymethods]
impl Line2 {
    #[new]
    fn new(line: &Bound<'_, PyAny>) -> PyResult<Self> {
        let line: Vector3<f64> = vector("line", line)?;
        // Keep the bits of a line that already has this scale.
        if (line.x * line.x + line.y * line.y - 1.0).abs() < 1e-15 {
            let (a, b, c) = (line.x, line.y, line.z);
            return Ok(Self(math::Line2 { a, b, c }));
        }
        Ok(Self(math::Line2::from_homogeneous(&line).or_raise()?))
    }

    /// Creates the line of a homogeneous vector.
    ///
    /// Parameters
    /// ----------
    /// line : array_like, shape (3,)
    ///     At any scale.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If the line is (0, 0, c).
    #[staticmethod]
    fn from_homogeneous(line: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::new(line)
    }

    /// Creates the line through two points.
    ///
    /// Parameters
    /// ----------
    /// p, q : array_like, shape (2,)
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If the points are equal.
    #[staticmethod]
    fn through(p: &Bound<'_, PyAny>, q: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (p, q) = (Point2::from(vector("p", p)?), Point2::from(vector("q", q)?));
        Ok(Self(math::Line2::through(&p, &q).or_raise()?))
    }

    /// (a, b, c), shape (3,).
    #[getter]
    fn line<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.homogeneous(py)
    }

    /// Component of the normal along u.
    #[getter]
    fn a(&self) -> f64 {
        self.0.a
    }

    /// Component of the normal along v.
    #[getter]
    fn b(&self) -> f64 {
        self.0.b
    }

    /// Negated signed distance of the origin along the normal.
    #[getter]
    fn c(&self) -> f64 {
        self.0.c
    }

    /// Returns (a, b, c), shape (3,).
    fn homogeneous<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.homogeneous())
    }

    /// Returns the signed distance of a point.
    ///
    /// Parameters
    /// ----------
    /// point : array_like, shape (2,)
    fn signed_distance(&self, point: &Bound<'_, PyAny>) -> PyResult<f64> {
        let point = Point2::from(vector("point", point)?);
        Ok(self.0.signed_distance(&point))
    }

    /// Returns the point of the line nearest to a point.
    ///
    /// Parameters
    /// ----------
    /// point : array_like, shape (2,)
    ///
    /// Returns
    /// -------
    /// ndarray, shape (2,)
    fn nearest<'py>(&self, point: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let place = Point2::from(vector("point", point)?);
        Ok(from_vector(point.py(), &self.0.nearest(&place).coords))
    }

    /// Returns the angle of the line to the u axis, radians.
    fn angle_rad(&self) -> f64 {
        self.0.angle_rad()
    }
}

record! {
    /// Singular value decomposition: ``A = u @ diag(singular_values) @ v.T``.
    "epipole.math" Svd3 {
        /// Left singular vectors as columns, shape (3, 3).
        u: Py<PyArray2<f64>>,
        /// Singular values, largest first, none negative, shape (3,).
        singular_values: Py<PyArray1<f64>>,
        /// Right singular vectors as columns, shape (3, 3).
        v: Py<PyArray2<f64>>,
    }
}

/// Computes the singular value decomposition of a matrix.
///
/// Parameters
/// ----------
/// matrix : array_like, shape (3, 3)
///
/// Returns
/// -------
/// Svd3
#[pyfunction]
fn svd3(matrix: &Bound<'_, PyAny>) -> PyResult<Svd3> {
    let svd = math::svd3(&self::matrix("matrix", matrix)?);
    let py = matrix.py();
    Ok(Svd3 {
        u: from_matrix(py, &svd.u)?.unbind(),
        singular_values: from_vector(py, &svd.singular_values).unbind(),
        v: from_matrix(py, &svd.v)?.unbind(),
    })
}

/// Computes the length of a vector.
///
/// Parameters
/// ----------
/// vector : array_like, shape (N,)
///     N from 1 to 4.
///
/// Returns
/// -------
/// float
///
/// Examples
/// --------
/// >>> length([3.0, 4.0])
/// 5.0
#[pyfunction]
fn length(vector: &Bound<'_, PyAny>) -> PyResult<f64> {
    let array = as_array("vector", vector, "(N,)")?;
    let numbers: Vec<f64> = elements(&array, "float64")?;
    if !matches!(*array.shape(), [1..=4]) {
        return Err(wrong_shape("vector", "(N,) with N <= 4", &array)?);
    }
    // Zeros do not change the length.
    let at = |place: usize| numbers.get(place).copied().unwrap_or(0.0);
    Ok(math::length(&Vector4::new(at(0), at(1), at(2), at(3))))
}

/// Seeded stream of random numbers, equal on every platform.
///
/// Parameters
/// ----------
/// seed : int
#[pyclass(frozen, module = "epipole.math")]
struct Random(Mutex<math::random::Random>);

impl Random {
    fn stream(&self) -> MutexGuard<'_, math::random::Random> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Random {
    #[new]
    fn new(seed: u64) -> Self {
        Self(Mutex::new(math::random::Random::new(seed)))
    }

    /// Returns an integer below a bound.
    ///
    /// Parameters
    /// ----------
    /// bound : int
    ///     Upper bound, > 0, exclusive.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If ``bound`` is 0.
    fn below(&self, bound: usize) -> PyResult<usize> {
        if bound == 0 {
            return Err(PyValueError::new_err("bound must be greater than 0"));
        }
        Ok(self.stream().below(bound))
    }

    /// Returns a number in [0, 1).
    fn unit(&self) -> f64 {
        self.stream().unit()
    }

    /// Returns a number in [low, high).
    ///
    /// Parameters
    /// ----------
    /// low, high : float
    ///     Bounds of the interval.
    fn uniform(&self, low: f64, high: f64) -> f64 {
        self.stream().uniform(low, high)
    }

    /// Returns a number from the standard normal distribution.
    fn normal(&self) -> f64 {
        self.stream().normal()
    }
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    classes!(module: Geodetic, Line2, Svd3);
    functions!(module: local_from_geodetic, svd3, length);
    classes!(module: Random);
    Ok(())
}
