//! Cameras: what turns a point in the world into a pixel.
//!
//! A camera is intrinsics (how rays become pixels) and a rigid transform (where it stands).
//! Camera frame: x right, y down, z forward.

mod distortion;
mod intrinsics;
mod pixel_centers;
mod rigid;
mod view;

pub use distortion::Distortion;
pub use intrinsics::Intrinsics;
pub use pixel_centers::{pixel_from_colmap, pixel_to_colmap};
pub use rigid::{RigidTransform, cross_matrix, look_at, relative_motion};
pub use view::Camera;
