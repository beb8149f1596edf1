//! Cameras: projection of world points to pixels.
//!
//! A [`Camera`] is image size, intrinsics and lens; a [`PosedCamera`] is a camera with a rigid
//! transform. Camera frame: x right, y down, z forward.

mod calibrated;
mod distortion;
mod division;
mod fisheye;
mod intrinsics;
mod lens;
mod lens_from;
mod lens_kind;
pub(crate) mod moving_pose;
mod observation;
mod pixel_centers;
mod plausible_focals;
mod posed;
mod rational;
mod rigid;
mod unbend;

pub use calibrated::Camera;
pub use distortion::Distortion;
pub use division::Division;
pub use fisheye::Fisheye;
pub use intrinsics::Intrinsics;
pub use lens::Lens;
pub(crate) use lens::MAX_COEFFICIENTS;
pub use lens_kind::LensKind;
pub use observation::Observation;
pub use pixel_centers::{pixel_from_colmap, pixel_to_colmap};
pub(crate) use plausible_focals::plausible_focals_px;
pub use posed::PosedCamera;
pub use rational::RationalDistortion;
pub use rigid::{RigidTransform, cross_matrix, look_at, relative_motion};
