//! Calibration result of one view.

use crate::camera::RigidTransform;

/// Calibration result of one view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CalibratedView {
    /// Pose of the board, meters.
    pub cam_from_board: RigidTransform,
    /// Root mean square of its reprojection errors, pixels.
    pub rms_px: f64,
    /// Number of visible marks.
    pub num_marks: usize,
}
