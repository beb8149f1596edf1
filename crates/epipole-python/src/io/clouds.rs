//! Files of point clouds, disparities, pose graphs and bundle adjustment problems.

use super::source::{Source, or_raise, write};
use crate::arrays::{from_points, from_rows, points3};
use crate::images::{column, disparity, from_disparity};
use crate::register::functions;
use crate::sfm::wrapper::{colors, give_colors, object, require_equal};
use crate::sfm::{BalProblem, PoseGraph};
use epipole::stereo::{DisparityImage, PointCloud};
use epipole_io::{bundle, cloud, pose_graph};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;

/// Converts a cloud to Python, as `epipole.stereo.PointCloud`.
pub(crate) fn give_cloud<'py>(py: Python<'py>, cloud: &PointCloud) -> PyResult<Bound<'py, PyAny>> {
    let colors = match cloud.colors.is_empty() {
        true => None,
        false => Some(give_colors(py, cloud.colors.iter().copied())?),
    };
    let normals = match cloud.normals.is_empty() {
        true => None,
        false => Some(from_rows(py, cloud.normals.iter().copied())?),
    };
    let confidences = match cloud.confidences.is_empty() {
        true => None,
        false => Some(PyArray1::from_slice(py, &cloud.confidences)),
    };
    object(
        py,
        "epipole.stereo",
        "PointCloud",
        (
            from_points(py, &cloud.points)?,
            colors,
            normals,
            confidences,
        ),
    )
}

/// Reads the points of a PLY file.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///
/// Returns
/// -------
/// cloud : epipole.stereo.PointCloud
/// notes : list of str
///     Notes on skipped content, as sentences: points with NaN or infinity, faces of a mesh.
///
/// Raises
/// ------
/// ValueError
///     If the file is damaged or is not a PLY file.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_ply<'py>(source: &Bound<'py, PyAny>) -> PyResult<(Bound<'py, PyAny>, Vec<String>)> {
    let py = source.py();
    let source = Source::read(source)?;
    let (cloud, notes) = source.done(cloud::read_ply(&source.bytes))?;
    Ok((give_cloud(py, &cloud)?, notes))
}

/// Writes points as a binary PLY file.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// cloud : epipole.stereo.PointCloud or array_like, shape (N, 3)
///
/// Raises
/// ------
/// OSError
///     If the file cannot be written.
#[pyfunction]
fn write_ply(path: &Bound<'_, PyAny>, cloud: &Bound<'_, PyAny>) -> PyResult<()> {
    write(path, &cloud::write_ply(&take_cloud("cloud", cloud)?))
}

/// Reads a cloud, or an array of points.
pub(super) fn take_cloud(argument: &str, cloud: &Bound<'_, PyAny>) -> PyResult<PointCloud> {
    let (points, is_cloud) = match cloud.getattr_opt("points")? {
        Some(points) => (points, true),
        None => (cloud.clone(), false),
    };
    let part = |name: &str| -> PyResult<Option<Bound<'_, PyAny>>> {
        let part = if is_cloud {
            cloud.getattr_opt(name)?
        } else {
            None
        };
        Ok(part.filter(|part| !part.is_none()))
    };
    let of = |name: &str| format!("{argument}.{name}");
    let mut point_cloud = PointCloud {
        points: points3(argument, &points)?,
        colors: colors(&of("colors"), part("colors")?.as_ref())?,
        ..PointCloud::default()
    };
    if let Some(normals) = part("normals")? {
        let normals = points3(&of("normals"), &normals)?;
        point_cloud.normals = normals.into_iter().map(|normal| normal.coords).collect();
    }
    if let Some(confidences) = part("confidences")? {
        point_cloud.confidences = column(&of("confidences"), &confidences)?;
    }
    for (name, count) in [
        ("colors", point_cloud.colors.len()),
        ("normals", point_cloud.normals.len()),
        ("confidences", point_cloud.confidences.len()),
    ] {
        if count > 0 {
            let points = (&*of("points"), point_cloud.points.len());
            require_equal(points, (&of(name), count))?;
        }
    }
    Ok(point_cloud)
}

fn disparities(source: &Bound<'_, PyAny>, read: Reader) -> PyResult<Py<PyArray2<f32>>> {
    let py = source.py();
    let source = Source::read(source)?;
    Ok(from_disparity(py, source.done(read(&source.bytes))?)?.unbind())
}

/// Reader of disparities.
type Reader = fn(&[u8]) -> epipole_io::Result<DisparityImage>;

/// Reads the disparities of a gray PFM file.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///
/// Returns
/// -------
/// ndarray of float32, shape (H, W)
///     NaN where unknown.
///
/// Raises
/// ------
/// ValueError
///     If the file is truncated or is not a gray PFM file.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_pfm(source: &Bound<'_, PyAny>) -> PyResult<Py<PyArray2<f32>>> {
    disparities(source, epipole_io::disparity::read_pfm)
}

/// Writes disparities as a gray PFM file, the format of the Middlebury benchmark.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// disparity : array_like of float, shape (H, W)
///     NaN where unknown.
///
/// Raises
/// ------
/// OSError
///     If the file cannot be written.
#[pyfunction]
fn write_pfm(path: &Bound<'_, PyAny>, disparity: &Bound<'_, PyAny>) -> PyResult<()> {
    let disparity = self::disparity("disparity", disparity)?;
    write(path, &epipole_io::disparity::write_pfm(&disparity))
}

/// Writes disparities times 256 as a 16-bit PNG file, the format of the KITTI benchmark.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// disparity : array_like of float, shape (H, W)
///     NaN where unknown. Values outside [1/256, 255.996] are written as unknown.
///
/// Raises
/// ------
/// OSError
///     If the file cannot be written.
#[pyfunction]
fn write_png16(path: &Bound<'_, PyAny>, disparity: &Bound<'_, PyAny>) -> PyResult<()> {
    let disparity = self::disparity("disparity", disparity)?;
    write(
        path,
        &or_raise(epipole_io::disparity::write_png16(&disparity))?,
    )
}

/// Reads a pose graph in the text format of g2o: SE2, SE3:QUAT or SIM3:QUAT, with priors.
///
/// Point landmarks become vertices without a rotation; others are skipped, with a warning.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///
/// Returns
/// -------
/// epipole.sfm.PoseGraph
///
/// Raises
/// ------
/// ValueError
///     If a tag is unknown, kinds are mixed, vertices are missing or duplicate, numbers are wrong,
///     or there are no vertices.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_g2o(py: Python<'_>, source: &Bound<'_, PyAny>) -> PyResult<PoseGraph> {
    let source = Source::read(source)?;
    let read = source.done(pose_graph::read_g2o(source.text()?))?;
    for note in &read.notes {
        let note = std::ffi::CString::new(note.as_str())?;
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &note, 1)?;
    }
    Ok(PoseGraph(read.graph))
}

/// Writes a pose graph in the text format of g2o.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// graph : epipole.sfm.PoseGraph
///
/// Raises
/// ------
/// OSError
///     If the file cannot be written.
#[pyfunction]
fn write_g2o(path: &Bound<'_, PyAny>, graph: &PoseGraph) -> PyResult<()> {
    write(path, pose_graph::write_g2o(&graph.0).as_bytes())
}

/// Reads a bundle adjustment problem of the BAL data set.
///
/// Parameters
/// ----------
/// source : str, os.PathLike or bytes
///
/// Returns
/// -------
/// epipole.sfm.BalProblem
///
/// Raises
/// ------
/// ValueError
///     If numbers are missing, surplus or infinite, or an index refers to a missing camera or
///     point.
/// OSError
///     If the file cannot be read.
#[pyfunction]
fn read_bal(source: &Bound<'_, PyAny>) -> PyResult<BalProblem> {
    let source = Source::read(source)?;
    Ok(BalProblem(source.done(bundle::read_bal(source.text()?))?))
}

/// Writes a bundle adjustment problem of the BAL data set, with all digits.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
/// problem : epipole.sfm.BalProblem
///
/// Raises
/// ------
/// OSError
///     If the file cannot be written.
#[pyfunction]
fn write_bal(path: &Bound<'_, PyAny>, problem: &BalProblem) -> PyResult<()> {
    write(path, bundle::write_bal(&problem.0).as_bytes())
}

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    functions!(module:
        read_ply, write_ply, read_pfm, write_pfm, write_png16, read_g2o, write_g2o, read_bal,
        write_bal
    );
    Ok(())
}
