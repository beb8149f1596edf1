//! Structure from motion.

use super::images::SfmInput;
use super::reconstruction::Reconstruction;
use super::wrapper::wrapper;
use crate::record::record;
use crate::steps::{self, Job, take, with};
use crate::{options, progress};
use epipole::progress::Monitor;
use epipole::sfm;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// One step of structure from motion or of odometry.
///
/// Parameters
/// ----------
/// kind : {"started", "registered", "adjusted"}
/// images : list of int
///     The two images that started a component, the registered one, or none.
/// num_registered : int, optional
///     Number of registered images in the component.
/// num_points : int, optional
///     Number of points in the component.
/// cost : float, optional
///     Cost after the refinement, square pixels.
///
/// Raises
/// ------
/// ValueError
///     If ``kind`` is unknown, or the arguments do not fit it.
#[pyclass(frozen, from_py_object, module = "epipole.sfm")]
#[derive(Clone)]
pub(super) struct SfmStep(pub(super) sfm::SfmStep);

wrapper!(SfmStep: kind, images, num_registered, num_points, cost);

#[pymethods]
impl SfmStep {
    #[new]
    #[pyo3(signature = (kind, images, num_registered=None, num_points=None, cost=None))]
    fn new(
        kind: &str,
        images: Vec<usize>,
        num_registered: Option<usize>,
        num_points: Option<usize>,
        cost: Option<f64>,
    ) -> PyResult<Self> {
        Ok(Self(
            match (kind, &*images, num_registered, num_points, cost) {
                ("started", &[first, second], _, Some(num_points), _) => sfm::SfmStep::Started {
                    images: [first, second],
                    num_points,
                },
                ("registered", &[image], Some(num_registered), Some(num_points), cost) => {
                    sfm::SfmStep::Registered {
                        image,
                        num_registered,
                        num_points,
                        cost,
                    }
                }
                ("adjusted", _, _, _, Some(cost)) => sfm::SfmStep::Adjusted { cost },
                _ => {
                    return Err(PyValueError::new_err(
                        "kind does not fit the other arguments",
                    ));
                }
            },
        ))
    }

    /// "started", "registered" or "adjusted".
    #[getter]
    fn kind(&self) -> PyResult<&'static str> {
        match self.0 {
            sfm::SfmStep::Started { .. } => Ok("started"),
            sfm::SfmStep::Registered { .. } => Ok("registered"),
            sfm::SfmStep::Adjusted { .. } => Ok("adjusted"),
            _ => Err(PyRuntimeError::new_err("unknown kind of step")),
        }
    }

    /// The two images that started a component, the registered one, or none.
    #[getter]
    fn images(&self) -> Vec<usize> {
        match self.0 {
            sfm::SfmStep::Started { images, .. } => images.to_vec(),
            sfm::SfmStep::Registered { image, .. } => vec![image],
            _ => Vec::new(),
        }
    }

    /// Number of registered images in the component.
    #[getter]
    fn num_registered(&self) -> Option<usize> {
        match self.0 {
            sfm::SfmStep::Registered { num_registered, .. } => Some(num_registered),
            _ => None,
        }
    }

    /// Number of points in the component.
    #[getter]
    fn num_points(&self) -> Option<usize> {
        match self.0 {
            sfm::SfmStep::Started { num_points, .. }
            | sfm::SfmStep::Registered { num_points, .. } => Some(num_points),
            _ => None,
        }
    }

    /// Half the sum of the losses after the refinement, square pixels; None if it failed.
    #[getter]
    fn cost(&self) -> Option<f64> {
        self.0.cost()
    }
}

/// Result of structure from motion.
///
/// Parameters
/// ----------
/// components : list of Reconstruction
/// unregistered : list of int
/// steps : list of SfmStep
/// is_complete : bool
#[pyclass(frozen, module = "epipole.sfm")]
pub(super) struct SfmResult(pub(super) sfm::SfmResult);

wrapper!(SfmResult: components, unregistered, steps, is_complete);

#[pymethods]
impl SfmResult {
    #[new]
    fn new(
        components: Vec<Reconstruction>,
        unregistered: Vec<usize>,
        steps: Vec<SfmStep>,
        is_complete: bool,
    ) -> Self {
        Self(sfm::SfmResult {
            components: components
                .into_iter()
                .map(|component| component.0)
                .collect(),
            unregistered,
            steps: steps.into_iter().map(|step| step.0).collect(),
            is_complete,
        })
    }

    /// Reconstructions that could not be connected, largest first, each in its own frame.
    #[getter]
    fn components(&self) -> Vec<Reconstruction> {
        self.0
            .components
            .iter()
            .cloned()
            .map(Reconstruction)
            .collect()
    }

    /// Images in no component.
    #[getter]
    fn unregistered(&self) -> Vec<usize> {
        self.0.unregistered.clone()
    }

    /// Steps taken, in order.
    #[getter]
    fn steps(&self) -> Vec<SfmStep> {
        self.0.steps.iter().copied().map(SfmStep).collect()
    }

    /// Whether every image was tried.
    #[getter]
    fn is_complete(&self) -> bool {
        self.0.is_complete
    }
}

/// Reconstructs cameras and points from matches between images.
///
/// Parameters
/// ----------
/// input : SfmInput
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SfmOptions
///     ``ransac``, a dict; ``max_registration_error_px``, ``max_reprojection_error_px``,
///     ``min_num_inliers``, ``min_angle_deg``, ``min_start_angle_deg``, ``min_track_length``,
///     ``refine_focal``, ``refine_principal_point``, ``refine_distortion``,
///     ``refine_tangential``, ``seed``.
///
/// Returns
/// -------
/// SfmResult
///     No components if no pair has enough matches.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 images.
/// epipole.DegenerateError
///     If images with the same lens number have cameras with different lenses.
/// ValueError
///     If an option is out of range, or a match refers to a missing image or keypoint.
#[pyfunction]
#[pyo3(signature = (input, *, progress=None, **options))]
pub(super) fn reconstruct(
    py: Python<'_>,
    input: &SfmInput,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<SfmResult> {
    let input = &input.0;
    let result = progress::run_with(py, progress, options, |options, monitor| {
        sfm::reconstruct(input, options, monitor)
    })?;
    Ok(SfmResult(result))
}

/// Step-by-step `reconstruct`.
///
/// Parameters
/// ----------
/// input : SfmInput
/// progress : callable, optional
///     Called with the stage and the completed fraction while pairs are verified.
/// **options : SfmOptions
///     See `reconstruct`.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 images.
/// epipole.DegenerateError
///     If images with the same lens number have cameras with different lenses.
/// ValueError
///     If an option is out of range, or a match refers to a missing image or keypoint.
#[pyclass(frozen, module = "epipole.sfm")]
pub(super) struct IncrementalReconstruction(Job<sfm::IncrementalReconstruction>);

#[pymethods]
impl IncrementalReconstruction {
    #[new]
    #[pyo3(signature = (input, *, progress=None, **options))]
    fn new(
        py: Python<'_>,
        input: &SfmInput,
        progress: Option<Py<PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let start = |options: &_, monitor: &mut dyn Monitor| {
            sfm::IncrementalReconstruction::new(&input.0, options, monitor)
        };
        Ok(Self(steps::start(py, progress, options, start)?))
    }

    /// Takes the next step and returns it; None after the last.
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
        let step = steps::step(&self.0, py, progress, sfm::IncrementalReconstruction::step);
        Ok(step?.map(SfmStep))
    }

    /// Returns the component that currently grows, a `Reconstruction`; None between components.
    ///
    /// Raises
    /// ------
    /// RuntimeError
    ///     If the job is finished, or another thread uses it.
    fn current(&self) -> PyResult<Option<Reconstruction>> {
        with(&self.0, |work| Ok(work.current().map(Reconstruction)))
    }

    /// Ends the job and returns all components, including the current one.
    ///
    /// Raises
    /// ------
    /// RuntimeError
    ///     If the job is finished, or another thread uses it.
    fn finish(&self) -> PyResult<SfmResult> {
        Ok(SfmResult(take(&self.0)?.finish()))
    }
}

record! {
    /// Reason an image is in no reconstruction.
    "epipole.sfm" WhyUnregistered {
        /// "few_features", "few_matches", "no_motion", "no_baseline", "no_start", "few_points",
        /// "no_pose" or "not_tried".
        kind: String,
        /// Reason as a sentence.
        message: String,
    }
}

/// Rejects a result with images or keypoints missing in the input.
fn require_images(input: &sfm::SfmInput, result: &sfm::SfmResult) -> PyResult<()> {
    let images = &input.images;
    let is_missing = |element: &sfm::TrackElement| {
        let image = images.get(element.image as usize);
        image.is_none_or(|image| element.keypoint as usize >= image.keypoints.len())
    };
    let is_other = |component: &sfm::Reconstruction| {
        let mut elements = component.points.iter().flat_map(|point| &point.track);
        component.cameras.len() != images.len() || elements.any(is_missing)
    };
    let is_absent = |&image: &usize| image >= images.len();
    if result.unregistered.iter().any(is_absent) || result.components.iter().any(is_other) {
        return Err(PyValueError::new_err(
            "result has images or keypoints that input does not have",
        ));
    }
    Ok(())
}

/// Returns the reasons why images are in no reconstruction.
///
/// Parameters
/// ----------
/// input : SfmInput
/// result : SfmResult
///     Result of `reconstruct`.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SfmOptions
///     Options given to `reconstruct`.
///
/// Returns
/// -------
/// list of WhyUnregistered
///     One for each image of ``result.unregistered``.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 images.
/// epipole.DegenerateError
///     If images with the same lens number have cameras with different lenses.
/// ValueError
///     If an option is out of range, a match refers to a missing image or keypoint, or ``result``
///     belongs to other images.
#[pyfunction]
#[pyo3(signature = (input, result, *, progress=None, **options))]
pub(super) fn why_unregistered(
    py: Python<'_>,
    input: &SfmInput,
    result: &SfmResult,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<WhyUnregistered>> {
    use sfm::WhyUnregistered as Why;
    let options = options::read(options)?;
    let (input, result) = (&input.0, &result.0);
    require_images(input, result)?;
    let reasons = progress::run(py, progress, |monitor| {
        sfm::why_unregistered(input, &options, result, monitor)
    })?;
    let kind = |why: &Why| match why {
        Why::FewFeatures { .. } => "few_features",
        Why::FewMatches { .. } => "few_matches",
        Why::NoMotion => "no_motion",
        Why::NoBaseline => "no_baseline",
        Why::NoStart => "no_start",
        Why::FewPoints { .. } => "few_points",
        Why::NoPose { .. } => "no_pose",
        Why::NotTried => "not_tried",
        _ => "other",
    };
    Ok((reasons.iter())
        .map(|why| WhyUnregistered {
            kind: kind(why).to_owned(),
            message: why.to_string(),
        })
        .collect())
}
