//! Images warped by an affine map or a homography.

use crate::arrays::matrix;
use crate::images::{Image, require_size, same_kind};
use crate::{options, progress};
use epipole::imaging::{self, WarpOptions};
use epipole::nalgebra::{Matrix2x3, Matrix3, SMatrix};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Map from pixels of an image to pixels of the result.
enum Map {
    Affine(Matrix2x3<f64>),
    Perspective(Matrix3<f64>),
}

/// Warps an image by a map, given as a matrix of R rows.
fn warp<'py, const R: usize>(
    image: &Bound<'py, PyAny>,
    out_from_image: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
    map: fn(SMatrix<f64, R, 3>) -> Map,
) -> PyResult<Bound<'py, PyAny>> {
    let source = Image::read("image", image)?;
    let map = map(matrix("out_from_image", out_from_image)?);
    let options = warp_options(&source, options)?;
    let py = image.py();
    let warped = same_kind!(&source, |pixels| {
        let warped = progress::run(py, progress, |monitor| match &map {
            Map::Affine(map) => imaging::warp_affine(pixels, map, &options, monitor),
            Map::Perspective(map) => imaging::warp_perspective(pixels, map, &options, monitor),
        });
        warped?
    });
    warped.give(py)
}

/// Warps an image by an affine map, as OpenCV's `warpAffine`.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W) or (H, W, 3)
/// out_from_image : array_like, shape (2, 3)
///     Affine map from pixels of the image to pixels of the result.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : WarpOptions
///     ``width`` and ``height``, pixels, those of the image by default; ``interpolation``,
///     ``"bilinear"`` or ``"bicubic"``; ``border={"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// ndarray of uint8 or float32, shape (height, width) or (height, width, 3)
///     uint8 for a uint8 image, else float32.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the map has no inverse.
/// ValueError
///     If the result has more than 2**32 pixels.
#[pyfunction]
#[pyo3(signature = (image, out_from_image, *, progress=None, **options))]
pub(super) fn warp_affine<'py>(
    image: &Bound<'py, PyAny>,
    out_from_image: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    warp(image, out_from_image, progress, options, Map::Affine)
}

/// Warps an image by a homography, as OpenCV's `warpPerspective`.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W) or (H, W, 3)
/// out_from_image : array_like, shape (3, 3)
///     Homography from pixels of the image to pixels of the result, at any scale.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : WarpOptions
///     ``width`` and ``height``, pixels, those of the image by default; ``interpolation``,
///     ``"bilinear"`` or ``"bicubic"``; ``border={"constant": 0.0}``, in units of the image.
///
/// Returns
/// -------
/// ndarray of uint8 or float32, shape (height, width) or (height, width, 3)
///     uint8 for a uint8 image, else float32.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the map has no inverse.
/// ValueError
///     If the result has more than 2**32 pixels.
#[pyfunction]
#[pyo3(signature = (image, out_from_image, *, progress=None, **options))]
pub(super) fn warp_perspective<'py>(
    image: &Bound<'py, PyAny>,
    out_from_image: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    warp(image, out_from_image, progress, options, Map::Perspective)
}

/// Reads options, with the size of the image as the default size of the result.
fn warp_options(image: &Image, options: Option<&Bound<'_, PyDict>>) -> PyResult<WarpOptions> {
    let (width, height) = match image {
        Image::Gray8(image) => image.dimensions(),
        Image::Rgb8(image) => image.dimensions(),
        Image::Gray32(image) => image.dimensions(),
    };
    let defaults = WarpOptions::new(width, height);
    let options = match options {
        Some(options) => options::read_onto(&defaults, options)?,
        None => defaults,
    };
    require_size(options.width, options.height)?;
    Ok(options)
}
