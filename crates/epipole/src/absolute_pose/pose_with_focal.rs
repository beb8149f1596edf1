//! Camera pose with a focal length.

use crate::camera::RigidTransform;
use nalgebra::{Matrix3, Vector3};

/// Pose and focal length of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AbsolutePoseWithFocal {
    /// The pose.
    pub cam_from_world: RigidTransform,
    /// Focal length, pixels.
    pub focal_px: f64,
    /// Standard deviation of the focal length, pixels, from the errors of the inliers and their
    /// dependence on it. `None` for a candidate that is not yet scored, and if the focal length has
    /// no effect.
    pub focal_std_px: Option<f64>,
}

/// R, t and the focal length in pixels.
pub(super) type PoseFocal = (Matrix3<f64>, Vector3<f64>, f64);
