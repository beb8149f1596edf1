//! A camera pose together with a focal length.

use crate::camera::RigidTransform;
use nalgebra::{Matrix3, Vector3};

/// Pose and focal length of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AbsolutePoseWithFocal {
    /// The pose.
    pub cam_from_world: RigidTransform,
    /// The focal length, pixels.
    pub focal_px: f64,
    /// Its standard deviation, pixels, from the errors of the inliers and how they depend on it.
    /// `None` for a candidate that is yet to be judged, and where the focal length makes no
    /// difference at all.
    pub focal_std_px: Option<f64>,
}

/// R, t and the focal length in pixels.
pub(super) type PoseFocal = (Matrix3<f64>, Vector3<f64>, f64);
