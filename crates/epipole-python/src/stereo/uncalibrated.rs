//! Rectification without calibration.

use super::rectify::PixelRect;
use crate::arrays::{from_matrices, matrix, pixel_pairs};
use crate::errors::OrRaise;
use crate::record::record;
use epipole::nalgebra::Matrix3;
use epipole::stereo;
use numpy::PyArray3;
use pyo3::prelude::*;

record! {
    /// Homographies that move matches into the same row, or column.
    "epipole.stereo" UncalibratedRectification {
        /// Homographies from pixels of the photos to rectified pixels, shape (2, 3, 3).
        homographies: Py<PyArray3<f64>>,
        /// Whether matches share a column instead of a row.
        is_vertical: bool,
        /// Minimum and maximum disparity of the matches, pixels.
        disparity_range_px: (f64, f64),
        /// Bounding rectangles of the rectified photos, a pair.
        outlines: (Py<PixelRect>, Py<PixelRect>),
    }
}

/// Rectifies a pair from its fundamental matrix and matches (Hartley).
///
/// Parameters
/// ----------
/// fundamental : array_like, shape (3, 3)
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches, inliers of F, N >= 3.
/// width, height : int
///     Size of both photos, pixels.
///
/// Returns
/// -------
/// UncalibratedRectification
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 3 matches.
/// epipole.DegenerateError
///     If an epipole is in or near its photo, the matrix has rank 1 or 0, or all matches are on a
///     line.
/// ValueError
///     If a side is shorter than 2 pixels.
#[pyfunction]
pub(super) fn rectify_uncalibrated(
    fundamental: &Bound<'_, PyAny>,
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    width: u32,
    height: u32,
) -> PyResult<UncalibratedRectification> {
    let py = fundamental.py();
    let f: Matrix3<f64> = matrix("fundamental", fundamental)?;
    let [pixels1, pixels2] = pixel_pairs(pixels1, pixels2)?;
    let found = stereo::rectify_uncalibrated(&f, &pixels1, &pixels2, width, height).or_raise()?;
    let [first, second] = found.outlines.map(PixelRect::from);
    Ok(UncalibratedRectification {
        homographies: from_matrices(py, &found.homographies)?.unbind(),
        is_vertical: found.is_vertical,
        disparity_range_px: found.disparity_range_px,
        outlines: (Py::new(py, first)?, Py::new(py, second)?),
    })
}
