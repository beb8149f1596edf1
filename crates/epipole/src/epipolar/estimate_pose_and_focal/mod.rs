//! Robust estimation of relative pose and focal length from matches.

mod estimate;
mod focal_estimator;
mod pose_with_focal;

pub use estimate::estimate_relative_pose_and_focal;
pub(super) use focal_estimator::FocalEstimator;
pub use pose_with_focal::PoseWithFocal;
