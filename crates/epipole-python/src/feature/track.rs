//! Tracking of points between images.

use crate::arrays::{from_rows, points2};
use crate::images::unit_gray;
use crate::progress;
use crate::record::{record, rows};
use epipole::feature::{self, Track};
use epipole::nalgebra::Vector2;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Points tracked from one image to the next; row k belongs to point k.
    "epipole.feature" Tracks {
        /// Positions in the second image, pixels, shape (N, 2); NaN for lost points.
        points: Py<PyArray2<f64>>,
        /// Whether each point was tracked, boolean array of shape (N,).
        found: Py<PyArray1<bool>>,
        /// Mean absolute difference of gray values between the two windows, float32 of shape (N,);
        /// NaN for lost points.
        residuals: Py<PyArray1<f32>>,
        /// Distance between each point and its position after tracking back, pixels, shape (N,);
        /// NaN for lost points, and without that check.
        forward_backward_px: Py<PyArray1<f64>>,
    }
}

rows!(Tracks: found);

/// Tracks points from one image to the next (Lucas and Kanade, on a pyramid).
///
/// Parameters
/// ----------
/// first, second : array_like, shape (H, W)
///     Gray, uint8 or float in [0, 1].
/// points : array_like, shape (N, 2)
///     Pixels of the first image.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : TrackOptions
///     ``half_window``, pixels; ``num_levels``; ``max_iterations``; ``tolerance_px``;
///     ``min_eigenvalue``; ``max_forward_backward_px``, or None for no check.
///
/// Returns
/// -------
/// Tracks
///
/// Raises
/// ------
/// ValueError
///     If gray values are outside [-0.5, 1.5], or an option is out of range.
#[pyfunction]
#[pyo3(signature = (first, second, points, *, progress=None, **options))]
pub(super) fn track_lucas_kanade(
    first: &Bound<'_, PyAny>,
    second: &Bound<'_, PyAny>,
    points: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Tracks> {
    let py = first.py();
    let (first, second) = (unit_gray("first", first)?, unit_gray("second", second)?);
    let points = points2("points", points)?;
    let tracks = progress::run_with(py, progress, options, |options, monitor| {
        feature::track_lucas_kanade(&first, &second, &points, options, monitor)
    });
    let tracks = tracks?;
    let place = |track: &Option<Track>| match track {
        Some(track) => track.point.coords,
        None => Vector2::repeat(f64::NAN),
    };
    let found: Vec<bool> = tracks.iter().map(Option::is_some).collect();
    let residual = |track: &Option<Track>| track.map_or(f32::NAN, |track| track.residual);
    let back = |track: &Option<Track>| track.and_then(|track| track.forward_backward_px);
    let backs = tracks.iter().map(|track| back(track).unwrap_or(f64::NAN));
    Ok(Tracks {
        points: from_rows(py, tracks.iter().map(place))?.unbind(),
        found: found.to_pyarray(py).unbind(),
        residuals: PyArray1::from_vec(py, tracks.iter().map(residual).collect()).unbind(),
        forward_backward_px: PyArray1::from_vec(py, backs.collect()).unbind(),
    })
}
