//! Lens models.

use crate::arrays::Batch;
use crate::errors::OrRaise;
use crate::options;
use crate::record::plain_class;
use epipole::Error;
use epipole::camera;
use epipole::nalgebra::Point2;
use pyo3::prelude::*;

/// Lens model with its coefficients.
///
/// Parameters
/// ----------
/// kind : {"brown", "rational", "fisheye", "division"}
///     Model; all but the last are OpenCV's.
/// coefficients : sequence of float
///     5, 8, 4 or 1 numbers, in OpenCV's order. Zeros by default.
///
/// Raises
/// ------
/// ValueError
///     If the number of coefficients does not match the kind.
#[pyclass(frozen, from_py_object, module = "epipole.camera")]
#[derive(Clone)]
pub(crate) struct Lens(pub(crate) camera::Lens);

impl From<camera::Lens> for Lens {
    fn from(lens: camera::Lens) -> Self {
        Self(lens)
    }
}

plain_class!(Lens: kind, coefficients);

#[pymethods]
impl Lens {
    #[new]
    #[pyo3(signature = (kind=None, coefficients=None))]
    fn new(kind: Option<&Bound<'_, PyAny>>, coefficients: Option<Vec<f64>>) -> PyResult<Self> {
        let kind: camera::LensKind = match kind {
            Some(kind) => options::value("kind", kind)?,
            None => camera::LensKind::default(),
        };
        let coefficients = coefficients.unwrap_or_else(|| vec![0.0; kind.num_coefficients()]);
        Ok(Self(
            camera::Lens::from_coefficients(kind, &coefficients).or_raise()?,
        ))
    }

    /// Name of the model.
    #[getter]
    fn kind(&self) -> &'static str {
        self.0.kind().name()
    }

    /// Coefficients of the model.
    #[getter]
    fn coefficients(&self) -> Vec<f64> {
        self.0.coefficients()
    }

    /// Whether the lens has no distortion.
    fn is_none(&self) -> bool {
        self.0.is_none()
    }

    /// Projects points to distorted image points, for a focal length of 1.
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
        let project = |x: &_| Ok(self.0.project(x).ok_or(Error::PointBehindCamera)?.coords);
        Batch::<3>::read("x_in_cam", x_in_cam)?.vectors(x_in_cam.py(), project)
    }

    /// Computes the rays of distorted image points, for a focal length of 1.
    ///
    /// Parameters
    /// ----------
    /// distorted : array_like, shape (2,) or (N, 2)
    ///
    /// Returns
    /// -------
    /// ndarray, shape (3,) or (N, 3)
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If a single image point is given and has no ray; for several points, its row is NaN.
    fn ray<'py>(&self, distorted: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let ray = |p: &_| self.0.ray(&Point2::from(*p));
        Batch::<2>::read("distorted", distorted)?.vectors(distorted.py(), ray)
    }

    /// Returns the lens for an image rotated clockwise by quarter turns.
    ///
    /// Parameters
    /// ----------
    /// quarters : int
    ///     Number of quarter turns.
    fn rotated(&self, quarters: u8) -> Self {
        self.0.rotated(quarters).into()
    }
}
