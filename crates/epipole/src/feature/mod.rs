//! Features: corners, scale-invariant keypoints, their descriptors, matching and tracking.
//!
//! Detectors reject images with NaN or infinite pixels; flat or tiny images have no features,
//! without an error. Lists have a deterministic order, strongest first, independent of the number
//! of threads. Gray values are expected in [0, 1].

mod corners;
mod descriptors;
mod extract;
mod good_features;
mod keypoint;
mod matching;
mod nms;
mod options;
mod orb;
mod patch;
mod refine;
mod short_tensor;
mod sift;
mod structure_tensor;
mod track;
mod vlad;
mod window_tensor;

pub use corners::{harris_response, min_eigenvalue_response};
pub use descriptors::{Descriptors, Features};
pub use extract::{detect_features, photo_to_gray};
pub use good_features::{CornerMeasure, GoodFeaturesOptions, Grid, good_features_to_track};
pub use keypoint::Keypoint;
pub use matching::{Match, MatchOptions, Neighbors, match_descriptors, nearest_few, nearest_two};
pub use nms::non_maximum_suppression;
pub use options::{FeatureKind, FeatureOptions};
pub use orb::{OrbOptions, detect_orb};
pub use patch::describe_patches;
pub use refine::{RefineOptions, refine_corners};
pub use sift::{
    ScaleOctave, ScaleSpace, SiftNormalization, SiftOptions, describe_sift, detect_sift,
    scale_space, sift_directions, sift_orientation_histograms,
};
pub use structure_tensor::{
    Scaling, StructureTensor, StructureTensorOptions, Window, structure_tensor,
};
pub use track::{Track, TrackOptions, track_lucas_kanade};
pub(crate) use vlad::global_descriptors;
pub use window_tensor::{ShiftSurface, WindowTensor, shift_surface};
