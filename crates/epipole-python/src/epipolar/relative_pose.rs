//! Relative poses.

use crate::arrays::{from_matrix, from_vector, vector};
use crate::camera::{Intrinsics, RigidTransform, rotation};
use crate::errors::OrRaise;
use crate::record::{plain_class, record};
use epipole::epipolar;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Maximum deviation of |t|² from 1 that counts as rounding.
const ROUNDING: f64 = 1e-6;

/// Camera motion with a translation of length 1.
///
/// Parameters
/// ----------
/// rotation : array_like, shape (3, 3)
///     R of ``cam2_from_cam1``.
/// direction : array_like, shape (3,)
///     t of ``cam2_from_cam1``, of length 1.
///
/// Raises
/// ------
/// ValueError
///     If the matrix is not a rotation, or the length of the direction is not 1.
#[pyclass(frozen, from_py_object, module = "epipole.epipolar")]
#[derive(Clone)]
pub(crate) struct RelativePose(pub(crate) epipolar::RelativePose);

impl From<epipolar::RelativePose> for RelativePose {
    fn from(pose: epipolar::RelativePose) -> Self {
        Self(pose)
    }
}

plain_class!(RelativePose: rotation, direction);

#[pymethods]
impl RelativePose {
    #[new]
    fn new(rotation: &Bound<'_, PyAny>, direction: &Bound<'_, PyAny>) -> PyResult<Self> {
        let rotation = self::rotation("rotation", rotation)?;
        let direction = vector::<3>("direction", direction)?;
        let deviation = (direction.norm_squared() - 1.0).abs();
        if deviation.is_nan() || deviation > ROUNDING {
            return Err(PyValueError::new_err(format!(
                "direction must have length 1, but has length {}",
                direction.norm()
            )));
        }
        Ok(Self(epipolar::RelativePose {
            rotation,
            direction,
        }))
    }

    /// Creates a relative pose from a motion, without the length of its translation.
    ///
    /// Parameters
    /// ----------
    /// cam2_from_cam1 : epipole.camera.RigidTransform
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If the motion has no translation.
    #[staticmethod]
    fn from_motion(cam2_from_cam1: &RigidTransform) -> PyResult<Self> {
        let pose = epipolar::RelativePose::from_motion(&cam2_from_cam1.0);
        Ok(Self(pose.or_raise()?))
    }

    /// R of ``cam2_from_cam1``, shape (3, 3).
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.rotation)
    }

    /// t of ``cam2_from_cam1``, of length 1, shape (3,).
    #[getter]
    fn direction<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.direction)
    }

    /// Returns E, shape (3, 3).
    fn essential<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.essential())
    }

    /// Returns F for the pixels of two pinhole cameras, shape (3, 3).
    ///
    /// Parameters
    /// ----------
    /// k1, k2 : epipole.camera.Intrinsics
    ///     Intrinsics of the two cameras.
    fn fundamental<'py>(
        &self,
        py: Python<'py>,
        k1: &Intrinsics,
        k2: &Intrinsics,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.fundamental(&k1.0, &k2.0).or_raise()?)
    }

    /// Returns the motion as a rigid transform.
    fn cam2_from_cam1(&self) -> RigidTransform {
        self.0.cam2_from_cam1().into()
    }
}

record! {
    /// Relative pose and common focal length of two cameras.
    "epipole.epipolar" PoseWithFocal {
        /// Motion.
        pose: RelativePose,
        /// F for pixels, shape (3, 3).
        fundamental: Py<PyArray2<f64>>,
        /// Focal length of both cameras, pixels.
        focal_px: f64,
        /// Standard deviation of the focal length, pixels; None if the focal length has no effect.
        focal_std_px: Option<f64>,
    }
}

impl PoseWithFocal {
    pub(super) fn from_core(py: Python<'_>, found: epipolar::PoseWithFocal) -> PyResult<Self> {
        Ok(Self {
            pose: found.pose.into(),
            fundamental: from_matrix(py, &found.fundamental)?.unbind(),
            focal_px: found.focal_px,
            focal_std_px: found.focal_std_px,
        })
    }
}

#[pymethods]
impl PoseWithFocal {
    /// Whether the matches determine the focal length.
    fn constrains_focal(&self, py: Python<'_>) -> PyResult<bool> {
        let found = epipolar::PoseWithFocal {
            pose: self.pose.0,
            fundamental: crate::arrays::matrix("fundamental", self.fundamental.bind(py))?,
            focal_px: self.focal_px,
            focal_std_px: self.focal_std_px,
        };
        Ok(found.constrains_focal())
    }
}

record! {
    /// Essential matrix and common focal length of two cameras.
    "epipole.epipolar" EssentialWithFocal {
        /// E, shape (3, 3).
        essential: Py<PyArray2<f64>>,
        /// Focal length of both cameras, pixels.
        focal_px: f64,
    }
}

record! {
    /// Motion of an essential matrix that puts most points in front of both cameras.
    "epipole.epipolar" SelectedPose {
        /// Motion, with a translation of length 1.
        cam2_from_cam1: RigidTransform,
        /// Number of points in front of both cameras.
        num_in_front: usize,
        /// Number of points in front of both cameras for the second best motion.
        second_num_in_front: usize,
    }
}
