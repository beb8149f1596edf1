//! Calibrated rectification: warps both images as if the cameras were parallel.

mod checks;
mod cover;
mod outline;
mod parallel_rotations;
mod q_matrix;
mod rect;
mod rectification;
mod rectify_calibrated;
mod slanted;
#[cfg(test)]
mod tests;

pub(crate) use outline::{farthest_ray, flat, outline as border_outline};
pub use q_matrix::q_from_rig;
pub use rect::PixelRect;
pub use rectification::Rectification;
pub use rectify_calibrated::{RectifyOptions, rectify_calibrated};
