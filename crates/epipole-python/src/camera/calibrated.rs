//! Calibrated cameras.

use super::{Intrinsics, Lens};
use crate::arrays::Batch;
use crate::record::plain_class;
use epipole::camera;
use epipole::nalgebra::{Point2, Point3};
use pyo3::prelude::*;

/// Calibrated camera with any lens.
///
/// Parameters
/// ----------
/// width, height : int
///     Image size, pixels.
/// intrinsics : Intrinsics
/// lens : Lens, optional
///     No distortion by default.
#[pyclass(frozen, from_py_object, module = "epipole.camera")]
#[derive(Clone)]
pub(crate) struct Camera(pub(crate) camera::Camera);

impl From<camera::Camera> for Camera {
    fn from(camera: camera::Camera) -> Self {
        Self(camera)
    }
}

plain_class!(Camera: width, height, intrinsics, lens);

#[pymethods]
impl Camera {
    #[new]
    #[pyo3(signature = (width, height, intrinsics, lens=None))]
    fn new(width: u32, height: u32, intrinsics: &Intrinsics, lens: Option<&Lens>) -> Self {
        Self(camera::Camera {
            width,
            height,
            intrinsics: intrinsics.0,
            lens: lens.map_or(camera::Lens::NONE, |lens| lens.0),
        })
    }

    /// Creates a camera without distortion.
    ///
    /// Parameters
    /// ----------
    /// intrinsics : Intrinsics
    /// width, height : int
    ///     Image size, pixels.
    #[staticmethod]
    fn pinhole(intrinsics: &Intrinsics, width: u32, height: u32) -> Self {
        Self(camera::Camera::pinhole(intrinsics.0, width, height))
    }

    /// Image width, pixels.
    #[getter]
    fn width(&self) -> u32 {
        self.0.width
    }

    /// Image height, pixels.
    #[getter]
    fn height(&self) -> u32 {
        self.0.height
    }

    /// K.
    #[getter]
    fn intrinsics(&self) -> Intrinsics {
        self.0.intrinsics.into()
    }

    /// Lens.
    #[getter]
    fn lens(&self) -> Lens {
        self.0.lens.into()
    }

    /// Whether the camera has no distortion.
    fn is_pinhole(&self) -> bool {
        self.0.is_pinhole()
    }

    /// Projects points in the camera frame to pixels.
    ///
    /// Parameters
    /// ----------
    /// x_in_cam : array_like, shape (3,) or (N, 3)
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
    fn project<'py>(&self, x_in_cam: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let project = |x: &_| Ok(self.0.project(&Point3::from(*x))?.coords);
        Batch::<3>::read("x_in_cam", x_in_cam)?.vectors(x_in_cam.py(), project)
    }

    /// Computes the unit rays through pixels, in the camera frame.
    ///
    /// Parameters
    /// ----------
    /// pixel : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray, shape (3,) or (N, 3)
    ///     Rows of NaN for pixels without a ray.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single pixel is given and has no ray.
    fn unproject<'py>(&self, pixel: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let unproject = |p: &_| self.0.unproject(&Point2::from(*p));
        Batch::<2>::read("pixel", pixel)?.vectors(pixel.py(), unproject)
    }

    /// Undistorts pixels: maps them to a camera with the same K and no distortion.
    ///
    /// Parameters
    /// ----------
    /// pixel : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray of the same shape
    ///     Rows of NaN for pixels without a ray.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single pixel is given and has no ray, or its ray is 90° or more off the axis.
    fn pinhole_pixel<'py>(&self, pixel: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let undistort = |p: &_| Ok(self.0.pinhole_pixel(&Point2::from(*p))?.coords);
        Batch::<2>::read("pixel", pixel)?.vectors(pixel.py(), undistort)
    }
}
