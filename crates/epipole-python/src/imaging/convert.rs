//! Conversions between bytes and floats, color and gray.

use crate::arrays::vector;
use crate::images::{from_gray, gray, rgb};
use crate::progress;
use epipole::imaging;
use numpy::PyArray2;
use pyo3::prelude::*;

/// Converts an 8-bit gray image to floats in [0, 1], ``image / 255``; floats do not change.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
#[pyfunction]
pub(super) fn gray_to_f32<'py>(image: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f32>>> {
    from_gray(image.py(), gray("image", image)?)
}

/// Converts a gray image of floats in [0, 1] to 8 bits, rounded and clamped.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///
/// Returns
/// -------
/// ndarray of uint8, shape (H, W)
#[pyfunction]
pub(super) fn gray_to_u8<'py>(image: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<u8>>> {
    from_gray(image.py(), imaging::gray_to_u8(&gray("image", image)?))
}

/// Converts a color image to gray by the weights of ITU-R BT.601, as in OpenCV.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W, 3)
///     uint8, in the order red, green, blue. For images from `cv2.imread`, pass
///     ``image[..., ::-1]``.
///
/// Returns
/// -------
/// ndarray of uint8, shape (H, W)
#[pyfunction]
pub(super) fn rgb_to_gray<'py>(image: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<u8>>> {
    let color = rgb("image", image)?;
    let gray = progress::detach(image.py(), || imaging::rgb_to_gray(&color));
    from_gray(image.py(), gray)
}

/// Converts a color image to gray by any weights.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W, 3)
///     uint8, in the order red, green, blue.
/// weights : array_like, shape (3,), optional
///     Weights of red, green and blue; `BT601_WEIGHTS` by default. A sum of 1 keeps white at 1.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
#[pyfunction]
#[pyo3(signature = (image, weights=None))]
pub(super) fn rgb_to_gray_f32<'py>(
    image: &Bound<'py, PyAny>,
    weights: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let color = rgb("image", image)?;
    let weights = match weights {
        Some(weights) => vector::<3>("weights", weights)?.cast::<f32>().into(),
        None => imaging::BT601_WEIGHTS,
    };
    let gray = progress::detach(image.py(), || imaging::rgb_to_gray_f32(&color, &weights));
    from_gray(image.py(), gray)
}
