//! Rectification of a calibrated rig.

use super::checks::{check, common_size};
use super::cover::{LARGEST_CROP, around_principal_points, around_visible};
use super::outline::rotated_outline;
use super::parallel_rotations::parallel_rotations;
use super::q_matrix::q_matrix;
use super::rect::PixelRect;
use super::rectification::Rectification;
use crate::Result;
use crate::camera::{Camera, Intrinsics, RigidTransform};
use derive_setters::Setters;
use nalgebra::Vector2;

/// Options of [`rectify_calibrated`].
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct RectifyOptions {
    /// Zoom. 0: zoomed in until the camera covers every pixel of the results. 1: zoomed out until
    /// every pixel of the images is visible. Values between interpolate.
    pub alpha: f64,
    /// Size of the results, pixels; `None` for that of the images.
    pub size: Option<(u32, u32)>,
    /// Whether both results have the same principal point, so that points at infinity have
    /// disparity 0. Otherwise each is centered on the view of its own camera.
    pub zero_disparity_at_infinity: bool,
}

impl Default for RectifyOptions {
    /// Returns options for only valid pixels, the images' size, and disparity 0 at infinity.
    fn default() -> Self {
        Self {
            alpha: 0.0,
            size: None,
            zero_disparity_at_infinity: true,
        }
    }
}

/// Rectifies a calibrated rig.
///
/// Each camera is rotated by half of the rotation between them, so both images are distorted
/// equally; then both are rotated, by the smallest angle, until the baseline is along the rows (or
/// the columns, if the second camera is more above or below than beside). The smallest angle never
/// turns an image upside down: a second camera on the left gives negative disparities instead.
///
/// * `cameras`: cameras of the first (left) and second (right) image, of the same size
/// * `cam2_from_cam1`: `x2 = R x1 + t`, meters
///
/// # Errors
/// [`Error::Degenerate`](crate::Error::Degenerate) if the cameras are at the same place; if the
/// baseline is more than 60° off the image plane halfway between the cameras, in any direction; if
/// a pixel of an image looks along the baseline, except for a fisheye, since no common image plane
/// then sees the whole image (with a baseline θ off that plane, images must stay within 90° − θ of
/// their middle); or if a lens model folds less than halfway to the image's border. Content beyond
/// a fold closer to the border is not shown, nor is content of a fisheye farther than 80° from the
/// results' middle. [`Error::SizeMismatch`](crate::Error::SizeMismatch) for images that differ in
/// size, [`Error::OutOfRange`](crate::Error::OutOfRange) for an alpha outside 0 to 1 or an empty
/// size.
///
/// Source: Bouguet's method as described in Bradski & Kaehler 2008, "Learning OpenCV", ch. 12;
/// Fusiello, Trucco & Verri 2000, "A compact algorithm for rectification of stereo pairs".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::{Camera, Intrinsics, RigidTransform};
/// use epipole::stereo::{RectifyOptions, rectify_calibrated};
/// // Two ideal parallel cameras, 0.1 m apart: nothing needs to change.
/// let camera = Camera::pinhole(Intrinsics::centered(500.0, 640, 480)?, 640, 480);
/// let cam2_from_cam1 = RigidTransform::translation(-0.1, 0.0, 0.0);
/// let rig = rectify_calibrated(&[camera, camera], &cam2_from_cam1, &RectifyOptions::default())?;
/// assert!((rig.intrinsics[0].fu_px() - 500.0).abs() < 1e-6);
/// // A disparity of 25 px in the middle is 500 × 0.1 / 25 = 2 m away.
/// let x = rig.q * nalgebra::Vector4::new(319.5, 239.5, 25.0, 1.0);
/// assert!((x.z / x.w - 2.0).abs() < 1e-6);
/// # Ok(()) }
/// ```
pub fn rectify_calibrated(
    cameras: &[Camera; 2],
    cam2_from_cam1: &RigidTransform,
    options: &RectifyOptions,
) -> Result<Rectification> {
    let (width, height) = common_size(cameras)?;
    let (new_width, new_height) = options.size.unwrap_or((width, height));
    check(width, height, new_width, new_height, options.alpha)?;
    let parallel = parallel_rotations(cam2_from_cam1)?;
    let rect_from_cam = parallel.rect_from_cam;

    // An initial focal length; the zoom follows.
    let focal_px = cameras
        .iter()
        .flat_map(|c| [c.intrinsics.fu_px(), c.intrinsics.fv_px()])
        .fold(f64::INFINITY, f64::min);
    let outlines = [0, 1].map(|i| rotated_outline(&cameras[i], &rect_from_cam[i]));
    let [outline1, outline2] = outlines;
    let outlines = [outline1?, outline2?];

    let new_size = Vector2::new(f64::from(new_width), f64::from(new_height));
    let middle = (new_size - Vector2::new(1.0, 1.0)) / 2.0;
    // The viewing direction of each image's middle is shown in the result's middle.
    let mut centers = outlines.each_ref().map(|o| middle - o.center * focal_px);
    let mean = (centers[0] + centers[1]) / 2.0;
    if options.zero_disparity_at_infinity {
        centers = [mean; 2];
    } else if parallel.is_vertical {
        centers.iter_mut().for_each(|c| c.x = mean.x);
    } else {
        centers.iter_mut().for_each(|c| c.y = mean.y);
    }
    let axis = usize::from(parallel.is_vertical);
    let shared = [0, 1].map(|a| options.zero_disparity_at_infinity || a != axis);
    let visible = around_visible(&outlines, shared, &new_size, options.alpha)?;
    // The principal points stay in place, as is usual, unless that costs too much of the view.
    let (focal_px, centers) =
        around_principal_points(&outlines, &centers, focal_px, &new_size, options.alpha)
            .filter(|(focal_px, _)| *focal_px <= LARGEST_CROP * visible.framing.0)
            .unwrap_or(visible.framing);
    let new_intrinsics = |c: &Vector2<f64>| Intrinsics::new(focal_px, focal_px, c.x, c.y);
    let intrinsics = [new_intrinsics(&centers[0])?, new_intrinsics(&centers[1])?];
    let homographies = [0, 1].map(|i| {
        let k_inverse = cameras[i].intrinsics.inverse_matrix();
        intrinsics[i].matrix() * rect_from_cam[i].matrix() * k_inverse
    });
    let valid = [0, 1].map(|i| {
        let rect = visible.inner[i].scaled(focal_px, &centers[i]);
        PixelRect {
            u_min: rect.u_min.max(0.0),
            v_min: rect.v_min.max(0.0),
            u_max: rect.u_max.min(new_size.x - 1.0),
            v_max: rect.v_max.min(new_size.y - 1.0),
        }
    });
    Ok(Rectification {
        cameras: *cameras,
        rect_from_cam,
        intrinsics,
        homographies,
        q: q_matrix(
            focal_px,
            &centers[0],
            parallel.translation[axis],
            centers[0][axis] - centers[1][axis],
        ),
        is_vertical: parallel.is_vertical,
        baseline_m: parallel.translation.norm(),
        width: new_width,
        height: new_height,
        valid,
    })
}
