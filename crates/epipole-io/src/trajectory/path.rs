//! A trajectory.

use epipole::camera::RigidTransform;

/// Poses over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory {
    /// Time of each pose, nanoseconds, not descending; `None` for a format without times. Whole
    /// numbers, because seconds since 1970 with nanoseconds have more digits than an `f64`.
    pub stamps_ns: Option<Vec<i64>>,
    /// `x_in_world = world_from_cam * x_in_cam`. The frame is that of the file: a camera's, or the
    /// body's in the ground truth of EuRoC.
    pub world_from_cam: Vec<RigidTransform>,
    /// Sentences on assumptions of the reader.
    pub notes: Vec<String>,
}
