//! Depth from two photographs taken side by side.

mod depth;

pub use depth::{DepthInterval, depth_from_disparity, depth_interval};
