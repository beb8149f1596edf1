//! Structure tensors of images.

use super::window::WindowTensor;
use crate::images::{field, from_gray, gray};
use crate::progress;
use crate::record::record;
use epipole::feature;
use numpy::PyArray2;
use numpy::prelude::*;
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Matrix ``M = sum w [[Iu*Iu, Iu*Iv], [Iu*Iv, Iv*Iv]]`` at each pixel.
    "epipole.feature" StructureTensor {
        /// ``sum w Iu*Iu``, float32 of shape (H, W).
        uu: Py<PyArray2<f32>>,
        /// ``sum w Iu*Iv``, float32 of shape (H, W).
        uv: Py<PyArray2<f32>>,
        /// ``sum w Iv*Iv``, float32 of shape (H, W).
        vv: Py<PyArray2<f32>>,
    }
}

#[pymethods]
impl StructureTensor {
    /// Returns the eigenvalues at a pixel, the larger first; None outside the image.
    ///
    /// Parameters
    /// ----------
    /// u, v : int
    ///     Column and row.
    fn eigenvalues(&self, py: Python<'_>, u: u32, v: u32) -> PyResult<Option<(f32, f32)>> {
        Ok(self
            .pixel(py, u, v)?
            .and_then(|pixel| pixel.eigenvalues(0, 0)))
    }

    /// Returns the tensor at a pixel; None outside the image.
    ///
    /// Parameters
    /// ----------
    /// u, v : int
    ///     Column and row.
    fn at(&self, py: Python<'_>, u: u32, v: u32) -> PyResult<Option<WindowTensor>> {
        let at = self.pixel(py, u, v)?.and_then(|pixel| pixel.at(0, 0));
        Ok(at.map(WindowTensor::from))
    }
}

impl StructureTensor {
    /// Returns the tensor of a single pixel.
    fn pixel(&self, py: Python<'_>, u: u32, v: u32) -> PyResult<Option<feature::StructureTensor>> {
        let (u, v) = (u as usize, v as usize);
        let at = |name: &str, array: &Py<PyArray2<f32>>| {
            let window = array.bind(py).get_item((
                pyo3::types::PySlice::new(py, v as isize, v as isize + 1, 1),
                pyo3::types::PySlice::new(py, u as isize, u as isize + 1, 1),
            ))?;
            field(name, &window)
        };
        let shape = self.uu.bind(py).shape().to_vec();
        if v >= shape[0] || u >= shape[1] {
            return Ok(None);
        }
        Ok(Some(feature::StructureTensor {
            uu: at("uu", &self.uu)?,
            uv: at("uv", &self.uv)?,
            vv: at("vv", &self.vv)?,
        }))
    }
}

/// Computes the structure tensor of an image.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : StructureTensorOptions
///     ``derivative``: ``"sobel3"``, ``"sobel5"`` or ``"scharr"``; ``window``: ``{"box": 3}`` or
///     ``{"gaussian": 1.5}``, pixels; ``scaling``: ``"textbook"`` or ``"open_cv"``; ``border``.
///
/// Returns
/// -------
/// StructureTensor
///
/// Raises
/// ------
/// ValueError
///     If a box window is outside 1 to 255 pixels, or a Gaussian window is outside (0, 31].
#[pyfunction]
#[pyo3(signature = (image, *, progress=None, **options))]
pub(super) fn structure_tensor(
    image: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<StructureTensor> {
    let py = image.py();
    let pixels = gray("image", image)?;
    let tensor = progress::run_with(py, progress, options, |options, monitor| {
        feature::structure_tensor(&pixels, options, monitor)
    })?;
    Ok(StructureTensor {
        uu: from_gray(py, tensor.uu)?.unbind(),
        uv: from_gray(py, tensor.uv)?.unbind(),
        vv: from_gray(py, tensor.vv)?.unbind(),
    })
}
