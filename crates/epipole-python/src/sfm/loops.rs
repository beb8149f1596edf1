//! Loop closing, and rotation averaging.

use super::pose_graph::PoseGraphReport;
use super::similarity::Similarity3;
use super::wrapper::{index_rows, require_equal, wrapper};
use crate::arrays::{from_matrices, points3};
use crate::camera::{RigidTransform, rotation};
use crate::errors::OrRaise;
use crate::record::record;
use crate::{options, progress};
use epipole::nalgebra::{Rotation3, UnitQuaternion};
use epipole::sfm::{self, LoopMotion, RelativeRotation};
use numpy::prelude::*;
use numpy::{PyArray1, PyArray3};
use pyo3::prelude::*;

/// Motion between two frames that show the same scene.
///
/// Parameters
/// ----------
/// from_index, to_index : int
///     Indices of the earlier and the later frame.
/// from_from_to : Similarity3
///     Pose of the later camera in the frame of the earlier one, with the ratio of their scales.
/// weight : float, optional
///     Weight relative to one step of odometry.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(super) struct LoopClosure(sfm::LoopClosure);

wrapper!(LoopClosure: from_index, to_index, from_from_to, weight);

// Names of attributes.
#[allow(clippy::wrong_self_convention)]
#[pymethods]
impl LoopClosure {
    #[new]
    #[pyo3(signature = (from_index, to_index, from_from_to, weight=1.0))]
    fn new(from_index: usize, to_index: usize, from_from_to: &Similarity3, weight: f64) -> Self {
        Self(sfm::LoopClosure {
            from: from_index,
            to: to_index,
            from_from_to: from_from_to.0,
            weight,
        })
    }

    /// Index of the earlier frame.
    #[getter]
    fn from_index(&self) -> usize {
        self.0.from
    }

    /// Index of the later frame.
    #[getter]
    fn to_index(&self) -> usize {
        self.0.to
    }

    /// Pose of the later camera in the frame of the earlier one.
    #[getter]
    fn from_from_to(&self) -> Similarity3 {
        Similarity3(self.0.from_from_to)
    }

    /// Weight relative to one step of odometry.
    #[getter]
    fn weight(&self) -> f64 {
        self.0.weight
    }
}

record! {
    /// Path after loop closing.
    "epipole.sfm" ClosedPath {
        /// ``world_from_cam`` of each frame, a list of `RigidTransform`.
        world_from_cam: Vec<RigidTransform>,
        /// Scale factor of each frame, shape (N,).
        scale: Py<PyArray1<f64>>,
        /// `PoseGraphReport` of the optimization.
        report: Py<PoseGraphReport>,
    }
}

/// Distributes the error of closed loops over a path.
///
/// Parameters
/// ----------
/// world_from_cam : list of RigidTransform
///     Path, frame by frame. The first frame is held fixed.
/// loops : list of LoopClosure
/// motion : {"similarity", "rigid"}, optional
///     With or without a scale of each frame.
/// loss : str or dict, optional
///     Its width is in standard deviations of a step: ``"trivial"``, or ``{"huber": {"width":
///     1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// ClosedPath
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 poses, or no loops.
/// ValueError
///     If a loop refers to a missing frame or joins a frame with itself, or a weight or loss width
///     is not above 0.
#[pyfunction]
#[pyo3(signature = (world_from_cam, loops, motion=None, *, loss=None, progress=None))]
pub(super) fn close_loops(
    py: Python<'_>,
    world_from_cam: Vec<RigidTransform>,
    loops: Vec<LoopClosure>,
    motion: Option<&Bound<'_, PyAny>>,
    loss: Option<&Bound<'_, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<ClosedPath> {
    let motion = match motion {
        Some(motion) => options::value("motion", motion)?,
        None => LoopMotion::default(),
    };
    let loss = options::loss(loss)?;
    let path: Vec<_> = world_from_cam.into_iter().map(|pose| pose.0).collect();
    let loops: Vec<_> = loops.into_iter().map(|closure| closure.0).collect();
    let closed = progress::run(py, progress, |monitor| {
        sfm::close_loops(&path, &loops, motion, loss, monitor)
    })?;
    let poses = closed.world_from_cam.into_iter().map(RigidTransform::from);
    Ok(ClosedPath {
        world_from_cam: poses.collect(),
        scale: PyArray1::from_vec(py, closed.scale).unbind(),
        report: Py::new(py, PoseGraphReport::from(closed.report))?,
    })
}

/// Estimates the similarity between two reconstructions from point pairs with outliers.
///
/// Parameters
/// ----------
/// from_points, to_points : array_like, shape (N, 3)
/// max_distance : float
///     Inlier threshold, in the unit of `to_points`.
/// seed : int, optional
///
/// Returns
/// -------
/// to_from_from : Similarity3
/// inliers : ndarray of bool, shape (N,)
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 3 finite points.
/// epipole.NoConsensusError
///     If fewer than 4 points agree.
/// ValueError
///     If ``max_distance`` is not above 0.
#[pyfunction]
#[pyo3(signature = (from_points, to_points, max_distance, seed=0))]
pub(super) fn estimate_similarity_of_points<'py>(
    py: Python<'py>,
    from_points: &Bound<'py, PyAny>,
    to_points: &Bound<'py, PyAny>,
    max_distance: f64,
    seed: u64,
) -> PyResult<(Similarity3, Bound<'py, PyArray1<bool>>)> {
    let from = points3("from_points", from_points)?;
    let to = points3("to_points", to_points)?;
    let found = progress::detach(py, || {
        sfm::estimate_similarity_of_points(&from, &to, max_distance, seed)
    });
    let (similarity, inliers) = found.or_raise()?;
    Ok((Similarity3(similarity), inliers.to_pyarray(py)))
}

/// Computes the rotations of views that best fit measured rotations between pairs.
///
/// Parameters
/// ----------
/// count : int
///     Number of views.
/// pairs : array_like of int, shape (M, 2)
///     Indices of the two views of each measurement.
/// to_from_from : array_like, shape (M, 3, 3)
///     Rotation from the frame of the first view to the frame of the second.
/// loss : str or dict, optional
///     Its width is in radians: ``"trivial"``, or ``{"huber": {"width": 0.05}}``; ``"cauchy"`` and
///     ``"truncated"`` likewise.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
///
/// Returns
/// -------
/// view_from_world : ndarray, shape (count, 3, 3)
///     The first view of each connected part has the identity.
/// errors_rad : ndarray, shape (M,)
///     Error of each measurement, radians.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are no measurements.
/// ValueError
///     If an index is out of range, a view is joined with itself, a matrix is not a rotation, or a
///     loss width is not above 0.
#[pyfunction]
#[pyo3(signature = (count, pairs, to_from_from, *, loss=None, progress=None))]
#[allow(clippy::type_complexity)]
pub(super) fn average_rotations<'py>(
    py: Python<'py>,
    count: usize,
    pairs: &Bound<'py, PyAny>,
    to_from_from: &Bound<'py, PyAny>,
    loss: Option<&Bound<'py, PyAny>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Bound<'py, PyArray3<f64>>, Bound<'py, PyArray1<f64>>)> {
    let pairs = index_rows::<2>("pairs", pairs)?;
    require_equal(
        ("pairs", pairs.len()),
        ("to_from_from", to_from_from.len()?),
    )?;
    let loss = options::loss(loss)?;
    let read = |(place, &[from, to]): (usize, &[usize; 2])| {
        let name = format!("to_from_from[{place}]");
        let matrix = rotation(&name, &to_from_from.get_item(place)?)?;
        let matrix = Rotation3::from_matrix_unchecked(matrix);
        PyResult::Ok(RelativeRotation {
            from,
            to,
            to_from_from: UnitQuaternion::from_rotation_matrix(&matrix),
        })
    };
    let measured: Vec<_> = pairs
        .iter()
        .enumerate()
        .map(read)
        .collect::<PyResult<_>>()?;
    let (views, errors) = progress::run(py, progress, |monitor| {
        sfm::average_rotations(count, &measured, loss, monitor)
    })?;
    let matrices: Vec<_> = views
        .iter()
        .map(|q| q.to_rotation_matrix().into_inner())
        .collect();
    Ok((
        from_matrices(py, &matrices)?,
        PyArray1::from_vec(py, errors),
    ))
}
