//! Pinhole intrinsics.

use crate::arrays::{Batch, from_matrix, from_vector, matrix};
use crate::errors::OrRaise;
use crate::record::plain_class;
use epipole::camera;
use epipole::nalgebra::{Matrix3, Point2, Point3};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Pinhole intrinsics ``K = [fu 0 cu; 0 fv cv; 0 0 1]``, pixel centers at integers.
///
/// Parameters
/// ----------
/// fu_px, fv_px : float
///     Focal lengths along u and v, pixels, > 0.
/// cu_px, cv_px : float
///     Principal point, pixels.
///
/// Raises
/// ------
/// ValueError
///     If the focal length is not above 0.
#[pyclass(frozen, from_py_object, module = "epipole.camera")]
#[derive(Clone)]
pub(crate) struct Intrinsics(pub(crate) camera::Intrinsics);

impl From<camera::Intrinsics> for Intrinsics {
    fn from(intrinsics: camera::Intrinsics) -> Self {
        Self(intrinsics)
    }
}

plain_class!(Intrinsics: fu_px, fv_px, cu_px, cv_px);

#[pymethods]
impl Intrinsics {
    #[new]
    fn new(fu_px: f64, fv_px: f64, cu_px: f64, cv_px: f64) -> PyResult<Self> {
        Ok(Self(
            camera::Intrinsics::new(fu_px, fv_px, cu_px, cv_px).or_raise()?,
        ))
    }

    /// Creates intrinsics with square pixels and the principal point at the image center.
    ///
    /// Parameters
    /// ----------
    /// focal_px : float
    ///     Focal length, pixels, > 0.
    /// width, height : int
    ///     Image size, pixels.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the focal length is not above 0.
    #[staticmethod]
    fn centered(focal_px: f64, width: u32, height: u32) -> PyResult<Self> {
        Ok(Self(
            camera::Intrinsics::centered(focal_px, width, height).or_raise()?,
        ))
    }

    /// Creates intrinsics from a matrix K without skew.
    ///
    /// Parameters
    /// ----------
    /// k : array_like, shape (3, 3)
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the focal length is not above 0, or the matrix is not a K without skew.
    #[staticmethod]
    fn from_matrix(k: &Bound<'_, PyAny>) -> PyResult<Self> {
        let m: Matrix3<f64> = matrix("k", k)?;
        let (fu, fv, cu, cv) = (m[(0, 0)], m[(1, 1)], m[(0, 2)], m[(1, 2)]);
        if m != Matrix3::new(fu, 0.0, cu, 0.0, fv, cv, 0.0, 0.0, 1.0) {
            return Err(PyValueError::new_err(
                "k must be of the form [[fu, 0, cu], [0, fv, cv], [0, 0, 1]]",
            ));
        }
        Self::new(fu, fv, cu, cv)
    }

    /// Creates intrinsics from COLMAP's fx, fy, cx, cy, with pixel centers at half-integers.
    ///
    /// Parameters
    /// ----------
    /// parameters : sequence of float
    ///     fx, fy, cx, cy, pixels.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the focal length is not above 0.
    #[staticmethod]
    fn from_colmap(parameters: [f64; 4]) -> PyResult<Self> {
        Ok(Self(
            camera::Intrinsics::from_colmap(parameters).or_raise()?,
        ))
    }

    /// Returns COLMAP's parameters fx, fy, cx, cy, with pixel centers at half-integers.
    fn to_colmap(&self) -> (f64, f64, f64, f64) {
        self.0.to_colmap().into()
    }

    /// Focal length along u, pixels.
    #[getter]
    fn fu_px(&self) -> f64 {
        self.0.fu_px()
    }

    /// Focal length along v, pixels.
    #[getter]
    fn fv_px(&self) -> f64 {
        self.0.fv_px()
    }

    /// Principal point along u, pixels.
    #[getter]
    fn cu_px(&self) -> f64 {
        self.0.principal_point().x
    }

    /// Principal point along v, pixels.
    #[getter]
    fn cv_px(&self) -> f64 {
        self.0.principal_point().y
    }

    /// Returns the principal point, pixels, shape (2,).
    fn principal_point<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        from_vector(py, &self.0.principal_point().coords)
    }

    /// Returns K, shape (3, 3).
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.matrix())
    }

    /// Returns the inverse of K, shape (3, 3).
    fn inverse_matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_matrix(py, &self.0.inverse_matrix())
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
    ///     Rows of NaN for points behind the camera.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single point is given and has ``z <= 0``.
    fn project<'py>(&self, x_in_cam: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let project = |x: &_| Ok(self.0.project(&Point3::from(*x))?.coords);
        Batch::<3>::read("x_in_cam", x_in_cam)?.vectors(x_in_cam.py(), project)
    }

    /// Computes the rays through pixels, in the camera frame, with z = 1.
    ///
    /// Parameters
    /// ----------
    /// pixel : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray, shape (3,) or (N, 3)
    fn ray<'py>(&self, pixel: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let ray = |p: &_| Ok(self.0.ray(&Point2::from(*p)));
        Batch::<2>::read("pixel", pixel)?.vectors(pixel.py(), ray)
    }

    /// Returns the intrinsics for an image resized by a factor; 0.5 halves both sides.
    ///
    /// Parameters
    /// ----------
    /// factor : float
    ///     Scale factor of the image, > 0.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the factor is not above 0.
    fn scaled(&self, factor: f64) -> PyResult<Self> {
        Ok(Self(self.0.scaled(factor).or_raise()?))
    }

    /// Returns the intrinsics with both focal lengths multiplied by a factor.
    ///
    /// Parameters
    /// ----------
    /// factor : float
    ///     Factor of the focal lengths, > 0.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the factor is not above 0.
    fn zoomed(&self, factor: f64) -> PyResult<Self> {
        Ok(Self(self.0.zoomed(factor).or_raise()?))
    }

    /// Returns the intrinsics for an image resized from one (width, height) to another, pixels.
    ///
    /// Parameters
    /// ----------
    /// old, new : tuple of int
    ///     Width and height before and after resizing, pixels.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If a new side is 0 pixels long.
    #[pyo3(signature = (old, new))]
    fn resized(&self, old: (u32, u32), new: (u32, u32)) -> PyResult<Self> {
        Ok(Self(self.0.resized(old, new).or_raise()?))
    }

    /// Returns the intrinsics for an image rotated clockwise by quarter turns.
    ///
    /// Parameters
    /// ----------
    /// quarters : int
    /// size : tuple of int
    ///     Width and height before the rotation, pixels.
    fn rotated(&self, quarters: u8, size: (u32, u32)) -> Self {
        Self(self.0.rotated(quarters, size))
    }
}
