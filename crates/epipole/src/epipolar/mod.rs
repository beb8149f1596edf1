//! The geometry of two views: fundamental and essential matrices.
//!
//! Everywhere `x2ᵀ F x1 = 0` for matching pixels `x1` of image 1 and `x2` of image 2, so
//! `line2 = F x1` is a line of image 2. F and E have unit Frobenius norm.

mod distance;
mod epipoles;
mod from_cameras;
mod lines;

pub use distance::{sampson_px, sampson_sq, symmetric_epipolar_px, symmetric_epipolar_sq};
pub use epipoles::{Epipole, epipoles};
pub use from_cameras::{
    essential_from_fundamental, essential_from_motion, fundamental_from_cameras,
    fundamental_from_essential,
};
pub use lines::{epipolar_line1, epipolar_line2};
