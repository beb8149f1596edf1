//! Matching of descriptors.

use super::descriptors::descriptors;
use crate::errors::OrRaise;
use crate::images::column;
use crate::progress;
use crate::record::{record, rows};
use epipole::feature;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Matches between two lists of features.
    "epipole.feature" Matches {
        /// Rows of the first and the second list, int64 of shape (M, 2).
        indices: Py<PyArray2<i64>>,
        /// Distance between the descriptors: Euclidean, or the number of bits that differ, float32
        /// of shape (M,).
        distances: Py<PyArray1<f32>>,
        /// Ratio of nearest to second nearest distance, in [0, 1], float32 of shape (M,).
        ratios: Py<PyArray1<f32>>,
    }
}

rows!(Matches: indices);

record! {
    /// The two nearest descriptors for each descriptor.
    "epipole.feature" Neighbors {
        /// Row of the nearest descriptor, int64 of shape (N,).
        indices: Py<PyArray1<i64>>,
        /// Distance to the nearest descriptor, float32 of shape (N,).
        distances: Py<PyArray1<f32>>,
        /// Distance to the second nearest, float32 of shape (N,); infinity if there is none.
        second_distances: Py<PyArray1<f32>>,
    }
}

rows!(Neighbors: indices);

/// Matches two lists of descriptors, in the order of the first.
///
/// Parameters
/// ----------
/// descriptors1, descriptors2 : Features or array_like
///     Floats of shape (N, D), or bits in uint8 of shape (N, 32), as in OpenCV.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : MatchOptions
///     ``max_ratio``, in (0, 1], or None for no ratio test; ``mutual``; ``max_distance``;
///     ``unique``.
///
/// Returns
/// -------
/// Matches
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If one list has float and the other binary descriptors.
/// ValueError
///     If ``max_ratio`` is outside (0, 1], or ``max_distance`` is below 0.
///
/// Examples
/// --------
/// >>> match_descriptors(np.eye(2, 4), np.eye(2, 4)).indices.tolist()
/// [[0, 0], [1, 1]]
#[pyfunction]
#[pyo3(signature = (descriptors1, descriptors2, *, progress=None, **options))]
pub(super) fn match_descriptors(
    descriptors1: &Bound<'_, PyAny>,
    descriptors2: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Matches> {
    let py = descriptors1.py();
    let first = descriptors("descriptors1", descriptors1)?;
    let second = descriptors("descriptors2", descriptors2)?;
    let matches = progress::run_with(py, progress, options, |options, monitor| {
        feature::match_descriptors(&first, &second, options, monitor)
    })?;
    let indices = matches
        .iter()
        .flat_map(|m| [m.index1 as i64, m.index2 as i64]);
    let indices = PyArray1::from_vec(py, indices.collect());
    let floats = |of: fn(&feature::Match) -> f32| {
        PyArray1::from_vec(py, matches.iter().map(of).collect()).unbind()
    };
    Ok(Matches {
        indices: indices.reshape([matches.len(), 2])?.unbind(),
        distances: floats(|m| m.distance),
        ratios: floats(|m| m.ratio),
    })
}

/// Finds the two nearest descriptors in the second list for each in the first, exactly.
///
/// Parameters
/// ----------
/// descriptors1, descriptors2 : Features or array_like
///     Floats of shape (N, D), or bits in uint8 of shape (N, 32).
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// Neighbors
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If one list has float and the other binary descriptors.
#[pyfunction]
#[pyo3(signature = (descriptors1, descriptors2, *, progress=None))]
pub(super) fn nearest_two(
    descriptors1: &Bound<'_, PyAny>,
    descriptors2: &Bound<'_, PyAny>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Neighbors> {
    let py = descriptors1.py();
    let first = descriptors("descriptors1", descriptors1)?;
    let second = descriptors("descriptors2", descriptors2)?;
    let found = progress::run(py, progress, |monitor| {
        feature::nearest_two(&first, &second, monitor)
    })?;
    let floats = |of: fn(&feature::Neighbors) -> f32| {
        PyArray1::from_vec(py, found.iter().map(of).collect()).unbind()
    };
    let indices = found.iter().map(|n| n.index as i64).collect();
    Ok(Neighbors {
        indices: PyArray1::from_vec(py, indices).unbind(),
        distances: floats(|n| n.distance),
        second_distances: floats(|n| n.second_distance.unwrap_or(f32::INFINITY)),
    })
}

/// Finds the descriptors in a list that are nearest to one descriptor, nearest first.
///
/// Parameters
/// ----------
/// query : array_like, shape (D,)
/// list : Features or array_like
///     Floats of shape (N, D), or bits in uint8 of shape (N, 32), which count as D = 256 numbers 0
///     and 1, lowest bit first.
/// count : int
///     Maximum number of entries.
///
/// Returns
/// -------
/// indices : ndarray of int64, shape (K,)
/// distances : ndarray of float32, shape (K,)
///     Euclidean distances.
#[pyfunction]
#[allow(clippy::type_complexity)]
pub(super) fn nearest_few<'py>(
    query: &Bound<'py, PyAny>,
    list: &Bound<'py, PyAny>,
    count: usize,
) -> PyResult<(Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f32>>)> {
    let py = query.py();
    let query = column("query", query)?;
    let list = descriptors("list", list)?;
    let found = progress::detach(py, || feature::nearest_few(&query, &list, count)).or_raise()?;
    let indices = found.iter().map(|&(index, _)| index as i64).collect();
    let distances = found.iter().map(|&(_, distance)| distance).collect();
    Ok((
        PyArray1::from_vec(py, indices),
        PyArray1::from_vec(py, distances),
    ))
}
