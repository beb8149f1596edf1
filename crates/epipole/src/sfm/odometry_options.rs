//! Options of visual odometry.

use super::options::SfmOptions;
use crate::robust::RansacOptions;
use derive_setters::Setters;

/// Options of visual odometry.
#[derive(Debug, Clone, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct OdometryOptions {
    /// Thresholds, in pixels and degrees. Frames are closer together than images of a collection,
    /// so smaller angles are accepted: 0.3 degrees for points, 1 for the initial pair.
    pub sfm: SfmOptions,
    /// Number of keyframes that are refined together; older ones are fixed. 8.
    pub window: usize,
    /// Refine everything at the end, repeatedly until a refined focal length converges. True.
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
