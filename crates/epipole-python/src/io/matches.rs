//! Files of matches and of points with their pixels.

use super::source::{Source, format_of, write};
use crate::arrays::{from_points, pixel_pairs};
use crate::images::column;
use crate::register::functions;
use crate::sfm::wrapper::require_equal;
use epipole_io::matches::{self, MatchLayout};
use numpy::PyArray2;
use pyo3::prelude::*;

/// Array of points.
type Array<'py> = Bound<'py, PyArray2<f64>>;

/// Reads matches of two images: ``u1 v1 u2 v2`` per line, pixels.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///     Numbers separated by commas, semicolons, tabs or spaces, in any order if a header names
///     them.
///
/// Returns
/// -------
/// pixels1, pixels2 : ndarray, shape (N, 2)
///
/// Raises
/// ------
/// ValueError
///     If a line has a missing number, NaN or an ambiguous comma, or the first column counts the
///     rows.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_matches<'py>(source: &Bound<'py, PyAny>) -> PyResult<(Array<'py>, Array<'py>)> {
    let py = source.py();
    let source = Source::read(source)?;
    let [pixels1, pixels2] = source.done(matches::read_matches(&source.bytes))?;
    Ok((from_points(py, &pixels1)?, from_points(py, &pixels2)?))
}

/// Reads points of an image: ``u v`` per line, pixels.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///
/// Returns
/// -------
/// ndarray, shape (N, 2)
///
/// Raises
/// ------
/// ValueError
///     If a line has a missing number, NaN or an ambiguous comma, or the first column counts the
///     rows.
/// OSError
///     If the file cannot be read.
///
/// Examples
/// --------
/// >>> read_points(b"1 2\n3 4\n").tolist()
/// [[1.0, 2.0], [3.0, 4.0]]
#[pyfunction]
fn read_points<'py>(source: &Bound<'py, PyAny>) -> PyResult<Array<'py>> {
    let py = source.py();
    let source = Source::read(source)?;
    from_points(py, &source.done(matches::read_points(&source.bytes))?)
}

/// Reads world points with their pixels: ``x y z u v`` per line.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///
/// Returns
/// -------
/// pixels : ndarray, shape (N, 2)
/// points : ndarray, shape (N, 3)
///
/// Raises
/// ------
/// ValueError
///     If a line has a missing number, NaN or an ambiguous comma, or the first column counts the
///     rows.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_points_with_pixels<'py>(source: &Bound<'py, PyAny>) -> PyResult<(Array<'py>, Array<'py>)> {
    let py = source.py();
    let source = Source::read(source)?;
    let found = source.done(matches::read_points_with_pixels(&source.bytes))?;
    Ok((from_points(py, &found.0)?, from_points(py, &found.1)?))
}

/// Writes matches, one per line: ``u1 v1 u2 v2``, then distance and ratio if given.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// pixels1, pixels2 : array_like, shape (N, 2)
/// distances, ratios : array_like, shape (N,), optional
///     Distance between the descriptors, and its ratio to the distance of the second nearest
///     descriptor. If only one of the two is given, the other is written as 0.
/// layout : {"text", "csv"}, optional
///
/// Raises
/// ------
/// ValueError
///     If ``layout`` is unknown.
/// OSError
///     If the file cannot be written.
#[pyfunction]
#[pyo3(signature = (path, pixels1, pixels2, distances=None, ratios=None, layout="text"))]
fn write_matches(
    path: &Bound<'_, PyAny>,
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    distances: Option<&Bound<'_, PyAny>>,
    ratios: Option<&Bound<'_, PyAny>>,
    layout: &str,
) -> PyResult<()> {
    let [pixels1, pixels2] = pixel_pairs(pixels1, pixels2)?;
    let count = pixels1.len();
    require_equal(("pixels1", count), ("pixels2", pixels2.len()))?;
    let numbers = |name: &str, value: Option<&Bound<'_, PyAny>>| {
        let numbers = value.map_or_else(|| Ok(vec![0.0; count]), |value| column(name, value))?;
        require_equal(("pixels1", count), (name, numbers.len()))?;
        PyResult::Ok(numbers)
    };
    let has_tests = distances.is_some() || ratios.is_some();
    let distances = numbers("distances", distances)?;
    let ratios = numbers("ratios", ratios)?;
    let both: Vec<_> = distances
        .into_iter()
        .zip(ratios)
        .map(|(d, r)| [d, r])
        .filter(|_| has_tests)
        .collect();
    let layouts = [("text", MatchLayout::Text), ("csv", MatchLayout::Csv)];
    let layout = format_of(&layouts, layout)?;
    let text = matches::write_matches(layout, [&pixels1, &pixels2], &both);
    write(path, text.as_bytes())
}

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    functions!(module: read_matches, read_points, read_points_with_pixels, write_matches);
    Ok(())
}
