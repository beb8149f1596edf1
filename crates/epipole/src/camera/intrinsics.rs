//! Pinhole intrinsics K.

use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Point3, Vector3};

/// The pinhole model `K = [fx 0 cu; 0 fy cv; 0 0 1]`, in pixels, pixel centers at integers.
///
/// Source: Hartley & Zisserman 2004, §6.1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intrinsics {
    fu_px: f64,
    fv_px: f64,
    cu_px: f64,
    cv_px: f64,
}

impl Intrinsics {
    /// Creates intrinsics with separate focal lengths along u and v.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for NaN or infinities, [`Error::OutOfRange`] for a focal length ≤ 0.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Intrinsics;
    /// use nalgebra::{Point2, Point3};
    /// let intrinsics = Intrinsics::new(700.0, 700.0, 320.0, 240.0)?;
    /// let pixel = intrinsics.project(&Point3::new(0.4, -0.2, 2.0))?;
    /// assert_eq!(pixel, Point2::new(460.0, 170.0));
    /// # Ok(()) }
    /// ```
    pub fn new(fu_px: f64, fv_px: f64, cu_px: f64, cv_px: f64) -> Result<Self> {
        for (what, value) in [
            ("the focal length along u", fu_px),
            ("the focal length along v", fv_px),
            ("the principal point's u", cu_px),
            ("the principal point's v", cv_px),
        ] {
            if !value.is_finite() {
                return Err(Error::NotFinite { what });
            }
        }
        for (what, value) in [
            ("the focal length along u", fu_px),
            ("the focal length along v", fv_px),
        ] {
            if value <= 0.0 {
                return Err(Error::OutOfRange {
                    what,
                    requirement: "greater than 0 pixels",
                    value,
                });
            }
        }
        Ok(Self {
            fu_px,
            fv_px,
            cu_px,
            cv_px,
        })
    }

    /// Creates intrinsics with square pixels and the principal point in the middle of a
    /// `width × height` image: `cu = (width − 1)/2`, since pixel centers are at integers.
    ///
    /// # Errors
    /// As [`Intrinsics::new`].
    pub fn centered(focal_px: f64, width: u32, height: u32) -> Result<Self> {
        Self::new(
            focal_px,
            focal_px,
            (f64::from(width) - 1.0) / 2.0,
            (f64::from(height) - 1.0) / 2.0,
        )
    }

    /// Returns the intrinsics after resizing the image by `factor` (0.5 halves both sides).
    ///
    /// The image's corner (−0.5, −0.5) is preserved, as in every resize that maps whole pixels to
    /// whole pixels: `cu' = (cu + 0.5) factor − 0.5`.
    ///
    /// # Errors
    /// As [`Intrinsics::new`].
    pub fn scaled(&self, factor: f64) -> Result<Self> {
        Self::new(
            self.fu_px * factor,
            self.fv_px * factor,
            (self.cu_px + 0.5) * factor - 0.5,
            (self.cv_px + 0.5) * factor - 0.5,
        )
    }

    /// Multiplies both focal lengths by a factor; the principal point does not change.
    ///
    /// # Errors
    /// As [`Intrinsics::new`].
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Intrinsics;
    /// let k = Intrinsics::new(500.0, 510.0, 320.0, 240.0)?;
    /// assert_eq!(k.zoomed(2.0)?, Intrinsics::new(1000.0, 1020.0, 320.0, 240.0)?);
    /// # Ok(()) }
    /// ```
    pub fn zoomed(&self, factor: f64) -> Result<Self> {
        Self::new(
            self.fu_px * factor,
            self.fv_px * factor,
            self.cu_px,
            self.cv_px,
        )
    }

    /// Returns the intrinsics after resizing the image from size `from` to `to`, whose aspect ratio
    /// may differ a little.
    ///
    /// * `from`, `to`: width and height, pixels
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an empty image, and as [`Intrinsics::new`].
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Intrinsics;
    /// let half = Intrinsics::centered(500.0, 640, 480)?.resized((640, 480), (320, 240))?;
    /// assert_eq!(half, Intrinsics::centered(250.0, 320, 240)?);
    /// # Ok(()) }
    /// ```
    pub fn resized(&self, from: (u32, u32), to: (u32, u32)) -> Result<Self> {
        let [old, new] = [from, to].map(|(width, height)| f64::from(width.min(height)));
        let least = "at least 1 pixel";
        Error::check_rules(&[
            ("the shorter side of the old image", least, old, old >= 1.0),
            ("the shorter side of the new image", least, new, new >= 1.0),
        ])?;
        let ratio = |to: u32, from: u32| f64::from(to) / f64::from(from);
        let (across, down) = (ratio(to.0, from.0), ratio(to.1, from.1));
        Self::new(
            self.fu_px * across,
            self.fv_px * down,
            (self.cu_px + 0.5) * across - 0.5,
            (self.cv_px + 0.5) * down - 0.5,
        )
    }

    /// Returns the intrinsics after rotating the image clockwise by `quarters` times 90°.
    ///
    /// * `size`: width and height before the rotation, pixels
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Intrinsics;
    /// // The pixel (u, v) of a 640 × 480 image moves to (479 − v, u).
    /// let upright = Intrinsics::new(500.0, 501.0, 320.0, 230.0)?.rotated(1, (640, 480));
    /// assert_eq!(upright, Intrinsics::new(501.0, 500.0, 249.0, 320.0)?);
    /// # Ok(()) }
    /// ```
    pub fn rotated(&self, quarters: u8, (width, height): (u32, u32)) -> Self {
        let (right, bottom) = (f64::from(width) - 1.0, f64::from(height) - 1.0);
        let (mut fu_px, mut fv_px) = (self.fu_px, self.fv_px);
        if !quarters.is_multiple_of(2) {
            std::mem::swap(&mut fu_px, &mut fv_px);
        }
        let (cu_px, cv_px) = match quarters % 4 {
            0 => (self.cu_px, self.cv_px),
            1 => (bottom - self.cv_px, self.cu_px),
            2 => (right - self.cu_px, bottom - self.cv_px),
            _ => (self.cv_px, right - self.cu_px),
        };
        Self {
            fu_px,
            fv_px,
            cu_px,
            cv_px,
        }
    }

    /// Returns the focal length along u, pixels.
    pub fn fu_px(&self) -> f64 {
        self.fu_px
    }

    /// Returns the focal length along v, pixels.
    pub fn fv_px(&self) -> f64 {
        self.fv_px
    }

    /// Returns the principal point (cu, cv), pixels.
    pub fn principal_point(&self) -> Point2<f64> {
        Point2::new(self.cu_px, self.cv_px)
    }

    /// Returns the 3×3 matrix K.
    #[rustfmt::skip]
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::new(
            self.fu_px, 0.0,        self.cu_px,
            0.0,        self.fv_px, self.cv_px,
            0.0,        0.0,        1.0,
        )
    }

    /// Returns K⁻¹, in closed form.
    #[rustfmt::skip]
    pub fn inverse_matrix(&self) -> Matrix3<f64> {
        Matrix3::new(
            1.0 / self.fu_px, 0.0,              -self.cu_px / self.fu_px,
            0.0,              1.0 / self.fv_px, -self.cv_px / self.fv_px,
            0.0,              0.0,              1.0,
        )
    }

    /// Projects a point of the camera frame: `u = fu x/z + cu`, `v = fv y/z + cv`.
    ///
    /// # Errors
    /// [`Error::PointBehindCamera`] unless `z > 0`.
    pub fn project(&self, x_in_cam: &Point3<f64>) -> Result<Point2<f64>> {
        let pixel = Point2::new(
            self.fu_px * x_in_cam.x / x_in_cam.z + self.cu_px,
            self.fv_px * x_in_cam.y / x_in_cam.z + self.cv_px,
        );
        // A depth so small that the division overflows counts as in the center plane.
        if x_in_cam.z > 0.0 && pixel.x.is_finite() && pixel.y.is_finite() {
            Ok(pixel)
        } else {
            Err(Error::PointBehindCamera)
        }
    }

    /// Returns the ray of a pixel, in the camera frame, scaled to z = 1.
    pub fn ray(&self, pixel: &Point2<f64>) -> Vector3<f64> {
        Vector3::new(
            (pixel.x - self.cu_px) / self.fu_px,
            (pixel.y - self.cv_px) / self.fv_px,
            1.0,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrix_times_inverse_is_identity() {
        let k = Intrinsics::new(700.0, 650.0, 320.5, 239.5).unwrap();
        assert!((k.matrix() * k.inverse_matrix() - Matrix3::identity()).norm() < 1e-12);
    }

    #[test]
    fn bad_values_are_refused() {
        assert!(matches!(
            Intrinsics::new(0.0, 1.0, 0.0, 0.0),
            Err(Error::OutOfRange { value: 0.0, .. })
        ));
        assert!(matches!(
            Intrinsics::new(f64::NAN, 1.0, 0.0, 0.0),
            Err(Error::NotFinite { .. })
        ));
        let k = Intrinsics::centered(500.0, 640, 480).unwrap();
        for z in [0.0, -1.0, 1e-320, f64::NAN] {
            assert_eq!(
                k.project(&Point3::new(1.0, 0.0, z)),
                Err(Error::PointBehindCamera)
            );
        }
    }

    #[test]
    fn scaling_keeps_the_image_corner() {
        let k = Intrinsics::centered(500.0, 640, 480).unwrap();
        let half = k.scaled(0.5).unwrap();
        assert_eq!(half, Intrinsics::centered(250.0, 320, 240).unwrap());
    }
}
