//! Code that triangulates points for known cameras, as `epipole sfm --poses` does.

use super::convert::sentence;
use super::reconstruction::{Component, Reconstructed, UnregisteredReason};
use super::task::{Monitor, Progress};
use crate::project::Pose;
use epipole::camera::RigidTransform;
use epipole::progress::Status;
use epipole::sfm::{SfmInput, SfmOptions, triangulate_tracks};
use nalgebra::{Quaternion, UnitQuaternion};

/// Triangulates points for known poses.
///
/// # Errors
/// A message, if the poses do not fit the photographs, or for cancellation.
pub(super) fn triangulate(
    input: &SfmInput,
    poses: &[Option<Pose>],
    options: &SfmOptions,
    monitor: Monitor<'_>,
) -> Result<Reconstructed, String> {
    let rigid = |pose: &Pose| {
        let [i, j, k, w] = pose.rotation;
        let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        RigidTransform::from_parts(pose.translation.into(), rotation)
    };
    let cam_from_world: Vec<_> = (poses.iter())
        .map(|pose| pose.as_ref().map(rigid))
        .collect();
    if cam_from_world.iter().flatten().count() < 2 {
        return Err("fewer than two photographs have a pose in the opened model".to_owned());
    }
    let mut watch = |status: Status| {
        monitor(Progress::Share(
            status.fraction,
            "finding points by known poses",
        ))
    };
    let found =
        triangulate_tracks(input, &cam_from_world, options, &mut watch).map_err(sentence)?;
    if found.points.is_empty() {
        return Err(
            "no match fits the poses: they may be those of other photographs, or world from camera"
                .to_owned(),
        );
    }
    let reason = |pose: &Option<Pose>| match pose {
        Some(_) => None,
        None => Some(UnregisteredReason::NoKnownPose),
    };
    Ok(Reconstructed {
        mean_error_px: vec![found.mean_reprojection_px(&input.images)],
        before_correction_px: vec![None],
        determines_focal: vec![true],
        components: vec![Component::from_core(&found)],
        costs: Vec::new(),
        reasons: poses.iter().map(reason).collect(),
    })
}
