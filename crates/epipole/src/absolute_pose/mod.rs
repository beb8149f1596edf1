//! Where a camera stands, from points whose places are known.

mod dlt;
mod estimate;
mod p3p;
mod refine;
mod sides;

pub use dlt::pose_dlt;
pub use estimate::{AbsolutePoseEstimator, estimate_absolute_pose};
pub use p3p::pose_p3p;
pub use refine::{refine_absolute_pose, reprojection_error_px};
