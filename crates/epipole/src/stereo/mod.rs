//! Stereo: rectification, dense disparity, depth, point clouds.

mod block_matching;
mod clean;
mod depth;
mod disparity_image;
mod fill;
mod filter;
mod matching_cost;
mod paths;
mod pixel_costs;
mod pixel_map;
mod point_cloud;
mod prefilter;
mod rectified_pair;
mod rectify;
mod rectify_uncalibrated;
mod search;
mod semi_global;
mod winner;
mod work;

pub use block_matching::StereoBm;
pub use clean::remove_speckles;
pub use depth::{DepthInterval, depth_from_disparity, depth_interval};
pub use disparity_image::DisparityImage;
pub use fill::fill_gaps;
pub use filter::DisparityFilter;
pub use matching_cost::StereoCost;
pub use pixel_costs::{PATH_STEPS, PathCosts, PixelCosts};
pub use pixel_map::PixelMap;
pub use point_cloud::{PointCloud, depth_image, point_cloud};
pub use prefilter::StereoPrefilter;
pub use rectified_pair::RectifiedPair;
pub use rectify::{PixelRect, Rectification, RectifyOptions, q_from_rig, rectify_calibrated};
pub(crate) use rectify::{border_outline, farthest_ray, flat};
pub use rectify_uncalibrated::{UncalibratedRectification, rectify_uncalibrated};
pub use semi_global::{StereoPaths, StereoSgm};
