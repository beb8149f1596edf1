//! The items that most programs need, in one line: `use epipole::prelude::*;`.
//!
//! ```
//! # fn main() -> Result<(), epipole::Error> {
//! use epipole::prelude::*;
//! let k = Intrinsics::centered(600.0, 640, 480)?;
//! assert_eq!(k.project(&Point3::new(0.0, 0.0, 2.0))?, Point2::new(319.5, 239.5));
//! # Ok(()) }
//! ```

pub use crate::Error;
pub use crate::absolute_pose::estimate_absolute_pose;
pub use crate::calibration::{
    Board, CalibrationOptions, Pattern, calibrate, calibrate_rig, find_board,
};
pub use crate::camera::{
    Camera, Distortion, Intrinsics, Lens, LensKind, PosedCamera, RigidTransform,
};
pub use crate::epipolar::{
    decompose_essential, estimate_essential, estimate_fundamental, estimate_relative_pose,
    sampson_px,
};
pub use crate::feature::{
    FeatureKind, FeatureOptions, Keypoint, MatchOptions, SiftOptions, detect_features, detect_sift,
    match_descriptors, refine_corners,
};
pub use crate::homography::{estimate_homography, transfer};
pub use crate::imaging::{
    GrayImage32, WarpOptions, gray_to_f32, rgb_to_gray, rgb_to_gray_f32, warp_perspective,
};
pub use crate::robust::{Estimator, RansacOptions, RansacReport, ransac};
pub use crate::sfm::{PhotoOptions, SfmOptions, reconstruct_photos};
pub use crate::stereo::{RectifyOptions, StereoSgm, rectify_calibrated};
pub use crate::triangulation::{triangulate_dlt, triangulate_nview};
pub use crate::two_view::{TwoViewOptions, estimate_two_view, estimate_two_view_calibrated};
pub use image::{GrayImage, RgbImage};
pub use nalgebra::{Matrix3, Point2, Point3, Vector2, Vector3};
