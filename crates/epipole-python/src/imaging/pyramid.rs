//! Image pyramids.

use super::resize::with_size;
use crate::images::{Gray, field, from_gray, gray};
use crate::progress;
use epipole::imaging::{self, Border};
use numpy::PyArray2;
use pyo3::prelude::*;

/// Halves an image, after a blur with the binomial kernel ``[1, 4, 6, 4, 1] / 16``.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// ndarray of uint8 or float32, shape (ceil(H / 2), ceil(W / 2))
///     uint8 for a uint8 image, else float32. Pixel u of the result is at 2u of the image.
#[pyfunction]
#[pyo3(signature = (image, border=None))]
pub(super) fn pyramid_down<'py>(
    image: &Bound<'py, PyAny>,
    border: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let gray = Gray::read("image", image)?;
    let border: Border = gray.border(border)?;
    let half = progress::detach(image.py(), || imaging::pyramid_down(&gray.pixels, border));
    gray.give(image.py(), half)
}

/// Doubles an image, interpolated by the binomial kernel.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// width, height : int
///     Size of the result, pixels: twice the size of the image, or one less.
///
/// Returns
/// -------
/// ndarray of uint8 or float32, shape (height, width)
///     uint8 for a uint8 image, else float32.
///
/// Raises
/// ------
/// ValueError
///     If the result has more than 2**32 pixels.
#[pyfunction]
pub(super) fn pyramid_up<'py>(
    image: &Bound<'py, PyAny>,
    width: u32,
    height: u32,
) -> PyResult<Bound<'py, PyAny>> {
    let double = |image: &_, width, height| Ok(imaging::pyramid_up(image, width, height));
    with_size(image, width, height, double)
}

/// Downscales an image repeatedly by `pyramid_down`; the list starts with the image.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// num_levels : int
///     Maximum number of levels; a single pixel ends the pyramid.
///
/// Returns
/// -------
/// list of ndarray of uint8 or float32
///     uint8 for a uint8 image, else float32.
#[pyfunction]
pub(super) fn gaussian_pyramid<'py>(
    image: &Bound<'py, PyAny>,
    num_levels: usize,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let gray = Gray::read("image", image)?;
    let levels = progress::detach(image.py(), || {
        imaging::gaussian_pyramid(&gray.pixels, num_levels)
    });
    let give = |level| gray.give(image.py(), level);
    levels.into_iter().map(give).collect()
}

/// Computes the Laplacian pyramid: differences of successive Gaussian levels, and the last level.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// num_levels : int
///     Maximum number of levels; a single pixel ends the pyramid.
///
/// Returns
/// -------
/// list of ndarray of float32
#[pyfunction]
pub(super) fn laplacian_pyramid<'py>(
    image: &Bound<'py, PyAny>,
    num_levels: usize,
) -> PyResult<Vec<Bound<'py, PyArray2<f32>>>> {
    let pixels = gray("image", image)?;
    let levels = progress::detach(image.py(), || {
        imaging::laplacian_pyramid(&pixels, num_levels)
    });
    let give = |level| from_gray(image.py(), level);
    levels.into_iter().map(give).collect()
}

/// Reconstructs the image of a Laplacian pyramid.
///
/// Parameters
/// ----------
/// levels : list of array_like
///     Result of `laplacian_pyramid`, possibly modified.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///     Shape (0, 0) for no levels.
#[pyfunction]
pub(super) fn from_laplacian_pyramid<'py>(
    py: Python<'py>,
    levels: Vec<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let named = levels.iter().enumerate();
    let levels: PyResult<Vec<_>> = named
        .map(|(k, level)| field(&format!("levels[{k}]"), level))
        .collect();
    let levels = levels?;
    from_gray(
        py,
        progress::detach(py, || imaging::from_laplacian_pyramid(&levels)),
    )
}

/// Measures the sharpness of a photo: mean square of its details of a few pixels.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
///
/// Returns
/// -------
/// float
///     Comparable between photos of equal size and similar content, such as frames of a video.
#[pyfunction]
pub(super) fn sharpness(image: &Bound<'_, PyAny>) -> PyResult<f64> {
    let pixels = gray("image", image)?;
    Ok(progress::detach(image.py(), || imaging::sharpness(&pixels)))
}
