//! Structure from motion: from many photographs to cameras and points.
//!
//! * [`adjust_bundle`] refines cameras, their lenses and points together, with known positions such
//!   as those of satellite navigation ([`local_from_geodetic`](crate::math::local_from_geodetic))
//!   if there are any; [`BalProblem`] is the published text format for such problems, and
//!   [`adjust_bal`] solves it.
//! * [`align_points`] brings two reconstructions into one frame;
//!   [`absolute_trajectory_error`] and [`relative_pose_error`] compare them.
//! * [`PoseGraph`] spreads the error of closed loops over a trajectory; [`close_loops`] does so for
//!   the path of a camera whose scale drifts. [`PoseGraph::initialize`] needs no start, and
//!   [`average_rotations`] is its first step by itself.
//! * [`two_view_reconstruction`] leads from the matches of two views and the motion between them to
//!   points.
//! * [`build_tracks`], [`reconstruct`] and [`reconstruct_photos`] lead from matches, or from
//!   photographs, to cameras and points: a [`Reconstruction`].
//! * [`triangulate_tracks`] gives the points where the poses are known.
//! * [`Reconstruction::refine_lenses`] corrects lenses that are not as they were given, and
//!   [`Reconstruction::determines_focal`] tells whether the photographs can.
//! * [`Reconstruction::localize`] gives the pose of another photo.
//! * [`monocular_odometry`] and [`stereo_odometry`] follow a camera frame after frame.

mod alignment;
mod bal;
mod builder;
mod bundle;
mod incremental;
mod keyframes;
mod known_poses;
mod localize;
mod loop_closure;
mod odometry;
mod odometry_options;
mod odometry_result;
mod options;
mod photos;
mod pose_graph;
mod reconstruction;
mod self_calibration;
mod tracks;
mod triangulate_track;
mod two_view_reconstruction;
mod two_view_start;
mod unregistered;
mod views;

pub use alignment::{
    AlignmentKind, ErrorStatistics, RelativePoseError, absolute_trajectory_error, align_points,
    relative_pose_error,
};
pub use bal::{BalCamera, BalProblem, adjust_bal};
pub use bundle::{
    Bundle, BundleObservation, BundleOptions, Gauge, PositionPrior, Sensor, adjust_bundle,
};
pub use incremental::{IncrementalReconstruction, SfmResult, SfmStep, reconstruct};
pub use known_poses::triangulate_tracks;
pub use localize::{Localization, LocalizeOptions};
pub use loop_closure::{
    ClosedPath, LoopClosure, LoopMotion, close_loops, estimate_similarity_of_points,
};
pub use odometry::{Odometry, monocular_odometry, stereo_odometry};
pub use odometry_options::OdometryOptions;
pub use odometry_result::OdometryResult;
pub use options::{SfmInput, SfmOptions};
pub use photos::{
    Photo, PhotoFeatures, PhotoOptions, match_features, match_photos, match_rectified,
    photo_features, reconstruct_photos,
};
pub use pose_graph::{
    Edge, Graph, GraphPose, PoseGraph, PoseGraphReport, PosePrior, RelativeRotation,
    average_rotations,
};
pub use reconstruction::{Reconstruction, ScenePoint, SfmImage};
pub use tracks::{PairMatches, TrackElement, build_tracks};
pub use two_view_reconstruction::{
    TwoViewReconstruction, TwoViewReconstructionOptions, two_view_reconstruction,
};
pub use two_view_start::{VerifiedPair, verify_matches};
pub use unregistered::{WhyUnregistered, why_unregistered};
