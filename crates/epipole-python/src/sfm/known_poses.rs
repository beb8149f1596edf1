//! Points from matches between images with known poses.

use super::images::SfmInput;
use super::reconstruction::Reconstruction;
use crate::camera::RigidTransform;
use crate::progress;
use epipole::sfm;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Triangulates points from matches between images with known poses; cameras do not change.
///
/// Parameters
/// ----------
/// input : SfmInput
/// cam_from_world : list of RigidTransform or None
///     Pose of each image; images without a pose are ignored.
/// progress : callable, optional
///     Called with the stage and the completed fraction.
/// **options : SfmOptions
///     See `reconstruct`; used are ``max_reprojection_error_px``, ``min_angle_deg``,
///     ``min_track_length``.
///
/// Returns
/// -------
/// Reconstruction
///     Points in the world frame of the poses; few or none if the poses do not match the images.
///
/// Raises
/// ------
/// epipole.TooFewError
///     If there are fewer than 2 images or poses.
/// epipole.DegenerateError
///     If images with the same lens number have cameras with different lenses.
/// ValueError
///     If an option is out of range, or a match refers to a missing image or keypoint.
#[pyfunction]
#[pyo3(signature = (input, cam_from_world, *, progress=None, **options))]
pub(super) fn triangulate_tracks(
    py: Python<'_>,
    input: &SfmInput,
    cam_from_world: Vec<Option<RigidTransform>>,
    progress: Option<Py<PyAny>>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Reconstruction> {
    let input = &input.0;
    let poses: Vec<_> = (cam_from_world.into_iter())
        .map(|pose| pose.map(|pose| pose.0))
        .collect();
    let found = progress::run_with(py, progress, options, |options, monitor| {
        sfm::triangulate_tracks(input, &poses, options, monitor)
    })?;
    Ok(Reconstruction(found))
}
