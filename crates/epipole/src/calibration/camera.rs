//! A camera with its lens and the size of its photographs.

use crate::camera::{Intrinsics, Lens};
use crate::{Error, Result};
use nalgebra::{Point2, Point3, Vector3};

/// A calibrated camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CalibratedCamera {
    /// K.
    pub intrinsics: Intrinsics,
    /// The lens.
    pub lens: Lens,
    /// Size of the photographs, pixels.
    pub width: u32,
    /// See `width`.
    pub height: u32,
}

impl CalibratedCamera {
    /// The pixel where a point of the camera frame is seen.
    ///
    /// # Errors
    /// [`Error::PointBehindCamera`] if the lens does not see it.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::calibration::CalibratedCamera;
    /// use epipole::camera::{Intrinsics, Lens, LensKind};
    /// use nalgebra::{Point2, Point3};
    /// let camera = CalibratedCamera {
    ///     intrinsics: Intrinsics::new(500.0, 500.0, 320.0, 240.0)?,
    ///     lens: Lens::from_coefficients(LensKind::Brown, &[0.1, 0.0, 0.0, 0.0, 0.0])?,
    ///     width: 640,
    ///     height: 480,
    /// };
    /// // r² = 0.25, so the ray (0.3, 0.4) bends to 1.025 times as much.
    /// let pixel = camera.project(&Point3::new(0.6, 0.8, 2.0))?;
    /// assert!((pixel - Point2::new(473.75, 445.0)).norm() < 1e-9);
    /// let ray = camera.ray(&pixel)?;
    /// assert!((ray.x / ray.z - 0.3).abs() < 1e-12);
    /// # Ok(()) }
    /// ```
    pub fn project(&self, x_in_cam: &Point3<f64>) -> Result<Point2<f64>> {
        let seen = self
            .lens
            .project(&x_in_cam.coords)
            .ok_or(Error::PointBehindCamera)?;
        Ok(self.to_pixel(&seen))
    }

    /// The ray that a pixel sees, in the camera frame, of any length.
    ///
    /// # Errors
    /// As [`Lens::ray`].
    pub fn ray(&self, pixel: &Point2<f64>) -> Result<Vector3<f64>> {
        self.lens.ray(&self.intrinsics.ray(pixel).xy().into())
    }

    pub(super) fn to_pixel(self, seen: &Point2<f64>) -> Point2<f64> {
        let center = self.intrinsics.principal_point();
        Point2::new(
            self.intrinsics.fu_px() * seen.x + center.x,
            self.intrinsics.fv_px() * seen.y + center.y,
        )
    }
}
