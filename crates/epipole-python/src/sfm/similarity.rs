//! Similarities of space.

use super::wrapper::wrapper;
use crate::arrays::{Batch, from_matrix, from_vector};
use crate::camera::RigidTransform;
use epipole::nalgebra::{self, Point3};
use numpy::{PyArray1, PyArray2};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Rotation, translation and scale: ``x_in_a = scale * R @ x_in_b + t``.
///
/// Parameters
/// ----------
/// isometry : RigidTransform, optional
///     Rotation and translation. The identity by default.
/// scale : float, optional
///     Greater than 0.
///
/// Raises
/// ------
/// ValueError
///     If ``scale`` is not above 0.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(crate) struct Similarity3(pub(crate) nalgebra::Similarity3<f64>);

wrapper!(Similarity3: isometry, scale);

#[pymethods]
impl Similarity3 {
    #[new]
    #[pyo3(signature = (isometry=None, scale=1.0))]
    fn new(isometry: Option<&RigidTransform>, scale: f64) -> PyResult<Self> {
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "scale must be greater than 0 and finite, but is {scale}"
            )));
        }
        let isometry = isometry.map_or_else(Default::default, |isometry| isometry.0);
        Ok(Self(nalgebra::Similarity3::from_isometry(isometry, scale)))
    }

    /// Rotation and translation.
    #[getter]
    fn isometry(&self) -> RigidTransform {
        self.0.isometry.into()
    }

    /// Scale.
    #[getter]
    fn scale(&self) -> f64 {
        self.0.scaling()
    }

    /// R, shape (3, 3).
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, self.0.isometry.rotation.to_rotation_matrix().matrix())
    }

    /// t, shape (3,).
    #[getter]
    fn translation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.isometry.translation.vector)
    }

    /// Returns the homogeneous matrix, shape (4, 4).
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.to_homogeneous())
    }

    /// Returns the inverse transform: ``b_from_a``.
    fn inverse(&self) -> Self {
        Self(self.0.inverse())
    }

    /// Composes two similarities, or transforms points.
    ///
    /// Parameters
    /// ----------
    /// other : Similarity3 or array_like, shape (3,) or (N, 3)
    ///
    /// Returns
    /// -------
    /// Similarity3 or ndarray of the same shape
    fn __matmul__<'py>(&self, other: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        if let Ok(second) = other.cast::<Self>() {
            let product = Self(self.0 * second.get().0);
            return product.into_bound_py_any(other.py());
        }
        let apply = |x: &_| Ok((self.0 * Point3::from(*x)).coords);
        Batch::<3>::read("points", other)?.vectors(other.py(), apply)
    }
}
