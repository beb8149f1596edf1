//! Structure from motion: cameras and points from many images.
//!
//! * [`adjust_bundle`] refines cameras, lenses and points together, with priors for known positions
//!   such as from GPS ([`local_from_geodetic`](crate::math::local_from_geodetic)); [`BalProblem`]
//!   is the published benchmark format, solved by [`adjust_bal`].
//! * [`align_points`] aligns two reconstructions; [`absolute_trajectory_error`] and
//!   [`relative_pose_error`] compare trajectories.
//! * [`PoseGraph`] spreads the error of closed loops over a trajectory; [`close_loops`] does so for
//!   a path with drifting scale. [`PoseGraph::initialize`] needs no initial values;
//!   [`average_rotations`] is its first step alone.
//! * [`two_view_reconstruction`] triangulates the matches of two views with known motion.
//! * [`build_tracks`], [`reconstruct`] and [`reconstruct_photos`] compute a [`Reconstruction`],
//!   cameras and points, from matches or images.
//! * [`triangulate_tracks`] computes points for known poses.
//! * [`Reconstruction::refine_lenses`] corrects wrong lens parameters, and
//!   [`Reconstruction::determines_focal`] checks whether the images determine them.
//! * [`Reconstruction::localize`] computes the pose of another image.
//! * [`monocular_odometry`] and [`stereo_odometry`] track a camera frame by frame.

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
mod pair_selection;
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
