//! Depth from two photographs taken side by side.

mod depth;

pub use depth::{DepthInterval, depth_from_disparity, depth_interval};
//! Dense stereo: rectification, block matching, semi-global matching, depth.

mod block_matching;
mod clean;
mod disparity_image;
mod matching_cost;
mod paths;
mod prefilter;
mod search;
mod semi_global;
mod simd;
mod winner;

pub use block_matching::StereoBm;
pub use clean::remove_speckles;
pub use disparity_image::DisparityImage;
pub use matching_cost::StereoCost;
pub use prefilter::StereoPrefilter;
pub use search::Progress;
pub use semi_global::{StereoPaths, StereoSgm};
