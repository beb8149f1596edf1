//! Result of visual odometry.

use super::builder::Builder;
use super::reconstruction::Reconstruction;
use crate::camera::RigidTransform;

/// Path of the camera.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OdometryResult {
    /// `world_from_cam` of each frame, `None` where tracking was lost. The first registered frame
    /// is the origin. For a single camera the unit of length is arbitrary.
    pub world_from_cam: Vec<Option<RigidTransform>>,
    /// Frames that provided points: far enough from the previous one, by the triangulation angle of
    /// their points, or with much new content.
    pub keyframes: Vec<usize>,
    /// Frames that could not be registered.
    pub lost: Vec<usize>,
    /// Cameras and points; for a stereo rig the left cameras, then the right ones.
    pub reconstruction: Reconstruction,
    /// Whether every frame was tried; false for [`Odometry::finish`](super::Odometry::finish)
    /// before the last step.
    pub is_complete: bool,
}

/// Returns the path in the frame of its first camera. Keyframes are left empty.
pub(super) fn result_of(builder: &Builder, num_frames: usize) -> OdometryResult {
    let mut reconstruction = builder.so_far();
    let origin = reconstruction.cameras[..num_frames]
        .iter()
        .flatten()
        .next()
        .map_or_else(RigidTransform::identity, |camera| camera.cam_from_world);
    // The first frame is the origin of the world.
    let world_from_old = origin;
    for camera in reconstruction.cameras.iter_mut().flatten() {
        camera.cam_from_world *= world_from_old.inverse();
    }
    // Exact, since rounding would leave a trace of the old pose.
    if let Some(first) = reconstruction.cameras[..num_frames]
        .iter_mut()
        .flatten()
        .next()
    {
        first.cam_from_world = RigidTransform::identity();
    }
    for point in &mut reconstruction.points {
        point.position = world_from_old * point.position;
    }
    let world_from_cam: Vec<Option<RigidTransform>> = reconstruction.cameras[..num_frames]
        .iter()
        .map(|camera| camera.map(|camera| camera.cam_from_world.inverse()))
        .collect();
    OdometryResult {
        lost: (0..num_frames)
            .filter(|&f| world_from_cam[f].is_none())
            .collect(),
        world_from_cam,
        reconstruction,
        ..OdometryResult::default()
    }
}
