//! Bundle adjustment in the large.

use super::bundle::{give_pixels, observed};
use super::wrapper::{give_index_rows, wrapper};
use crate::arrays::{from_points, from_rows, points3, vectors};
use crate::errors::OrRaise;
use crate::optim::LmReport;
use crate::{options, progress};
use epipole::nalgebra::{SVector, Vector3};
use epipole::sfm::{self, BalCamera};
use numpy::PyArray2;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Bundle adjustment problem of the BAL data set.
///
/// Parameters
/// ----------
/// cameras : array_like, shape (C, 9)
///     Rotation as axis times angle (radians), translation, focal length (pixels), k1, k2. The
///     camera looks along -z; pixels have their origin at the image center, with v up.
/// points : array_like, shape (P, 3)
/// observations : array_like of int, shape (M, 2)
///     Index of the camera and of the point.
/// pixels : array_like, shape (M, 2)
#[pyclass(frozen, module = "epipole.sfm")]
pub(crate) struct BalProblem(pub(crate) sfm::BalProblem);

wrapper!(BalProblem: cameras, points, observations, pixels);

#[pymethods]
impl BalProblem {
    #[new]
    fn new(
        cameras: &Bound<'_, PyAny>,
        points: &Bound<'_, PyAny>,
        observations: &Bound<'_, PyAny>,
        pixels: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let camera = |row: SVector<f64, 9>| BalCamera {
            rotation: Vector3::new(row[0], row[1], row[2]),
            translation: Vector3::new(row[3], row[4], row[5]),
            focal_px: row[6],
            k1: row[7],
            k2: row[8],
        };
        let cameras = vectors::<9>("cameras", cameras)?;
        Ok(Self(sfm::BalProblem {
            cameras: cameras.into_iter().map(camera).collect(),
            points: points3("points", points)?,
            observations: observed(observations, pixels)?,
        }))
    }

    /// Cameras, shape (C, 9): rotation, translation, focal length, k1, k2.
    #[getter]
    fn cameras<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let row = |camera: &BalCamera| {
            let (r, t) = (&camera.rotation, &camera.translation);
            let (f, k1, k2) = (camera.focal_px, camera.k1, camera.k2);
            SVector::<f64, 9>::from([r.x, r.y, r.z, t.x, t.y, t.z, f, k1, k2])
        };
        from_rows(py, self.0.cameras.iter().map(row))
    }

    /// Points, shape (P, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.0.points)
    }

    /// Index of the camera and of the point, int64 of shape (M, 2).
    #[getter]
    fn observations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        give_index_rows(py, self.0.observations.iter().map(|o| [o.camera, o.point]))
    }

    /// Pixel of each observation, shape (M, 2), v up.
    #[getter]
    fn pixels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        give_pixels(py, &self.0.observations)
    }

    /// Computes half the sum of the losses, square pixels.
    ///
    /// Parameters
    /// ----------
    /// loss : str or dict, optional
    ///     As in `adjust_bal`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the loss width is not above 0.
    /// IndexError
    ///     If an observation refers to a missing camera or point.
    #[pyo3(signature = (loss=None))]
    fn cost(&self, loss: Option<&Bound<'_, PyAny>>) -> PyResult<f64> {
        let loss = options::loss(loss)?;
        loss.check().or_raise()?;
        let (cameras, points) = (self.0.cameras.len(), self.0.points.len());
        let mut observations = self.0.observations.iter();
        if observations.any(|o| o.camera >= cameras || o.point >= points) {
            let message = "observations has the index of a camera or point that is not there";
            return Err(PyIndexError::new_err(message));
        }
        Ok(self.0.cost(loss))
    }
}

/// Refines all cameras and points of a BAL problem.
///
/// Parameters
/// ----------
/// problem : BalProblem
///     Not changed.
/// loss : str or dict, optional
///     ``"trivial"``, or ``{"huber": {"width": 1.0}}``; ``"cauchy"`` and ``"truncated"`` likewise.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : LmOptions
///     ``max_iterations``, ``gradient_tolerance``, ``step_tolerance``, ``cost_tolerance``,
///     ``initial_damping``, ``patience``.
///
/// Returns
/// -------
/// problem : BalProblem
/// report : epipole.optim.LmReport
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are no observations.
/// ValueError
///     If an observation refers to a missing camera or point, the loss width is not above 0, or the
///     initial cost is not finite.
#[pyfunction]
#[pyo3(signature = (problem, *, loss=None, progress=None, **options))]
pub(super) fn adjust_bal(
    py: Python<'_>,
    problem: &BalProblem,
    loss: Option<&Bound<'_, PyAny>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(BalProblem, LmReport)> {
    let loss = options::loss(loss)?;
    let mut problem = problem.0.clone();
    let report = progress::run_with(py, progress, options, |options, monitor| {
        sfm::adjust_bal(&mut problem, options, loss, monitor)
    })?;
    Ok((BalProblem(problem), LmReport::give(py, report)?))
}
