//! The result of a calibration for one view.

use crate::camera::RigidTransform;

/// What was found out about one view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CalibratedView {
    /// Where the board was, meters.
    pub cam_from_board: RigidTransform,
    /// Root mean square of its reprojection errors, pixels.
    pub rms_px: f64,
    /// Marks seen.
    pub num_marks: usize,
}
