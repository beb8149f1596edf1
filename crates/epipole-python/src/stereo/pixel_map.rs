//! Maps from the pixels of a result to positions in a source image.

use crate::arrays::{as_array, matrix};
use crate::images::{Image, elements, from_gray, kind, require_size, same_kind, wrong_shape};
use crate::progress;
use epipole::nalgebra::{Matrix3, Point2};
use epipole::stereo;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2, PyArray3};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// Map from each pixel of a result to a position in a source image.
///
/// Parameters
/// ----------
/// sources : array_like of float, shape (H, W, 2)
///     (u, v) in the source, pixels; NaN for none. Stored as float32.
#[pyclass(frozen, module = "epipole.stereo")]
pub(super) struct PixelMap(pub(super) stereo::PixelMap);

crate::record::plain_class!(PixelMap: sources);

#[pymethods]
impl PixelMap {
    #[new]
    fn new(sources: &Bound<'_, PyAny>) -> PyResult<Self> {
        let array = as_array("sources", sources, "(H, W, 2)")?;
        if kind(&array) != 'f' {
            return Err(PyTypeError::new_err("sources must be an array of floats"));
        }
        let [height, width, 2] = *array.shape() else {
            return Err(wrong_shape("sources", "(H, W, 2)", &array)?);
        };
        let values: Vec<f32> = elements(&array, "float32")?;
        let source = |u: u32, v: u32| {
            let place = 2 * (v as usize * width + u as usize);
            let source = Point2::new(values[place], values[place + 1]).cast::<f64>();
            (source.x.is_finite() && source.y.is_finite()).then_some(source)
        };
        let (width, height) = (u32::try_from(width)?, u32::try_from(height)?);
        let map = progress::run(sources.py(), None, |monitor| {
            stereo::PixelMap::from_fn(width, height, source, monitor)
        });
        Ok(Self(map?))
    }

    /// Creates the map of a homography.
    ///
    /// Parameters
    /// ----------
    /// width, height : int
    ///     Size of the result, pixels.
    /// out_from_source : array_like, shape (3, 3)
    ///     Homography from pixels of the source to pixels of the result, at any scale.
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    ///
    /// Raises
    /// ------
    /// epipole.DegenerateError
    ///     If the matrix has no inverse.
    /// ValueError
    ///     If the result has more than 2**32 pixels.
    #[staticmethod]
    #[pyo3(signature = (width, height, out_from_source, *, progress=None))]
    fn from_homography(
        width: u32,
        height: u32,
        out_from_source: &Bound<'_, PyAny>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let map: Matrix3<f64> = matrix("out_from_source", out_from_source)?;
        require_size(width, height)?;
        let py = out_from_source.py();
        let map = progress::run(py, progress, |monitor| {
            stereo::PixelMap::from_homography(width, height, &map, monitor)
        });
        Ok(Self(map?))
    }

    /// Width of the result, pixels.
    #[getter]
    fn width(&self) -> u32 {
        self.0.width()
    }

    /// Height of the result, pixels.
    #[getter]
    fn height(&self) -> u32 {
        self.0.height()
    }

    /// Positions in the source, float32 of shape (H, W, 2); NaN for none.
    #[getter]
    fn sources<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let (width, height) = (self.0.width(), self.0.height());
        let mut values = Vec::with_capacity(2 * width as usize * height as usize);
        for v in 0..height {
            for u in 0..width {
                let source = self.0.source(u, v).map(|p| [p.x as f32, p.y as f32]);
                values.extend(source.unwrap_or([f32::NAN; 2]));
            }
        }
        PyArray1::from_vec(py, values).reshape([height as usize, width as usize, 2])
    }

    /// Returns the source position of pixel (u, v) of the result, shape (2,), or None.
    ///
    /// Parameters
    /// ----------
    /// u, v : int
    ///     Column and row of the result.
    fn source<'py>(&self, py: Python<'py>, u: u32, v: u32) -> Option<Bound<'py, PyArray1<f64>>> {
        let source = self.0.source(u, v)?;
        Some(PyArray1::from_slice(py, &[source.x, source.y]))
    }

    /// Warps an image, bilinearly, with 0 where nothing is read.
    ///
    /// Parameters
    /// ----------
    /// source : array_like, shape (h, w) or (h, w, 3)
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    ///
    /// Returns
    /// -------
    /// ndarray of uint8 or float32, shape (H, W) or (H, W, 3)
    ///     uint8 for a uint8 image, else float32.
    #[pyo3(signature = (source, *, progress=None))]
    fn warp<'py>(
        &self,
        source: &Bound<'py, PyAny>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = source.py();
        let image = Image::read("source", source)?;
        let warped = same_kind!(&image, |pixels| {
            progress::run(py, progress, |monitor| self.0.warp(pixels, monitor))?
        });
        warped.give(py)
    }

    /// Returns 255 where an image of the given size is read, else 0; uint8 of shape (H, W).
    ///
    /// Parameters
    /// ----------
    /// source_width, source_height : int
    ///     Size of the image, pixels.
    fn mask<'py>(
        &self,
        py: Python<'py>,
        source_width: u32,
        source_height: u32,
    ) -> PyResult<Bound<'py, PyArray2<u8>>> {
        from_gray(
            py,
            progress::detach(py, || self.0.mask(source_width, source_height)),
        )
    }
}
