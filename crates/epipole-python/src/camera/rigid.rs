//! Rigid transforms.

use crate::arrays::{Batch, from_matrix, from_vector, matrix, vector};
use crate::record::{self, Reduced};
use epipole::camera;
use epipole::nalgebra::{Matrix3, Matrix4, Quaternion, Rotation3, Translation3, UnitQuaternion};
use numpy::{PyArray1, PyArray2};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Maximum deviation of `Rᵀ R` from the identity, and of |q|² from 1, that counts as rounding.
const ROUNDING: f64 = 1e-6;

/// Maximum deviation of |q|² from 1 at which a quaternion keeps its bits.
const LAST_BITS: f64 = 1e-14;

/// Rotation and translation: ``x_in_a = a_from_b @ x_in_b``.
///
/// Parameters
/// ----------
/// rotation : array_like, shape (3, 3), optional
///     Rotation matrix. The identity by default.
/// translation : array_like, shape (3,), optional
///     Zero by default.
///
/// Raises
/// ------
/// ValueError
///     If the matrix is not a rotation.
///
/// Examples
/// --------
/// >>> world_from_cam = RigidTransform(translation=[1, 2, 3])
/// >>> world_from_cam @ [0, 0, 5]
/// array([1., 2., 8.])
/// >>> (world_from_cam @ world_from_cam.inverse()).translation
/// array([0., 0., 0.])
#[pyclass(frozen, from_py_object, module = "epipole.camera")]
#[derive(Clone)]
pub(crate) struct RigidTransform(pub(crate) camera::RigidTransform);

impl From<camera::RigidTransform> for RigidTransform {
    fn from(transform: camera::RigidTransform) -> Self {
        Self(transform)
    }
}

#[pymethods]
impl RigidTransform {
    #[new]
    #[pyo3(signature = (rotation=None, translation=None))]
    fn new(
        rotation: Option<&Bound<'_, PyAny>>,
        translation: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let rotation = match rotation {
            Some(rotation) => unit_quaternion("rotation", rotation)?,
            None => UnitQuaternion::identity(),
        };
        Self::with_translation(rotation, translation)
    }

    /// Creates a transform from a unit quaternion (w, x, y, z).
    ///
    /// Parameters
    /// ----------
    /// quaternion : array_like, shape (4,)
    /// translation : array_like, shape (3,), optional
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the length of the quaternion is not 1.
    #[staticmethod]
    #[pyo3(signature = (quaternion, translation=None))]
    fn from_quaternion(
        quaternion: &Bound<'_, PyAny>,
        translation: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let q = vector::<4>("quaternion", quaternion)?;
        let deviation = (q.norm_squared() - 1.0).abs();
        let q = Quaternion::new(q[0], q[1], q[2], q[3]);
        if deviation.is_nan() || deviation > ROUNDING {
            return Err(PyValueError::new_err(format!(
                "quaternion must have length 1, but has length {}",
                q.norm()
            )));
        }
        let unit = if deviation <= LAST_BITS {
            UnitQuaternion::new_unchecked(q)
        } else {
            UnitQuaternion::new_normalize(q)
        };
        Self::with_translation(unit, translation)
    }

    /// R, shape (3, 3).
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, self.0.rotation.to_rotation_matrix().matrix())
    }

    /// t, shape (3,).
    #[getter]
    fn translation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.translation.vector)
    }

    /// Quaternion (w, x, y, z) of the rotation, shape (4,).
    #[getter]
    fn quaternion<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let q = self.0.rotation.quaternion();
        PyArray1::from_slice(py, &[q.w, q.i, q.j, q.k])
    }

    /// Rotation angle, radians in [0, pi].
    #[getter]
    fn angle_rad(&self) -> f64 {
        self.0.rotation.angle()
    }

    /// Returns the homogeneous matrix, shape (4, 4).
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let matrix: Matrix4<f64> = self.0.to_homogeneous();
        from_matrix(py, &matrix)
    }

    /// Returns the inverse transform: ``b_from_a``.
    fn inverse(&self) -> Self {
        self.0.inverse().into()
    }

    /// Composes two transforms, or transforms points.
    ///
    /// Parameters
    /// ----------
    /// other : RigidTransform or array_like, shape (3,) or (N, 3)
    ///
    /// Returns
    /// -------
    /// RigidTransform or ndarray of the same shape
    fn __matmul__<'py>(&self, other: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        if let Ok(second) = other.cast::<Self>() {
            let product = Self(self.0 * second.get().0);
            return product.into_bound_py_any(other.py());
        }
        let apply = |x: &_| Ok(self.0.rotation * x + self.0.translation.vector);
        Batch::<3>::read("points", other)?.vectors(other.py(), apply)
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        record::repr(slf, &["rotation", "translation"])
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        record::equal(slf, other, &["quaternion", "translation"])
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (class, fields) = record::reduce(slf, &["quaternion", "translation"])?;
        Ok((class.getattr("from_quaternion")?, fields))
    }
}

impl RigidTransform {
    fn with_translation(
        rotation: UnitQuaternion<f64>,
        translation: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let translation = match translation {
            Some(translation) => vector("translation", translation)?,
            None => Default::default(),
        };
        let translation = Translation3::from(translation);
        Ok(camera::RigidTransform::from_parts(translation, rotation).into())
    }
}

/// Reads a rotation matrix.
pub(crate) fn rotation(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Matrix3<f64>> {
    let rotation: Matrix3<f64> = matrix(name, value)?;
    let deviation = (rotation.transpose() * rotation - Matrix3::identity()).norm();
    if deviation.is_nan() || deviation > ROUNDING || rotation.determinant() < 0.0 {
        return Err(PyValueError::new_err(format!(
            "{name} must be a rotation matrix, but has determinant {} and differs from an \
             orthogonal matrix by {deviation:e}",
            rotation.determinant()
        )));
    }
    Ok(rotation)
}

fn unit_quaternion(name: &str, value: &Bound<'_, PyAny>) -> PyResult<UnitQuaternion<f64>> {
    let rotation = Rotation3::from_matrix_unchecked(rotation(name, value)?);
    Ok(UnitQuaternion::from_rotation_matrix(&rotation))
}
