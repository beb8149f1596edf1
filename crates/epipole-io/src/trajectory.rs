//! Trajectories: poses of one camera over time.
//!
//! [`read_trajectory`] recognizes the format by its content; [`write_trajectory`] writes it.

mod columns;
mod euroc;
mod format;
mod frames;
mod kitti;
mod path;
mod read;
mod stamp;
mod timed;
mod tum;
mod words;
mod write;

pub use format::TrajectoryFormat;
pub use frames::frame_stamps_ns;
pub use path::Trajectory;
pub use read::{is_trajectory, read_trajectory};
pub use write::write_trajectory;
