//! The formats of trajectories.

/// Format of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum TrajectoryFormat {
    /// TUM RGB-D: `t tx ty tz qx qy qz qw`, seconds.
    Tum,
    /// KITTI odometry: the twelve numbers of a 3 × 4 matrix, without times.
    Kitti,
    /// EuRoC MAV: CSV of `t, px, py, pz, qw, qx, qy, qz`, nanoseconds.
    EuRoC,
}

impl TrajectoryFormat {
    /// Returns the name of the data set of the format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tum => "TUM",
            Self::Kitti => "KITTI",
            Self::EuRoC => "EuRoC",
        }
    }
}
