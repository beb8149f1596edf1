//! Removal of speckles and filling of gaps in disparities.

use crate::images::{disparity as read, from_disparity, gray8};
use crate::progress;
use epipole::stereo;
use numpy::PyArray2;
use pyo3::prelude::*;

/// Removes small connected sets of disparities.
///
/// Parameters
/// ----------
/// disparity : array_like of float, shape (H, W)
///     Pixels; NaN where unknown.
/// min_size : int
///     Sets with fewer pixels are removed.
/// range_px : float
///     Neighbors are connected if their disparities differ by at most this, pixels, >= 0.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///
/// Raises
/// ------
/// ValueError
///     If ``range_px`` is below 0.
#[pyfunction]
#[pyo3(signature = (disparity, min_size, range_px, *, progress=None))]
pub(super) fn remove_speckles<'py>(
    disparity: &Bound<'py, PyAny>,
    min_size: u32,
    range_px: f32,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let py = disparity.py();
    let mut disparity = read("disparity", disparity)?;
    progress::run(py, progress, |monitor| {
        stereo::remove_speckles(&mut disparity, min_size, range_px, monitor)
    })?;
    from_disparity(py, disparity)
}

/// Fills all gaps with the disparity of the background beside them.
///
/// Parameters
/// ----------
/// disparity : array_like of float, shape (H, W)
///     Pixels; NaN where unknown.
/// left : array_like, shape (H, W)
///     Gray image of the disparities, uint8 or float in [0, 1].
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///     NaN everywhere if no disparity is known.
#[pyfunction]
#[pyo3(signature = (disparity, left, *, progress=None))]
pub(super) fn fill_gaps<'py>(
    disparity: &Bound<'py, PyAny>,
    left: &Bound<'py, PyAny>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let py = disparity.py();
    let (disparity, left) = (read("disparity", disparity)?, gray8("left", left)?);
    let filled = progress::run(py, progress, |monitor| {
        stereo::fill_gaps(&disparity, &left, monitor)
    });
    from_disparity(py, filled?)
}
