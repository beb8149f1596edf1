//! Pose of a camera from known points.

mod dlt;
mod estimate;
mod estimate_focal;
mod fit;
mod flipped;
mod local_pose;
mod p3p;
mod p4pf;
mod point_errors;
mod pose_with_focal;
mod refine;
mod refine_focal;
mod sides;

pub use dlt::pose_dlt;
pub use estimate::{AbsolutePoseEstimator, estimate_absolute_pose};
pub use estimate_focal::estimate_absolute_pose_and_focal;
pub use fit::fit_absolute_pose;
pub use flipped::find_flipped_pose;
pub use p3p::pose_p3p;
pub use p4pf::pose_p4pf;
pub use pose_with_focal::AbsolutePoseWithFocal;
pub use refine::{refine_absolute_pose, reprojection_error_px};
