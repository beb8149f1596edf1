//! Odometry.

use super::photos::GivenMatches;
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Indices, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::{Camera, RigidTransform};
use epipole::sfm::{
    self, OdometryOptions, OdometryResult, PairMatches, Reconstruction, SfmImage, SfmInput,
};

structs! {
    /// Path of a camera.
    struct Path as OdometryResult {
        /// Pose of the camera of each frame in the world; null if it was lost. The first frame
        /// found is the origin.
        world_from_cam: Vec<Option<RigidTransform>>,
        /// Frames that provide points.
        keyframes: Indices,
        /// Frames that could not be registered.
        lost: Indices,
        /// Cameras and points; for a rig, the left cameras followed by the right ones.
        reconstruction: Reconstruction,
    }
}

impl Output for OdometryResult {
    fn typescript(types: &mut Types) -> String {
        Path::typescript(types)
    }

    fn into_value(self) -> Value {
        let path = Path {
            world_from_cam: self.world_from_cam,
            keyframes: Indices(self.keyframes),
            lost: Indices(self.lost),
            reconstruction: self.reconstruction,
        };
        path.into_value()
    }
}

functions! {
    /// Path of a single camera, up to scale, from frames in order of time and matches between
    /// frames that are close. `cameras` has one camera for each frame, or one for all.
    fn monocular_odometry(
        images: Vec<SfmImage>, cameras: Vec<Camera>, pairs: Vec<PairMatches>,
        options: Options<OdometryOptions>; monitor
    ) -> OdometryResult {
        sfm::monocular_odometry(&SfmInput { images, cameras, pairs }, &options.0, monitor)?
    }

    /// Path of a rig, in the unit of its baseline. `images`, `cameras` and `pairs` are those of the
    /// left camera, `right` the same frames of the right camera, and `leftRight` has the matches
    /// between the two images of each frame.
    fn stereo_odometry(
        images: Vec<SfmImage>, cameras: Vec<Camera>, pairs: Vec<PairMatches>,
        right: Vec<SfmImage>, left_right: Vec<GivenMatches>, right_from_left: RigidTransform,
        right_camera: Camera, options: Options<OdometryOptions>; monitor
    ) -> OdometryResult {
        let left = SfmInput { images, cameras, pairs };
        let left_right: Vec<_> = left_right.into_iter().map(|matches| matches.0).collect();
        sfm::stereo_odometry(
            &left, &right, &left_right, &right_from_left, &right_camera, &options.0, monitor,
        )?
    }
}
