//! Conversions between bytes and floats, color and gray.

use crate::arrays::vector;
use crate::images::{from_gray, gray, rgb};
use crate::progress;
use epipole::imaging;
use numpy::PyArray2;
use pyo3::prelude::*;

/// 8-bit gray image as floats in [0, 1]: ``image / 255``; floats stay as they are.
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

/// Gray image of floats in [0, 1] as 8 bits, rounded and clamped.
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

/// Gray image of a color image by the weights of ITU-R BT.601, equal to OpenCV's.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W, 3)
///     uint8, red first. Images of `cv2.imread` are blue first: pass ``image[..., ::-1]``.
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

/// Gray image of a color image by any weights.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W, 3)
///     uint8, red first.
/// weights : array_like, shape (3,), optional
///     Weights of red, green and blue; `BT601_WEIGHTS` if not given. A sum of 1 keeps white at 1.
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
