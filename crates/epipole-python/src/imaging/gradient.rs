//! Image gradients.

use crate::images::{Gray, field, from_gray};
use crate::record::record;
use crate::{options, progress};
use epipole::imaging::{self, DerivativeFilter};
use numpy::PyArray2;
use pyo3::prelude::*;

record! {
    /// Partial derivatives of an image, in units of the filter.
    "epipole.imaging" Gradient {
        /// Derivative along u, to the right, float32 of shape (H, W).
        du: Py<PyArray2<f32>>,
        /// Derivative along v, downwards, float32 of shape (H, W).
        dv: Py<PyArray2<f32>>,
    }
}

impl Gradient {
    fn give(py: Python<'_>, gradient: imaging::Gradient) -> PyResult<Self> {
        Ok(Self {
            du: from_gray(py, gradient.du)?.unbind(),
            dv: from_gray(py, gradient.dv)?.unbind(),
        })
    }

    fn core(&self, py: Python<'_>) -> PyResult<imaging::Gradient> {
        Ok(imaging::Gradient {
            du: field("du", self.du.bind(py))?,
            dv: field("dv", self.dv.bind(py))?,
        })
    }
}

#[pymethods]
impl Gradient {
    /// Returns the steepest slope at each pixel, shape (H, W).
    fn magnitude<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let gradient = self.core(py)?;
        from_gray(py, progress::detach(py, || gradient.magnitude()))
    }

    /// Returns the direction of ascent, ``arctan2(dv, du)``, radians, shape (H, W); 0 where flat.
    fn orientation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let gradient = self.core(py)?;
        from_gray(py, progress::detach(py, || gradient.orientation()))
    }
}

/// Computes the gradient by an integer filter, not divided by its gain.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// kind : str, optional
///     ``"sobel3"`` (gain 8), ``"sobel5"`` (128) or ``"scharr"`` (32).
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// Gradient
#[pyfunction]
#[pyo3(signature = (image, kind=None, border=None))]
pub(super) fn derivative(
    image: &Bound<'_, PyAny>,
    kind: Option<&Bound<'_, PyAny>>,
    border: Option<&Bound<'_, PyAny>>,
) -> PyResult<Gradient> {
    let gray = Gray::read("image", image)?;
    let kind: DerivativeFilter = match kind {
        Some(kind) => options::value("kind", kind)?,
        None => DerivativeFilter::default(),
    };
    let border = gray.border(border)?;
    let gradient = progress::detach(image.py(), || {
        imaging::derivative(&gray.pixels, kind, border)
    });
    Gradient::give(image.py(), gradient)
}

/// Computes the gradient by central differences, as slopes per pixel.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// Gradient
#[pyfunction]
#[pyo3(signature = (image, border=None))]
pub(super) fn centered_difference(
    image: &Bound<'_, PyAny>,
    border: Option<&Bound<'_, PyAny>>,
) -> PyResult<Gradient> {
    let gray = Gray::read("image", image)?;
    let border = gray.border(border)?;
    let gradient = progress::detach(image.py(), || {
        imaging::centered_difference(&gray.pixels, border)
    });
    Gradient::give(image.py(), gradient)
}

/// Computes the gradient by the 3x3 Sobel filter, 8 times the slope per pixel.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// Gradient
#[pyfunction]
#[pyo3(signature = (image, border=None))]
pub(super) fn sobel(
    image: &Bound<'_, PyAny>,
    border: Option<&Bound<'_, PyAny>>,
) -> PyResult<Gradient> {
    let gray = Gray::read("image", image)?;
    let border = gray.border(border)?;
    let gradient = progress::detach(image.py(), || imaging::sobel(&gray.pixels, border));
    Gradient::give(image.py(), gradient)
}

/// Computes the gradient of the image blurred by a Gaussian, as slopes per pixel.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// sigma_px : float
///     Standard deviation of the Gaussian, pixels, in (0, 1000].
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// Gradient
///
/// Raises
/// ------
/// ValueError
///     If ``sigma_px`` is outside (0, 1000].
#[pyfunction]
#[pyo3(signature = (image, sigma_px, border=None, *, progress=None))]
pub(super) fn gaussian_derivative(
    image: &Bound<'_, PyAny>,
    sigma_px: f64,
    border: Option<&Bound<'_, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Gradient> {
    let gray = Gray::read("image", image)?;
    let border = gray.border(border)?;
    let gradient = progress::run(image.py(), progress, |monitor| {
        imaging::gaussian_derivative(&gray.pixels, sigma_px, border, monitor)
    });
    Gradient::give(image.py(), gradient?)
}
