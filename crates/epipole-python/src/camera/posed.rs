//! Cameras in the world.

use super::{Camera, RigidTransform};
use crate::arrays::{Batch, from_matrix, from_vector};
use crate::record::plain_class;
use epipole::camera;
use epipole::nalgebra::{Point2, Point3};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

/// Camera with a pose in the world.
///
/// Parameters
/// ----------
/// camera : Camera
/// cam_from_world : RigidTransform
///     ``x_in_cam = cam_from_world @ x_in_world``
#[pyclass(frozen, from_py_object, module = "epipole.camera")]
#[derive(Clone)]
pub(crate) struct PosedCamera(pub(crate) camera::PosedCamera);

impl From<camera::PosedCamera> for PosedCamera {
    fn from(camera: camera::PosedCamera) -> Self {
        Self(camera)
    }
}

plain_class!(PosedCamera: camera, cam_from_world);

#[pymethods]
impl PosedCamera {
    #[new]
    fn new(camera: &Camera, cam_from_world: &RigidTransform) -> Self {
        Self(camera::PosedCamera {
            camera: camera.0,
            cam_from_world: cam_from_world.0,
        })
    }

    /// Image size, intrinsics and lens.
    #[getter]
    fn camera(&self) -> Camera {
        self.0.camera.into()
    }

    /// Pose: ``x_in_cam = cam_from_world @ x_in_world``.
    #[getter]
    fn cam_from_world(&self) -> RigidTransform {
        self.0.cam_from_world.into()
    }

    /// Returns the center of the camera in the world, shape (3,).
    fn center_in_world<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.center_in_world().coords)
    }

    /// Returns ``P = K [R t]``, shape (3, 4), for undistorted pixels.
    fn projection_matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.projection_matrix())
    }

    /// Projects points in the world to pixels.
    ///
    /// Parameters
    /// ----------
    /// x_in_world : array_like, shape (3,) or (N, 3)
    ///
    /// Returns
    /// -------
    /// ndarray, shape (2,) or (N, 2)
    ///     Rows of NaN for points that the lens does not see.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single point is given and the lens does not see it.
    fn project<'py>(&self, x_in_world: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let project = |x: &_| Ok(self.0.project(&Point3::from(*x))?.coords);
        Batch::<3>::read("x_in_world", x_in_world)?.vectors(x_in_world.py(), project)
    }

    /// Computes the rays through undistorted pixels, in the world, with a depth of 1.
    ///
    /// Parameters
    /// ----------
    /// pinhole_pixel : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray, shape (3,) or (N, 3)
    fn ray_in_world<'py>(&self, pinhole_pixel: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let ray = |p: &_| Ok(self.0.ray_in_world(&Point2::from(*p)));
        Batch::<2>::read("pinhole_pixel", pinhole_pixel)?.vectors(pinhole_pixel.py(), ray)
    }
}
