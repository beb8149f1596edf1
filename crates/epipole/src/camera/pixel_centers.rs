//! Conversion between our pixel coordinates and those with the origin at the corner.

use super::Intrinsics;
use crate::Result;
use nalgebra::{Point2, Vector2};

/// Offset of COLMAP's pixel coordinates from ours, pixels: the center of the first pixel is at
/// (0.5, 0.5) there, at (0, 0) here.
const HALF_PIXEL: f64 = 0.5;

/// Converts a pixel from our convention, centers at integers, to COLMAP's, centers at halves.
///
/// * `pixel`: (u, v), pixels
///
/// Source: COLMAP's documentation, "Output format", `images.txt`.
///
/// ```
/// use epipole::camera::{pixel_from_colmap, pixel_to_colmap};
/// use nalgebra::Point2;
/// // The middle of the first pixel.
/// assert_eq!(pixel_to_colmap(&Point2::new(0.0, 0.0)), Point2::new(0.5, 0.5));
/// assert_eq!(pixel_from_colmap(&Point2::new(0.5, 0.5)), Point2::new(0.0, 0.0));
/// ```
pub fn pixel_to_colmap(pixel: &Point2<f64>) -> Point2<f64> {
    pixel + Vector2::repeat(HALF_PIXEL)
}

/// Converts a pixel from COLMAP's convention, centers at halves, to ours, centers at integers: the
/// inverse of [`pixel_to_colmap`].
///
/// Source: COLMAP's documentation, "Output format", `images.txt`.
///
/// ```
/// use epipole::camera::pixel_from_colmap;
/// use nalgebra::Point2;
/// // COLMAP puts the middle of a 640 × 480 image at (320, 240), between four pixels.
/// assert_eq!(pixel_from_colmap(&Point2::new(320.0, 240.0)), Point2::new(319.5, 239.5));
/// ```
pub fn pixel_from_colmap(pixel: &Point2<f64>) -> Point2<f64> {
    pixel - Vector2::repeat(HALF_PIXEL)
}

impl Intrinsics {
    /// Returns `[fx, fy, cx, cy]` of COLMAP's `PINHOLE` camera: the principal point is half a pixel
    /// larger.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Intrinsics;
    /// let middle = Intrinsics::centered(700.0, 640, 480)?;
    /// assert_eq!(middle.to_colmap(), [700.0, 700.0, 320.0, 240.0]);
    /// # Ok(()) }
    /// ```
    pub fn to_colmap(&self) -> [f64; 4] {
        let center = pixel_to_colmap(&self.principal_point());
        [self.fu_px(), self.fv_px(), center.x, center.y]
    }

    /// Creates intrinsics from `[fx, fy, cx, cy]` of COLMAP's `PINHOLE` camera: the inverse of
    /// [`Intrinsics::to_colmap`].
    ///
    /// # Errors
    /// As [`Intrinsics::new`].
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Intrinsics;
    /// let camera = Intrinsics::from_colmap([700.0, 700.0, 320.0, 240.0])?;
    /// assert_eq!(camera, Intrinsics::centered(700.0, 640, 480)?);
    /// # Ok(()) }
    /// ```
    pub fn from_colmap([fx, fy, cx, cy]: [f64; 4]) -> Result<Self> {
        let center = pixel_from_colmap(&Point2::new(cx, cy));
        Self::new(fx, fy, center.x, center.y)
    }
}
