//! Multi-view geometry: from images to a three-dimensional reconstruction.
//!
//! Each module may use the modules listed before it:
//!
//! | module | content |
//! |---|---|
//! | [`progress`] | the monitor of long computations: stage, share, cancellation |
//! | [`math`] | lines, null vectors, polynomial roots, seeded random numbers |
//! | [`optim`] | the Levenberg–Marquardt loop, robust losses |
//! | [`imaging`] | gray images: filters, gradients, pyramids, warps |
//! | [`camera`] | pinhole intrinsics, rigid transforms, projection |
//! | [`robust`] | the RANSAC engine; lines and similarities |
//! | [`feature`] | corners, SIFT, binary features, matching, tracking |
//! | [`epipolar`] | fundamental and essential matrices, epipolar lines and distances |
//! | [`homography`] | homographies: four points, least squares, decomposition |
//! | [`absolute_pose`] | the pose of a camera from known points |
//! | [`triangulation`] | points from their images in two or more views |
//! | [`two_view`] | two views of any scene: E, F or H |
//! | [`stereo`] | rectification, dense disparity, depth, point clouds |
//! | [`calibration`] | boards in images, intrinsics and distortion from them, rigs, undistortion |
//! | [`sfm`] | bundle adjustment, pose graphs, structure from motion, odometry |
//! | [`mvs`] | dense depth maps of many views, fused to one point cloud |
//! | [`stitch`] | panoramas: rotations of photos, projection, blending |
//! | `synthetic` | seeded worlds with ground truth: points, cameras, noise, outliers (feature `synthetic`) |
//!
//! # Conventions
//!
//! * Image coordinates are (u, v) = (column, row): u to the right, v down, pixel centers at
//!   integers.
//! * Camera frame: x right, y down, z forward. `x_in_cam = cam_from_world * x_in_world`.
//! * Disparity is `u_left − u_right ≥ 0`.
//! * A random choice takes a `u64` seed and gives the same result on every platform.
//! * Geometry is `f64`, images are `f32`.

mod error;

pub mod absolute_pose;
pub mod calibration;
pub mod camera;
pub mod epipolar;
pub mod feature;
pub mod homography;
pub mod imaging;
pub mod math;
pub mod mvs;
pub mod optim;
pub mod prelude;
pub mod progress;
pub mod robust;
pub mod sfm;
pub mod stereo;
pub mod stitch;
#[cfg(any(test, feature = "synthetic"))]
pub mod synthetic;
pub mod triangulation;
pub mod two_view;

/// Image types of the functions' arguments and results.
pub use image;
/// Point and matrix types of the functions' arguments and results.
pub use nalgebra;

pub use absolute_pose::estimate_absolute_pose;
/// List returned by minimal solvers: zero or more models, on the stack.
pub use arrayvec::ArrayVec;
pub use epipolar::{
    decompose_essential, estimate_essential, estimate_fundamental, estimate_relative_pose,
};
pub use error::Error;
pub use homography::estimate_homography;
pub use two_view::{estimate_two_view, estimate_two_view_calibrated};

/// Result of an operation that can fail with an [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// Examples of the package's README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
