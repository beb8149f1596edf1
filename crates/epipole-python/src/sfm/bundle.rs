//! Bundle adjustment.

use super::images::PositionPrior;
use super::wrapper::{give_index_rows, give_indices, index_rows, indices, require_equal, wrapper};
use crate::arrays::{from_points, from_rows, from_vector, points2, points3};
use crate::camera::{Camera, PosedCamera, RigidTransform};
use crate::optim::LmReport;
use crate::{options, progress};
use epipole::nalgebra::Vector2;
use epipole::sfm::{self, BundleObservation};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Additional camera rigidly mounted on each camera of a bundle, such as the right one of a rig.
///
/// Parameters
/// ----------
/// sensor_from_camera : RigidTransform
///     Transform from the camera frame to the sensor frame; not refined.
/// camera : Camera
///     Image size, intrinsics and lens of the sensor.
/// lens : int
///     Lens number, as in `Bundle.lens_of_camera`.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(super) struct Sensor(sfm::Sensor);

wrapper!(Sensor: sensor_from_camera, camera, lens);

#[pymethods]
impl Sensor {
    #[new]
    #[pyo3(signature = (sensor_from_camera, camera, lens=0))]
    fn new(sensor_from_camera: &RigidTransform, camera: &Camera, lens: usize) -> Self {
        Self(sfm::Sensor {
            sensor_from_camera: sensor_from_camera.0,
            camera: camera.0,
            lens,
        })
    }

    /// Transform from the camera frame to the sensor frame.
    #[getter]
    fn sensor_from_camera(&self) -> RigidTransform {
        self.0.sensor_from_camera.into()
    }

    /// Image size, intrinsics and lens.
    #[getter]
    fn camera(&self) -> Camera {
        self.0.camera.into()
    }

    /// Lens number.
    #[getter]
    fn lens(&self) -> usize {
        self.0.lens
    }
}

/// Cameras, points and observations.
///
/// Parameters
/// ----------
/// cameras : list of PosedCamera
/// points : array_like, shape (P, 3)
///     Points in the world.
/// observations : array_like of int, shape (M, 2)
///     Index of the camera and of the point.
/// pixels : array_like, shape (M, 2)
///     Pixel of each observation.
/// lens_of_camera : array_like of int, optional
///     Lens number of each camera; 0 by default. Cameras with the same number have equal lenses and
///     share their refined parameters.
/// sensors : list of Sensor, optional
///     Additional cameras mounted on each camera.
/// sensor_of_observation : array_like of int, optional
///     For each observation, 0 if the camera itself made it, k if sensor k - 1 did; 0 by default.
#[pyclass(frozen, module = "epipole.sfm")]
pub(super) struct Bundle(pub(super) sfm::Bundle);

wrapper!(
    Bundle: cameras, points, observations, pixels, lens_of_camera, sensors, sensor_of_observation
);

#[pymethods]
impl Bundle {
    #[new]
    #[pyo3(signature = (
        cameras, points, observations, pixels, lens_of_camera=None, sensors=None,
        sensor_of_observation=None
    ))]
    fn new(
        cameras: Vec<PosedCamera>,
        points: &Bound<'_, PyAny>,
        observations: &Bound<'_, PyAny>,
        pixels: &Bound<'_, PyAny>,
        lens_of_camera: Option<&Bound<'_, PyAny>>,
        sensors: Option<Vec<Sensor>>,
        sensor_of_observation: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let optional = |name: &str, value: Option<&Bound<'_, PyAny>>| {
            value.map_or_else(|| Ok(Vec::new()), |value| indices(name, value))
        };
        let sensors = sensors.unwrap_or_default();
        Ok(Self(sfm::Bundle {
            cameras: cameras.into_iter().map(|camera| camera.0).collect(),
            lens_of_camera: optional("lens_of_camera", lens_of_camera)?,
            points: points3("points", points)?,
            observations: observed(observations, pixels)?,
            sensors: sensors.into_iter().map(|sensor| sensor.0).collect(),
            sensor_of_observation: optional("sensor_of_observation", sensor_of_observation)?,
        }))
    }

    /// Cameras, a list of `PosedCamera`.
    #[getter]
    fn cameras(&self) -> Vec<PosedCamera> {
        self.0.cameras.iter().map(|&camera| camera.into()).collect()
    }

    /// Points in the world, shape (P, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        from_points(py, &self.0.points)
    }

    /// Index of the camera and of the point, int64 of shape (M, 2).
    #[getter]
    fn observations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        give_index_rows(py, self.0.observations.iter().map(|o| [o.camera, o.point]))
    }

    /// Pixel of each observation, shape (M, 2).
    #[getter]
    fn pixels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        give_pixels(py, &self.0.observations)
    }

    /// Lens number of each camera, int64 array.
    #[getter]
    fn lens_of_camera<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        give_indices(py, &self.0.lens_of_camera)
    }

    /// Additional cameras mounted on each camera, a list of `Sensor`.
    #[getter]
    fn sensors(&self) -> Vec<Sensor> {
        self.0
            .sensors
            .iter()
            .map(|&sensor| Sensor(sensor))
            .collect()
    }

    /// Sensor of each observation, int64 array; 0 for the camera itself.
    #[getter]
    fn sensor_of_observation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        give_indices(py, &self.0.sensor_of_observation)
    }

    /// Returns the reprojection error of an observation, predicted minus observed, shape (2,).
    ///
    /// Parameters
    /// ----------
    /// observation : int
    ///     Index of the observation.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If the observation does not exist, or its camera or point does not.
    fn residual_px<'py>(
        &self,
        py: Python<'py>,
        observation: usize,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let Some(observation_value) = self.0.observations.get(observation) else {
            let count = self.0.observations.len();
            let message = format!("observation is {observation}, but there are {count}");
            return Err(PyIndexError::new_err(message));
        };
        if observation_value.camera >= self.0.cameras.len()
            || observation_value.point >= self.0.points.len()
        {
            let message = format!("observation {observation} has no camera or no point");
            return Err(PyIndexError::new_err(message));
        }
        let residual: Vector2<f64> = self.0.residual_px(observation);
        Ok(from_vector(py, &residual))
    }
}

/// Reads observations from indices and pixels.
pub(super) fn observed(
    observations: &Bound<'_, PyAny>,
    pixels: &Bound<'_, PyAny>,
) -> PyResult<Vec<BundleObservation>> {
    let observations = index_rows::<2>("observations", observations)?;
    let pixels = points2("pixels", pixels)?;
    require_equal(
        ("observations", observations.len()),
        ("pixels", pixels.len()),
    )?;
    let pairs = observations.iter().zip(pixels);
    Ok(pairs
        .map(|(&[camera, point], pixel)| BundleObservation {
            camera,
            point,
            pixel,
        })
        .collect())
}

/// Returns the pixels of observations as an array, shape (M, 2).
pub(super) fn give_pixels<'py>(
    py: Python<'py>,
    observations: &[BundleObservation],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    from_rows(py, observations.iter().map(|o| o.pixel.coords))
}

/// Options with arrays as lists, and priors as dictionaries.
pub(super) fn plain_options<'py>(
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(options) = options else {
        return Ok(None);
    };
    let plain = options.copy()?;
    for (key, value) in options {
        if value.hasattr("tolist")? {
            plain.set_item(key, value.call_method0("tolist")?)?;
        } else if let Ok(list) = value.cast::<PyList>() {
            let priors = list
                .iter()
                .map(|entry| match entry.cast::<PositionPrior>() {
                    Ok(prior) => Ok(pythonize::pythonize(options.py(), &prior.get().0)?),
                    Err(_) => Ok(entry),
                });
            let priors = priors.collect::<PyResult<Vec<_>>>()?;
            plain.set_item(key, priors)?;
        }
    }
    Ok(Some(plain))
}

/// Refines cameras, points and, optionally, lenses by minimizing the reprojection errors.
///
/// Parameters
/// ----------
/// bundle : Bundle
///     Not changed.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : BundleOptions
///     ``loss``, its width in pixels; ``refine_focal``, ``refine_principal_point``,
///     ``refine_distortion``, ``refine_tangential``; ``gauge``, ``"two_cameras"`` or ``"free"``;
///     ``held_cameras`` and ``held_points``, lists of bool; ``position_priors``, a list of
///     `PositionPrior` or None; ``position_loss``; ``lm``, a dict such as ``{"max_iterations":
///     50}``.
///
/// Returns
/// -------
/// bundle : Bundle
/// report : epipole.optim.LmReport
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are no observations.
/// epipole.DegenerateError
///     If cameras with the same lens number have different lenses.
/// ValueError
///     If an observation refers to a missing camera, point or sensor, a lens number is out of
///     range, the loss width or a standard deviation is not above 0, or the initial cost is not
///     finite.
#[pyfunction]
#[pyo3(signature = (bundle, *, progress=None, **options))]
pub(super) fn adjust_bundle(
    py: Python<'_>,
    bundle: &Bundle,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<(Bundle, LmReport)> {
    let options = options::read(plain_options(options)?.as_ref())?;
    let mut bundle = bundle.0.clone();
    let report = progress::run(py, progress, |monitor| {
        sfm::adjust_bundle(&mut bundle, &options, monitor)
    })?;
    Ok((Bundle(bundle), LmReport::give(py, report)?))
}
