//! Two photographs taken side by side: dense disparity and depth.

mod block_matching;
mod clean;
mod depth;
mod disparity_image;
mod fill;
mod matching_cost;
mod paths;
mod prefilter;
mod search;
mod semi_global;
mod simd;
mod winner;
mod work;

pub use block_matching::StereoBm;
pub use clean::remove_speckles;
pub use depth::{DepthInterval, depth_from_disparity, depth_interval};
pub use disparity_image::DisparityImage;
pub use fill::fill_gaps;
pub use matching_cost::StereoCost;
pub use prefilter::StereoPrefilter;
pub use semi_global::{StereoPaths, StereoSgm};
pub use work::Progress;
