//! Odometry.

use super::images::{SfmImage, SfmInput, matches};
use super::incremental::SfmStep;
use super::reconstruction::Reconstruction;
use super::wrapper::wrapper;
use crate::camera::{Camera, RigidTransform};
use crate::steps::{self, Job, take};
use crate::{options, progress};
use epipole::feature::Match;
use epipole::progress::Monitor;
use epipole::sfm;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Mutex;

/// Path of a camera.
///
/// Parameters
/// ----------
/// world_from_cam : list of RigidTransform or None
/// keyframes, lost : list of int
/// reconstruction : Reconstruction
/// is_complete : bool
#[pyclass(frozen, module = "epipole.sfm")]
pub(super) struct OdometryResult(sfm::OdometryResult);

wrapper!(OdometryResult: world_from_cam, keyframes, lost, reconstruction, is_complete);

#[pymethods]
impl OdometryResult {
    #[new]
    fn new(
        world_from_cam: Vec<Option<RigidTransform>>,
        keyframes: Vec<usize>,
        lost: Vec<usize>,
        reconstruction: &Reconstruction,
        is_complete: bool,
    ) -> Self {
        Self(sfm::OdometryResult {
            world_from_cam: world_from_cam
                .into_iter()
                .map(|pose| Some(pose?.0))
                .collect(),
            keyframes,
            lost,
            reconstruction: reconstruction.0.clone(),
            is_complete,
        })
    }

    /// ``world_from_cam`` of each frame, None if it was lost. The first frame found is the origin.
    #[getter]
    fn world_from_cam(&self) -> Vec<Option<RigidTransform>> {
        let poses = self.0.world_from_cam.iter();
        poses.map(|&pose| Some(pose?.into())).collect()
    }

    /// Frames that provide points.
    #[getter]
    fn keyframes(&self) -> Vec<usize> {
        self.0.keyframes.clone()
    }

    /// Frames that could not be registered.
    #[getter]
    fn lost(&self) -> Vec<usize> {
        self.0.lost.clone()
    }

    /// Cameras and points; for a stereo rig, the left cameras followed by the right ones.
    #[getter]
    fn reconstruction(&self) -> Reconstruction {
        Reconstruction(self.0.reconstruction.clone())
    }

    /// Whether every frame was tried.
    #[getter]
    fn is_complete(&self) -> bool {
        self.0.is_complete
    }
}

/// Arguments of the functions for stereo rigs.
struct Right {
    images: Vec<sfm::SfmImage>,
    /// Matches between the two images of each frame.
    pairs: Vec<Vec<Match>>,
}

impl Right {
    fn read(right: Vec<SfmImage>, left_right: Vec<Bound<'_, PyAny>>) -> PyResult<Self> {
        let frames = left_right.iter().enumerate();
        let pairs = frames.map(|(k, frame)| matches(&format!("left_right[{k}]"), frame));
        Ok(Self {
            images: right.into_iter().map(|image| image.0).collect(),
            pairs: pairs.collect::<PyResult<_>>()?,
        })
    }
}

/// Estimates the path of a single camera, up to scale.
///
/// Parameters
/// ----------
/// input : SfmInput
///     Frames in order of time, and matches between frames close in time.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : OdometryOptions
///     ``sfm``, a dict of the options of `reconstruct`; ``window``, the number of keyframes refined
///     together; ``final_adjustment``.
///
/// Returns
/// -------
/// OdometryResult
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 images.
/// epipole.DegenerateError
///     If no two images have enough points at a sufficient angle, or images with the same lens
///     number have cameras with different lenses.
/// ValueError
///     If an option is out of range, or a match refers to a missing image or keypoint.
#[pyfunction]
#[pyo3(signature = (input, *, progress=None, **options))]
pub(super) fn monocular_odometry(
    py: Python<'_>,
    input: &SfmInput,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<OdometryResult> {
    let input = &input.0;
    let result = progress::run_with(py, progress, options, |options, monitor| {
        sfm::monocular_odometry(input, options, monitor)
    })?;
    Ok(OdometryResult(result))
}

/// Estimates the path of a stereo rig, in the unit of its baseline.
///
/// Parameters
/// ----------
/// left : SfmInput
///     Frames of the left camera in order of time, and matches between them.
/// right : list of SfmImage
///     The same frames of the right camera.
/// left_right : list of epipole.feature.Matches or array_like of int, shape (M, 2)
///     Matches between the two images of each frame, left first.
/// right_from_left : RigidTransform
/// right_camera : Camera
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : OdometryOptions
///     See `monocular_odometry`.
///
/// Returns
/// -------
/// OdometryResult
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 images.
/// epipole.DegenerateError
///     If the rig has no baseline, the first frame has too few matches, or images with the same
///     lens number have cameras with different lenses.
/// ValueError
///     If an option is out of range, or a match refers to a missing image or keypoint.
#[pyfunction]
#[pyo3(signature = (
    left, right, left_right, right_from_left, right_camera, *, progress=None, **options
))]
#[allow(clippy::too_many_arguments)]
pub(super) fn stereo_odometry(
    py: Python<'_>,
    left: &SfmInput,
    right: Vec<SfmImage>,
    left_right: Vec<Bound<'_, PyAny>>,
    right_from_left: &RigidTransform,
    right_camera: &Camera,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<OdometryResult> {
    let options = options::read(options)?;
    let Right { images, pairs } = Right::read(right, left_right)?;
    let (left, motion, camera) = (&left.0, &right_from_left.0, &right_camera.0);
    let result = progress::run(py, progress, |monitor| {
        sfm::stereo_odometry(left, &images, &pairs, motion, camera, &options, monitor)
    })?;
    Ok(OdometryResult(result))
}

/// Step-by-step `monocular_odometry` or `stereo_odometry`.
#[pyclass(frozen, module = "epipole.sfm")]
pub(super) struct Odometry(Job<sfm::Odometry>);

#[pymethods]
impl Odometry {
    /// Starts with a single camera; see `monocular_odometry`.
    ///
    /// Parameters
    /// ----------
    /// input : SfmInput
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : OdometryOptions
    ///     See `monocular_odometry`.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 2 images.
    /// epipole.DegenerateError
    ///     If no two images have enough points at a sufficient angle, or images with the same lens
    ///     number have cameras with different lenses.
    /// ValueError
    ///     If an option is out of range, or a match refers to a missing image or keypoint.
    #[staticmethod]
    #[pyo3(signature = (input, *, progress=None, **options))]
    fn monocular(
        py: Python<'_>,
        input: &SfmInput,
        progress: Option<Py<PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let monocular = |options: &_, monitor: &mut dyn Monitor| {
            sfm::Odometry::monocular(&input.0, options, monitor)
        };
        Ok(Self(steps::start(py, progress, options, monocular)?))
    }

    /// Starts with a stereo rig; see `stereo_odometry`.
    ///
    /// Parameters
    /// ----------
    /// left : SfmInput
    /// right : list of SfmImage
    /// left_right : list of epipole.feature.Matches or array_like of int, shape (M, 2)
    /// right_from_left : RigidTransform
    /// right_camera : Camera
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    /// **options : OdometryOptions
    ///     See `monocular_odometry`.
    ///
    /// Raises
    /// ------
    /// epipole.TooFewError
    ///     If there are fewer than 2 images.
    /// epipole.DegenerateError
    ///     If the rig has no baseline, the first frame has too few matches, or images with the same
    ///     lens number have cameras with different lenses.
    /// ValueError
    ///     If an option is out of range, or a match refers to a missing image or keypoint.
    #[staticmethod]
    #[pyo3(signature = (
        left, right, left_right, right_from_left, right_camera, *, progress=None, **options
    ))]
    #[allow(clippy::too_many_arguments)]
    fn stereo(
        py: Python<'_>,
        left: &SfmInput,
        right: Vec<SfmImage>,
        left_right: Vec<Bound<'_, PyAny>>,
        right_from_left: &RigidTransform,
        right_camera: &Camera,
        progress: Option<Py<PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let options = options::read(options)?;
        let Right { images, pairs } = Right::read(right, left_right)?;
        let (left, motion, camera) = (&left.0, &right_from_left.0, &right_camera.0);
        let started = progress::run(py, progress, |monitor| {
            sfm::Odometry::stereo(left, &images, &pairs, motion, camera, &options, monitor)
        })?;
        Ok(Self(Mutex::new(Some(started))))
    }

    /// Takes the next step and returns an `SfmStep`; None after the last.
    ///
    /// After an interruption, the next call resumes.
    ///
    /// Parameters
    /// ----------
    /// progress : callable, optional
    ///     Called with the stage and the completed fraction.
    ///
    /// Raises
    /// ------
    /// RuntimeError
    ///     If the job is finished, or another thread uses it.
    #[pyo3(signature = (*, progress=None))]
    fn step(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<Option<SfmStep>> {
        let step = steps::step(&self.0, py, progress, sfm::Odometry::step);
        Ok(step?.map(SfmStep))
    }

    /// Ends the job and returns the path so far, an `OdometryResult`.
    ///
    /// Raises
    /// ------
    /// RuntimeError
    ///     If the job is finished, or another thread uses it.
    fn finish(&self) -> PyResult<OdometryResult> {
        Ok(OdometryResult(take(&self.0)?.finish()))
    }
}
