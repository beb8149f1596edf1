//! Cameras: what turns a point in the world into a pixel.
//!
//! A camera is intrinsics (how rays become pixels) and a rigid transform (where it stands).
//! Camera frame: x right, y down, z forward.

mod distortion;
mod division;
mod fisheye;
mod intrinsics;
mod lens;
mod lens_model;
pub(crate) mod moving_pose;
mod pixel_centers;
mod plausible_focals;
mod rational;
mod rigid;
mod seen_ray;
mod unbend;
mod view;

pub use distortion::Distortion;
pub use division::Division;
pub use fisheye::Fisheye;
pub use intrinsics::Intrinsics;
pub(crate) use lens::MAX_COEFFICIENTS;
pub use lens::{Lens, LensKind};
pub use lens_model::LensModel;
pub use pixel_centers::{pixel_from_colmap, pixel_to_colmap};
pub(crate) use plausible_focals::plausible_focals_px;
pub use rational::RationalDistortion;
pub use rigid::{RigidTransform, cross_matrix, look_at, relative_motion};
pub use seen_ray::SeenRay;
pub use view::Camera;
