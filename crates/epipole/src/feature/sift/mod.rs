//! SIFT: keypoints invariant to scale and rotation, with descriptors robust to illumination.

mod describe;
mod descriptor;
mod detect;
mod extrema;
mod layers;
mod options;
mod orientation;
mod scale_space;
#[cfg(test)]
mod tests;

pub use describe::{describe_sift, sift_directions, sift_orientation_histograms};
pub use detect::detect_sift;
pub use layers::{ScaleOctave, ScaleSpace, scale_space};
pub use options::{SiftNormalization, SiftOptions};
