//! Choices of visual odometry.

use super::options::SfmOptions;
use crate::robust::RansacOptions;
use derive_setters::Setters;

/// Options of odometry.
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct OdometryOptions {
    /// Thresholds, in pixels and degrees. Frames are nearer to each other than photographs, so
    /// that points are accepted under smaller angles: 0.3 degrees, and the start wants 1.
    pub sfm: SfmOptions,
    /// Keyframes that are refined together; older ones stay. 8.
    pub window: usize,
    /// Refine everything once more at the end, and again while a focal length that is refined has
    /// not arrived. True.
    pub final_adjustment: bool,
}

impl Default for OdometryOptions {
    fn default() -> Self {
        Self {
            sfm: SfmOptions {
                ransac: RansacOptions::default().within(1.5),
                max_registration_error_px: 3.0,
                max_reprojection_error_px: 2.0,
                min_angle_deg: 0.3,
                min_start_angle_deg: 1.0,
                ..SfmOptions::default()
            },
            window: 8,
            final_adjustment: true,
        }
    }
}
