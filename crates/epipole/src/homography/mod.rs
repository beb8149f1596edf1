//! Homographies: maps between two images of a plane, or of any scene if the camera only rotated.
//!
//! `x2 ∝ H x1` for matching pixels. H has unit Frobenius norm.

mod decompose;
mod estimate;
mod estimate_calibrated;
mod four_point;
mod linear;
mod refine;
mod refine_both;
mod sampson;
mod sums;
mod sums_both;

pub use decompose::{PlaneMotion, decompose_homography, homography_from_motion};
pub use estimate::{HomographyEstimator, estimate_homography};
pub use estimate_calibrated::estimate_homography_calibrated;
pub use four_point::homography_4point;
pub(crate) use linear::transfer_error_sq;
pub use linear::{fit_homography, transfer, transfer_error_px};
pub use refine::refine_homography;
pub use sampson::homography_sampson_px;
pub(crate) use sampson::homography_sampson_sq;
