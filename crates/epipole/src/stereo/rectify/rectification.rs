//! A rectified rig.

use super::checks::checked_index;
use super::rect::PixelRect;
use crate::Result;
use crate::camera::{Camera, Intrinsics};
use crate::progress::Monitor;
use crate::stereo::PixelMap;
use nalgebra::{Matrix3, Matrix4, Point2, Rotation3};

/// A rectified rig: two parallel virtual cameras with a common focal length, so that matches share
/// a row (or, if `is_vertical`, a column).
#[derive(Debug, Clone, PartialEq)]
pub struct Rectification {
    /// Cameras of the original images.
    pub cameras: [Camera; 2],
    /// Rotation of each camera's rays into the rectified frame.
    pub rect_from_cam: [Rotation3<f64>; 2],
    /// Intrinsics of the rectified images.
    pub intrinsics: [Intrinsics; 2],
    /// Homography from undistorted pixels of each image to rectified pixels, `H = K_rect R K⁻¹`.
    pub homographies: [Matrix3<f64>; 2],
    /// `(X, Y, Z, W) = Q (u, v, d, 1)` in the rectified frame of the first camera, where (u, v) is
    /// a pixel of the first image and d its disparity `u1 − u2` (`v1 − v2` if vertical).
    pub q: Matrix4<f64>,
    /// Whether the second camera is above or below the first: then matches share a column.
    pub is_vertical: bool,
    /// Distance between the cameras, meters.
    pub baseline_m: f64,
    /// Width of the rectified images, pixels.
    pub width: u32,
    /// Height of the rectified images, pixels.
    pub height: u32,
    /// A large rectangle in each rectified image that is completely covered.
    pub valid: [PixelRect; 2],
}

impl Rectification {
    /// Maps `pixel` of image 0 or 1 to the rectified image.
    ///
    /// # Errors
    /// [`Error::OutOfRange`](crate::Error::OutOfRange) unless `index` is 0 or 1,
    /// [`Error::PointBehindCamera`](crate::Error::PointBehindCamera) if the rectified camera looks
    /// away from it, and as [`Lens::ray`](crate::camera::Lens::ray).
    pub fn rectify_pixel(&self, index: usize, pixel: &Point2<f64>) -> Result<Point2<f64>> {
        let i = checked_index(index)?;
        let rotated = self.rect_from_cam[i] * self.cameras[i].ray(pixel)?;
        self.intrinsics[i].project(&rotated.into())
    }

    /// Returns the position in image 0 or 1 for a rectified pixel, with rotation and lens in one
    /// step. `None` if the camera does not see it.
    ///
    /// # Errors
    /// [`Error::OutOfRange`](crate::Error::OutOfRange) unless `index` is 0 or 1.
    pub fn source_pixel(
        &self,
        index: usize,
        rectified: &Point2<f64>,
    ) -> Result<Option<Point2<f64>>> {
        let i = checked_index(index)?;
        let ray = self.rect_from_cam[i].inverse() * self.intrinsics[i].ray(rectified);
        let camera = &self.cameras[i];
        // Beyond its fold the lens model would show the same content again.
        if !camera.lens.is_visible(&ray) {
            return Ok(None);
        }
        Ok(camera.project(&ray.into()).ok())
    }

    /// Returns the map that rectifies image 0 or 1. The only stage is
    /// [`Stage::Warping`](crate::progress::Stage::Warping).
    ///
    /// # Errors
    /// [`Error::OutOfRange`](crate::Error::OutOfRange) unless `index` is 0 or 1,
    /// [`Error::Canceled`](crate::Error::Canceled).
    pub fn map(&self, index: usize, monitor: &mut dyn Monitor) -> Result<PixelMap> {
        checked_index(index)?;
        let source = |u, v| {
            let rectified = Point2::new(f64::from(u), f64::from(v));
            self.source_pixel(index, &rectified).ok().flatten()
        };
        PixelMap::from_fn(self.width, self.height, source, monitor)
    }
}
