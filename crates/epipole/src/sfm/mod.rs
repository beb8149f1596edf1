//! Structure from motion: from many photographs to cameras and points.
//!
//! * [`adjust_bundle`] refines cameras and points together; [`BalProblem`] is the published text
//!   format for such problems, and [`adjust_bal`] solves it.
//! * [`align_points`] brings two reconstructions into one frame;
//!   [`absolute_trajectory_error`] and [`relative_pose_error`] compare them.
//! * [`PoseGraph`] spreads the error of closed loops over a trajectory.

mod alignment;
mod bal;
mod bundle;
mod export;
mod g2o;
mod incremental;
mod photos;
mod pose_graph;
mod reconstruction;
mod resection;
mod tokens;
mod tracks;
mod triangulate_track;
mod two_view_start;
mod union_find;

pub use alignment::{
    AlignmentKind, ErrorStatistics, RelativePoseError, absolute_trajectory_error, align_points,
    relative_pose_error,
};
pub use bal::{BalCamera, BalProblem, adjust_bal};
pub use bundle::{Bundle, BundleOptions, Gauge, Observation, RadialDistortion, adjust_bundle};
pub use export::ColmapModel;
pub use incremental::{SfmInput, SfmObserver, SfmOptions, SfmProgress, SfmResult, reconstruct};
pub use photos::{Photo, PhotoOptions, match_photos, reconstruct_photos};
pub use pose_graph::{Edge, Graph, GraphPose, PoseGraph, PoseGraphReport};
pub use reconstruction::{Reconstruction, ScenePoint, SfmImage};
pub use tracks::{PairMatches, TrackElement, build_tracks};
