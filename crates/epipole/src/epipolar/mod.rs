//! Two-view geometry: fundamental and essential matrices.
//!
//! By convention `x2ᵀ F x1 = 0` for matching pixels `x1` of image 1 and `x2` of image 2, so
//! `line2 = F x1` is a line of image 2. F and E have unit Frobenius norm.

pub(crate) mod coordinates;
mod distance;
mod eight_point;
mod eight_rays;
mod epipoles;
mod essential;
mod essential_estimator;
mod estimate_essential;
mod estimate_fundamental;
mod estimate_pose_and_focal;
mod estimate_with_gravity;
mod five_point;
mod focal_lengths;
mod focal_profile;
mod from_cameras;
mod in_front;
pub(crate) mod judge;
mod lens_matches;
mod lines;
mod normalize;
mod observed_matches;
mod other_motion;
mod pinhole_matches;
mod plane_recovery;
mod refine;
mod refine_focal;
mod refine_pose;
mod refine_relative_pose;
mod relative_pose;
mod sampson;
mod seven_point;
mod sight;
mod six_point;
mod three_point;

pub(crate) use distance::sampson_sq;
pub use distance::{sampson_px, symmetric_epipolar_px};
pub use eight_point::{
    EightPoint, enforce_rank2, fundamental_8point, fundamental_8point_explained,
    fundamental_8point_unnormalized,
};
pub use eight_rays::essential_8point;
pub use epipoles::{Epipole, epipoles};
pub(crate) use essential::signed_depths;
pub use essential::{SelectedPose, decompose_essential, project_to_essential, select_pose};
pub use essential_estimator::EssentialEstimator;
pub use estimate_essential::{estimate_essential, estimate_relative_pose};
pub use estimate_fundamental::{FundamentalEstimator, estimate_fundamental};
pub use estimate_pose_and_focal::{PoseWithFocal, estimate_relative_pose_and_focal};
pub use estimate_with_gravity::{GravityEstimator, estimate_relative_pose_with_gravity};
pub use five_point::essential_5point;
pub use focal_lengths::focal_lengths_from_fundamental;
pub(crate) use from_cameras::have_same_center;
pub use from_cameras::{
    essential_from_fundamental, essential_from_motion, fundamental_from_cameras,
    fundamental_from_essential,
};
pub use lens_matches::tangent_sampson_px;
pub use lines::{epipolar_line1, epipolar_line2};
pub use normalize::Normalization;
pub(crate) use observed_matches::ObservedMatches;
pub use refine::refine_fundamental;
pub(crate) use refine::scaled as scaled_loss;
pub use refine_relative_pose::refine_relative_pose;
pub use relative_pose::RelativePose;
pub use seven_point::{epipolar_row, fundamental_7point};
pub use six_point::{EssentialWithFocal, essential_6point};
pub use three_point::relative_pose_3point;
