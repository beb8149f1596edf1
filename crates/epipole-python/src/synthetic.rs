//! Random points seen by known cameras, with ground truth.

use crate::arrays::{from_points, from_rows};
use crate::camera::PosedCamera;
use crate::errors::OrRaise;
use crate::options;
use crate::record::{Reduced, record};
use crate::register::classes;
use crate::sfm::wrapper::give_index_rows;
use epipole::synthetic;
use numpy::prelude::*;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

/// Returns the class and options that recreate a problem, for pickling.
fn reduce<'py, T: serde::Serialize>(
    object: &Bound<'py, PyAny>,
    options: &T,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
    let py = object.py();
    let options = pythonize::pythonize(py, options)?;
    let make = py.import("functools")?.getattr("partial")?;
    let make = make.call((object.get_type(),), Some(options.cast::<PyDict>()?))?;
    Ok((make, PyTuple::empty(py)))
}

/// Matches between two images of 640 x 480 pixels, with ground truth.
///
/// Parameters
/// ----------
/// **options : TwoViewProblemOptions
///     ``num_points``; ``structure``, such as ``{"cube": {"half_side_m": 1.0}}``, ``"plane"`` and
///     ``"corner"`` likewise; ``baseline_m``, ``distance_m``, ``noise_px``, ``outlier_fraction``,
///     ``seed``.
///
/// Raises
/// ------
/// epipole.DegenerateError
///     If the overlap of the cameras is too small for ``num_points`` points.
/// ValueError
///     If an option is out of range.
///
/// Examples
/// --------
/// >>> TwoViewProblem(num_points=50, seed=1).pixels1.shape
/// (50, 2)
#[pyclass(frozen, module = "epipole.synthetic")]
struct TwoViewProblem {
    options: synthetic::TwoViewProblemOptions,
    problem: synthetic::TwoViewProblem,
}

#[pymethods]
impl TwoViewProblem {
    #[new]
    #[pyo3(signature = (**options))]
    fn new(options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let options = options::read(options)?;
        let problem = synthetic::TwoViewProblem::new(&options).or_raise()?;
        Ok(Self { options, problem })
    }

    /// First camera, at (0, 0, -distance), which looks along +z.
    #[getter]
    fn camera1(&self) -> PosedCamera {
        self.problem.camera1.into()
    }

    /// Second camera, to the right of the first, which looks at the origin of the world.
    #[getter]
    fn camera2(&self) -> PosedCamera {
        self.problem.camera2.into()
    }

    /// Measured pixels in the first image, shape (N, 2).
    #[getter]
    fn pixels1<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.problem.pixels1)
    }

    /// Matching pixels in the second image, shape (N, 2).
    #[getter]
    fn pixels2<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.problem.pixels2)
    }

    /// Whether each match is correct up to noise, boolean array of shape (N,).
    #[getter]
    fn is_inlier<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.problem.is_inlier.to_pyarray(py)
    }

    /// Points in the world, shape (N, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.problem.points)
    }

    fn __repr__(&self) -> String {
        let count = self.problem.points.len();
        format!(
            "TwoViewProblem({count} matches, seed={})",
            self.options.seed
        )
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let other = other.cast::<Self>();
        other.is_ok_and(|other| other.get().problem == self.problem)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduce(slf, &slf.get().options)
    }
}

/// Cameras, points and observations, in images of 640 x 480 pixels, with ground truth.
///
/// Parameters
/// ----------
/// **options : MultiViewProblemOptions
///     ``num_cameras``, ``num_points``; ``structure``, such as ``{"cube": {"half_side_m": 1.0}}``,
///     ``"plane"`` and ``"corner"`` likewise; ``path``, such as ``{"arc": {"radius_m": 6.0,
///     "span_rad": 1.0}}`` or ``{"line": {"distance_m": 6.0, "spacing_m": 0.5}}``;
///     ``visible_fraction``, ``noise_px``, ``outlier_fraction``, ``seed``.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 cameras.
/// epipole.DegenerateError
///     If too few points are visible in two cameras.
/// ValueError
///     If an option is out of range.
#[pyclass(frozen, module = "epipole.synthetic")]
struct MultiViewProblem {
    options: synthetic::MultiViewProblemOptions,
    problem: synthetic::MultiViewProblem,
}

#[pymethods]
impl MultiViewProblem {
    #[new]
    #[pyo3(signature = (**options))]
    fn new(options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let options = options::read(options)?;
        let problem = synthetic::MultiViewProblem::new(&options).or_raise()?;
        Ok(Self { options, problem })
    }

    /// Ground-truth cameras, a list of `epipole.camera.PosedCamera`.
    #[getter]
    fn cameras(&self) -> Vec<PosedCamera> {
        let cameras = self.problem.cameras.iter();
        cameras.map(|&camera| camera.into()).collect()
    }

    /// Ground-truth points in the world, shape (P, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.problem.points)
    }

    /// All observations, sorted by point, then by camera.
    #[getter]
    fn observations(&self, py: Python<'_>) -> PyResult<Sightings> {
        let sightings = &self.problem.observations;
        let pixels = sightings.iter().map(|sighting| sighting.pixel.coords);
        let is_inlier = sightings.iter().map(|sighting| sighting.is_inlier);
        let rows = sightings
            .iter()
            .map(|sighting| [sighting.camera, sighting.point]);
        Ok(Sightings {
            indices: give_index_rows(py, rows)?.unbind(),
            pixels: from_rows(py, pixels)?.unbind(),
            is_inlier: PyArray1::from_iter(py, is_inlier).unbind(),
        })
    }

    /// Returns the observations of each point.
    ///
    /// Returns
    /// -------
    /// list of Any
    ///     Slices of the observations.
    fn tracks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let slice = |range: std::ops::Range<usize>| {
            pyo3::types::PySlice::new(py, range.start as isize, range.end as isize, 1)
        };
        PyList::new(py, self.problem.tracks().into_iter().map(slice))
    }

    fn __repr__(&self) -> String {
        let (cameras, points) = (self.problem.cameras.len(), self.problem.points.len());
        let seed = self.options.seed;
        format!("MultiViewProblem({cameras} cameras, {points} points, seed={seed})")
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let other = other.cast::<Self>();
        other.is_ok_and(|other| other.get().problem == self.problem)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduce(slf, &slf.get().options)
    }
}

record! {
    /// Observations of points by cameras; row k of each array belongs to observation k.
    "epipole.synthetic" Sightings {
        /// Indices of the camera and the point, int64 of shape (M, 2).
        indices: Py<PyArray2<i64>>,
        /// Measured pixels, shape (M, 2).
        pixels: Py<PyArray2<f64>>,
        /// Whether each observation is correct up to noise, boolean array of shape (M,).
        is_inlier: Py<PyArray1<bool>>,
    }
}

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    crate::options::declare(
        module,
        &epipole::synthetic::MultiViewProblemOptions::default(),
    )?;
    crate::options::declare(
        module,
        &epipole::synthetic::TwoViewProblemOptions::default(),
    )?;
    classes!(module: TwoViewProblem, MultiViewProblem, Sightings);
    Ok(())
}
