//! Corners.

use super::keypoints::Keypoints;
use crate::arrays::{from_rows, points2};
use crate::images::{field, from_gray, gray};
use crate::{options, progress};
use epipole::feature;
use epipole::nalgebra::Vector2;
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes the Harris response at each pixel, ``det M - k * trace(M)**2`` (structure tensor M).
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// k : float
///     In [0, 0.25), usually 0.04 to 0.06.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : StructureTensorOptions
///     See `structure_tensor`.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///     Positive at corners, negative along edges.
///
/// Raises
/// ------
/// ValueError
///     If ``k`` is outside [0, 0.25), a box window is outside 1 to 255 pixels, or a Gaussian window
///     is outside (0, 31].
#[pyfunction]
#[pyo3(signature = (image, k, *, progress=None, **options))]
pub(super) fn harris_response<'py>(
    image: &Bound<'py, PyAny>,
    k: f32,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let pixels = gray("image", image)?;
    let response = progress::run_with(image.py(), progress, options, |options, monitor| {
        feature::harris_response(&pixels, k, options, monitor)
    });
    from_gray(image.py(), response?)
}

/// Computes the smaller eigenvalue of the structure tensor at each pixel (Shi and Tomasi).
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray; uint8 values are divided by 255.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : StructureTensorOptions
///     See `structure_tensor`.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///
/// Raises
/// ------
/// ValueError
///     If a box window is outside 1 to 255 pixels, or a Gaussian window is outside (0, 31].
#[pyfunction]
#[pyo3(signature = (image, *, progress=None, **options))]
pub(super) fn min_eigenvalue_response<'py>(
    image: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let pixels = gray("image", image)?;
    let response = progress::run_with(image.py(), progress, options, |options, monitor| {
        feature::min_eigenvalue_response(&pixels, options, monitor)
    });
    from_gray(image.py(), response?)
}

/// Finds the corners of an image, strongest first, at integer pixels.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : GoodFeaturesOptions
///     For example ``max_corners`` (0 for no limit), ``quality`` (relative to the strongest
///     response), ``min_distance_px``, ``measure={"harris": 0.04}``, ``grid={"columns": 4, "rows":
///     3}``.
///
/// Returns
/// -------
/// Keypoints
///
/// Raises
/// ------
/// ValueError
///     If ``quality`` is outside (0, 1], ``min_distance_px`` is below 0, the grid has no cells, or
///     ``measure`` or ``tensor`` is out of range.
#[pyfunction]
#[pyo3(signature = (image, *, progress=None, **options))]
pub(super) fn good_features_to_track(
    image: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Keypoints> {
    let pixels = gray("image", image)?;
    let corners = progress::run_with(image.py(), progress, options, |options, monitor| {
        feature::good_features_to_track(&pixels, options, monitor)
    })?;
    Keypoints::give(image.py(), &corners)
}

/// Finds the local maxima of a response, strongest first.
///
/// Parameters
/// ----------
/// response : array_like, shape (H, W)
/// radius : int
///     Pixels, >= 1: the window is ``2 * radius + 1`` wide.
/// threshold : float
///     Smaller responses are ignored.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// Keypoints
///
/// Raises
/// ------
/// ValueError
///     If ``radius`` is 0.
#[pyfunction]
#[pyo3(signature = (response, radius, threshold, *, progress=None))]
pub(super) fn non_maximum_suppression(
    response: &Bound<'_, PyAny>,
    radius: usize,
    threshold: f32,
    progress: Option<Py<PyAny>>,
) -> PyResult<Keypoints> {
    let values = field("response", response)?;
    let peaks = progress::run(response.py(), progress, |monitor| {
        feature::non_maximum_suppression(&values, radius, threshold, monitor)
    });
    Keypoints::give(response.py(), &peaks?)
}

/// Refines corners to subpixel positions, from the gradients around them.
///
/// Parameters
/// ----------
/// image : array_like, shape (H, W)
///     Gray.
/// corners : array_like, shape (N, 2)
///     Pixels.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : RefineOptions
///     ``half_window``, pixels; ``max_iterations``; ``tolerance_px``.
///
/// Returns
/// -------
/// ndarray, shape (N, 2)
///     Rows of NaN where the window contains no corner.
///
/// Raises
/// ------
/// ValueError
///     If ``half_window`` is outside 1 to 50, or ``tolerance_px`` is not above 0.
#[pyfunction]
#[pyo3(signature = (image, corners, *, progress=None, **options))]
pub(super) fn refine_corners<'py>(
    image: &Bound<'py, PyAny>,
    corners: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (pixels, options) = (gray("image", image)?, options::read(options)?);
    let corners = points2("corners", corners)?;
    let refined = progress::run(image.py(), progress, |monitor| {
        feature::refine_corners(&pixels, &corners, &options, monitor)
    });
    let refined = refined?.into_iter();
    let or_nan = refined.map(|corner| corner.map_or(Vector2::repeat(f64::NAN), |c| c.coords));
    from_rows(image.py(), or_nan)
}
