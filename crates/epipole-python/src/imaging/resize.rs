//! Resizing and interpolation of images.

use crate::arrays::Batch;
use crate::errors::OrRaise;
use crate::images::{Gray, from_rgb, require_size, rgb};
use crate::progress;
use epipole::imaging::{self, Border, GrayImage32};
use numpy::prelude::*;
use numpy::{PyArray3, PyUntypedArray};
use pyo3::prelude::*;
use pyo3::types::PySlice;

/// Resizes an image without aliasing: area averages to shrink, linear interpolation to enlarge.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// width, height : int
///     Size of the result, pixels, > 0.
///
/// Returns
/// -------
/// ndarray of uint8 or float32, shape (height, width)
///     uint8 for a uint8 image, else float32. Pixel u is at ``(u + 0.5) * W / width - 0.5``.
///
/// Raises
/// ------
/// ValueError
///     If a side is 0 pixels long, or the result has more than 2**32 pixels.
#[pyfunction]
pub(super) fn resize<'py>(
    image: &Bound<'py, PyAny>,
    width: u32,
    height: u32,
) -> PyResult<Bound<'py, PyAny>> {
    with_size(image, width, height, imaging::resize)
}

/// Computes a gray image of a given size.
pub(super) fn with_size<'py>(
    image: &Bound<'py, PyAny>,
    width: u32,
    height: u32,
    compute: fn(&GrayImage32, u32, u32) -> epipole::Result<GrayImage32>,
) -> PyResult<Bound<'py, PyAny>> {
    let gray = Gray::read("image", image)?;
    require_size(width, height)?;
    let result = progress::detach(image.py(), || compute(&gray.pixels, width, height));
    gray.give(image.py(), result.or_raise()?)
}

/// Downscales a color image to at most `max_pixels` pixels, if it has more.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W, 3)
///     uint8.
/// max_pixels : int
///
/// Returns
/// -------
/// ndarray of uint8, shape (h, w, 3)
///     `Intrinsics.resized` returns the matching intrinsics.
#[pyfunction]
pub(super) fn reduce_rgb<'py>(
    image: &Bound<'py, PyAny>,
    max_pixels: u64,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let color = rgb("image", image)?;
    let reduced = progress::detach(image.py(), || imaging::reduce_rgb(color, max_pixels));
    from_rgb(image.py(), reduced)
}

/// Interpolates gray values between pixels bilinearly.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// pixel : array_like, shape (2,) or (N, 2)
///     (u, v), pixel centers at integers.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// float or ndarray, shape (N,)
#[pyfunction]
#[pyo3(signature = (image, pixel, border=None))]
pub(super) fn sample_bilinear<'py>(
    image: &Bound<'py, PyAny>,
    pixel: &Bound<'py, PyAny>,
    border: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    sample(image, pixel, border, imaging::sample_bilinear)
}

/// Interpolates gray values between pixels by bicubic interpolation (Catmull-Rom).
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// pixel : array_like, shape (2,) or (N, 2)
///     (u, v), pixel centers at integers.
/// border : str or dict, optional
///     ``"reflect101"``, ``"replicate"`` or ``{"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// float or ndarray, shape (N,)
#[pyfunction]
#[pyo3(signature = (image, pixel, border=None))]
pub(super) fn sample_bicubic<'py>(
    image: &Bound<'py, PyAny>,
    pixel: &Bound<'py, PyAny>,
    border: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    sample(image, pixel, border, imaging::sample_bicubic)
}

fn sample<'py>(
    image: &Bound<'py, PyAny>,
    pixel: &Bound<'py, PyAny>,
    border: Option<&Bound<'py, PyAny>>,
    at: fn(&GrayImage32, f64, f64, Border) -> f32,
) -> PyResult<Bound<'py, PyAny>> {
    let pixels = Batch::<2>::read("pixel", pixel)?;
    let (image, [u, v]) = read_part(image, pixels.bounds()?)?;
    let gray = Gray::read("image", &image)?;
    let border = gray.border(border)?;
    let value =
        |p: &epipole::nalgebra::Vector2<f64>| at(&gray.pixels, p.x - u, p.y - v, border).into();
    pixels.numbers(image.py(), value)
}

/// Returns the part of an image to read for pixels within bounds, and its first pixel: reading the
/// whole image takes a thousand times as long as a sample. Near the border, the whole image.
fn read_part<'py>(
    image: &Bound<'py, PyAny>,
    bounds: Option<[(f64, f64); 2]>,
) -> PyResult<(Bound<'py, PyAny>, [f64; 2])> {
    /// Number of neighbors of a pixel that an interpolation reads, plus one.
    const MARGIN: f64 = 3.0;
    let (Ok(array), Some(bounds)) = (image.cast::<PyUntypedArray>(), bounds) else {
        return Ok((image.clone(), [0.0; 2]));
    };
    let &[height, width] = array.shape() else {
        return Ok((image.clone(), [0.0; 2]));
    };
    let part = |(least, most): (f64, f64), length: usize| {
        let (start, end) = (least.floor() - MARGIN, most.floor() + MARGIN);
        let is_inside = start >= 0.0 && end < length as f64;
        is_inside.then_some((start, end as isize + 1))
    };
    let (Some((u, u_end)), Some((v, v_end))) = (part(bounds[0], width), part(bounds[1], height))
    else {
        return Ok((image.clone(), [0.0; 2]));
    };
    let py = image.py();
    let rows = PySlice::new(py, v as isize, v_end, 1);
    let columns = PySlice::new(py, u as isize, u_end, 1);
    Ok((image.get_item((rows, columns))?, [u, v]))
}
