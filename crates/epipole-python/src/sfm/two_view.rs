//! Reconstruction of two views.

use super::bundle::plain_options;
use super::wrapper::give_indices;
use crate::arrays::{from_points, pixel_pairs};
use crate::camera::{Camera, RigidTransform};
use crate::optim::LmReport;
use crate::record::record;
use crate::{options, progress};
use epipole::sfm;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

record! {
    /// Two cameras at distance 1 and their points, in the frame of camera 1.
    "epipole.sfm" TwoViewReconstruction {
        /// Refined motion, with ``|t| == 1``.
        cam2_from_cam1: RigidTransform,
        /// Points, shape (P, 3).
        points: Py<PyArray2<f64>>,
        /// The same points before refinement, shape (P, 3).
        triangulated: Py<PyArray2<f64>>,
        /// Index of the match of each point, increasing, int64 of shape (P,).
        match_of_point: Py<PyArray1<i64>>,
        /// Number of matches in front of both cameras for each motion of E, in descending order.
        num_in_front: [usize; 4],
        /// Root mean square of the reprojection errors before refinement, pixels.
        rms_before_px: f64,
        /// Root mean square of the reprojection errors after refinement, pixels.
        rms_px: f64,
        /// `epipole.optim.LmReport` of the last refinement.
        report: Py<LmReport>,
    }
}

/// Triangulates the matches of two views and refines points and motion together.
///
/// Parameters
/// ----------
/// pixels1, pixels2 : array_like, shape (N, 2)
///     Matches without outliers.
/// camera1, camera2 : Camera
/// cam2_from_cam1 : RigidTransform
///     Initial motion; the length of its translation does not matter.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : TwoViewReconstructionOptions
///     ``min_angle_rad``, ``max_error_px``, ``min_num_points``; ``bundle``, a dict of the options
///     of `adjust_bundle`.
///
/// Returns
/// -------
/// TwoViewReconstruction
///
/// Raises
/// ------
/// epipole.TooFewError
///     If fewer than ``min_num_points`` points are left.
/// epipole.DegenerateError
///     If the motion has no translation.
/// ValueError
///     If ``min_angle_rad`` is below 0, ``max_error_px`` is not above 0, or an option of ``bundle``
///     is out of range.
#[pyfunction]
#[pyo3(signature = (
    pixels1, pixels2, camera1, camera2, cam2_from_cam1, *, progress=None, **options
))]
#[allow(clippy::too_many_arguments)]
pub(super) fn two_view_reconstruction(
    py: Python<'_>,
    pixels1: &Bound<'_, PyAny>,
    pixels2: &Bound<'_, PyAny>,
    camera1: &Camera,
    camera2: &Camera,
    cam2_from_cam1: &RigidTransform,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<TwoViewReconstruction> {
    let [pixels1, pixels2] = pixel_pairs(pixels1, pixels2)?;
    let options = options::read(plain_options(options)?.as_ref())?;
    let (cameras, motion) = ([&camera1.0, &camera2.0], &cam2_from_cam1.0);
    let found = progress::run(py, progress, |monitor| {
        sfm::two_view_reconstruction(&pixels1, &pixels2, cameras, motion, &options, monitor)
    })?;
    Ok(TwoViewReconstruction {
        cam2_from_cam1: found.cam2_from_cam1.into(),
        points: from_points(py, &found.points)?.unbind(),
        triangulated: from_points(py, &found.triangulated)?.unbind(),
        match_of_point: give_indices(py, &found.match_of_point).unbind(),
        num_in_front: found.num_in_front,
        rms_before_px: found.rms_before_px,
        rms_px: found.rms_px,
        report: Py::new(py, LmReport::give(py, found.report)?)?,
    })
}
