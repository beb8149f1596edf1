//! A camera: image size, intrinsics and lens.

use super::{Intrinsics, Lens, Observation};
use crate::{Error, Result};
use nalgebra::{Matrix2x3, Point2, Point3, Vector3};

/// A calibrated camera with any lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Image width, pixels.
    pub width: u32,
    /// Image height, pixels.
    pub height: u32,
    /// Intrinsics K.
    pub intrinsics: Intrinsics,
    /// Lens.
    pub lens: Lens,
}

impl Camera {
    /// Creates a camera without distortion.
    ///
    /// * `width`, `height`: image size, pixels
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Camera, Intrinsics};
    /// use nalgebra::{Point2, Point3};
    /// let camera = Camera::pinhole(Intrinsics::new(500.0, 500.0, 320.0, 240.0)?, 640, 480);
    /// assert_eq!(camera.project(&Point3::new(1.0, 0.0, 2.0))?, Point2::new(570.0, 240.0));
    /// # Ok(()) }
    /// ```
    pub const fn pinhole(intrinsics: Intrinsics, width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            intrinsics,
            lens: Lens::NONE,
        }
    }

    /// Returns whether this is a pinhole camera: without distortion.
    pub fn is_pinhole(&self) -> bool {
        self.lens.is_none()
    }

    /// Returns whether both cameras are pinholes.
    pub(crate) fn are_pinholes(cameras: [&Self; 2]) -> bool {
        cameras.into_iter().all(Self::is_pinhole)
    }

    /// Projects a point of the camera frame.
    ///
    /// # Errors
    /// [`Error::PointBehindCamera`] if the lens does not see the point.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Camera, Intrinsics, Lens, LensKind};
    /// use nalgebra::{Point2, Point3};
    /// let camera = Camera {
    ///     width: 640,
    ///     height: 480,
    ///     intrinsics: Intrinsics::new(500.0, 500.0, 320.0, 240.0)?,
    ///     lens: Lens::from_coefficients(LensKind::Brown, &[0.1, 0.0, 0.0, 0.0, 0.0])?,
    /// };
    /// // r² = 0.25, so the ray (0.3, 0.4) is scaled by 1.025.
    /// let pixel = camera.project(&Point3::new(0.6, 0.8, 2.0))?;
    /// assert!((pixel - Point2::new(473.75, 445.0)).norm() < 1e-9);
    /// let ray = camera.unproject(&pixel)?;
    /// assert!((ray.x / ray.z - 0.3).abs() < 1e-12 && (ray.norm() - 1.0).abs() < 1e-15);
    /// # Ok(()) }
    /// ```
    pub fn project(&self, x_in_cam: &Point3<f64>) -> Result<Point2<f64>> {
        if self.is_pinhole() {
            return self.intrinsics.project(x_in_cam);
        }
        let pixel = self.lens.pixel(&self.intrinsics, &x_in_cam.coords);
        pixel.ok_or(Error::PointBehindCamera)
    }

    /// Returns the derivatives of [`project`](Self::project) by the point; those of a pinhole for a
    /// point behind the camera.
    pub(crate) fn jacobian(&self, x_in_cam: &Point3<f64>) -> Matrix2x3<f64> {
        let (fu, fv) = (self.intrinsics.fu_px(), self.intrinsics.fv_px());
        if self.is_pinhole() {
            let (x, per_z) = (x_in_cam, 1.0 / x_in_cam.z);
            return Matrix2x3::new(
                fu * per_z,
                0.0,
                -fu * x.x * per_z * per_z,
                0.0,
                fv * per_z,
                -fv * x.y * per_z * per_z,
            );
        }
        let (by_point, _) = self.lens.derivatives(&x_in_cam.coords);
        Matrix2x3::from_rows(&[by_point.row(0) * fu, by_point.row(1) * fv])
    }

    /// Returns the unit ray of a pixel, in the camera frame.
    ///
    /// # Errors
    /// As [`Lens::ray`].
    pub fn unproject(&self, pixel: &Point2<f64>) -> Result<Vector3<f64>> {
        Ok(self.ray(pixel)?.normalize())
    }

    /// Returns the ray of a pixel, in the camera frame, of any length.
    pub(crate) fn ray(&self, pixel: &Point2<f64>) -> Result<Vector3<f64>> {
        if self.is_pinhole() {
            return Ok(self.intrinsics.ray(pixel));
        }
        self.lens.ray(&self.intrinsics.ray(pixel).xy().into())
    }

    /// Returns a pixel with its ray and the pixel's derivative by the ray.
    ///
    /// # Errors
    /// As [`Lens::ray`]; [`Error::Degenerate`] also exactly at the fold of the lens.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Camera, Fisheye, Intrinsics, Lens};
    /// use nalgebra::{Point2, Vector3};
    /// let intrinsics = Intrinsics::new(100.0, 100.0, 200.0, 200.0)?;
    /// let camera = Camera { lens: Lens::Fisheye(Fisheye::default()), ..Camera::pinhole(intrinsics, 401, 401) };
    /// // 90° to the right is π/2 focal lengths off the middle.
    /// let pixel = Point2::new(200.0 + 50.0 * core::f64::consts::PI, 200.0);
    /// let observation = camera.observe(&pixel)?;
    /// assert!((observation.ray() - Vector3::x()).norm() < 1e-12);
    /// // A point 0.01 rad further back appears a pixel further out.
    /// let off_px = observation.offset_px(&Vector3::new(1.0, 0.0, -0.01)).unwrap();
    /// assert!((off_px.x - 1.0).abs() < 1e-9);
    /// # Ok(()) }
    /// ```
    pub fn observe(&self, pixel: &Point2<f64>) -> Result<Observation> {
        let ray = self.unproject(pixel)?;
        let by_ray = self.jacobian(&ray.into());
        Observation::new(*pixel, ray, by_ray).ok_or(Error::Degenerate {
            what: "the ray of a distorted pixel",
            why: "the lens model folds there",
        })
    }

    /// Undistorts a pixel: returns the position where a camera with the same K and no distortion
    /// sees the same ray.
    ///
    /// Functions that take [`Intrinsics`], such as triangulation, work for any lens with these
    /// pixels and [`Camera::intrinsics`]. Errors are then in pixels of the undistorted image, and
    /// weigh more where the lens compresses the margin.
    ///
    /// # Errors
    /// As [`Lens::ray`]; [`Error::PointBehindCamera`] for rays of a fisheye 90° or more off its
    /// axis.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Camera, Intrinsics, Lens, LensKind};
    /// use nalgebra::Point2;
    /// let camera = Camera {
    ///     intrinsics: Intrinsics::new(500.0, 500.0, 320.0, 240.0)?,
    ///     lens: Lens::from_coefficients(LensKind::Brown, &[0.1, 0.0, 0.0, 0.0, 0.0])?,
    ///     width: 640,
    ///     height: 480,
    /// };
    /// // The pixel of the ray (0.3, 0.4), which the lens scales by 1.025.
    /// let straight = camera.pinhole_pixel(&Point2::new(473.75, 445.0))?;
    /// assert!((straight - Point2::new(470.0, 440.0)).norm() < 1e-9);
    /// # Ok(()) }
    /// ```
    #[doc(alias = "undistortPoints")]
    pub fn pinhole_pixel(&self, pixel: &Point2<f64>) -> Result<Point2<f64>> {
        if self.is_pinhole() {
            return Ok(*pixel);
        }
        self.intrinsics.project(&self.ray(pixel)?.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::absolute_pose::estimate_absolute_pose;
    use crate::camera::{LensKind, RigidTransform};
    use crate::math::random::Random;
    use crate::robust::RansacOptions;

    fn camera(kind: LensKind) -> Camera {
        let coefficients: &[f64] = match kind {
            LensKind::Brown => &[-0.27, 0.05, 0.001, -0.0005, 0.02],
            LensKind::Rational => &[0.5, 0.05, 0.001, 0.0, 0.0, 0.8, 0.15, 0.01],
            LensKind::Fisheye => &[-0.02, 0.004, -0.001, 0.0002],
            LensKind::Division => &[-0.2],
        };
        Camera {
            intrinsics: Intrinsics::new(400.0, 405.0, 320.0, 240.0).unwrap(),
            lens: Lens::from_coefficients(kind, coefficients).unwrap(),
            width: 640,
            height: 480,
        }
    }

    #[test]
    fn poses_are_found_through_any_lens() {
        let pose = RigidTransform::new(Vector3::new(0.2, -0.1, 4.0), Vector3::new(0.1, 0.3, -0.2));
        for kind in [
            LensKind::Brown,
            LensKind::Rational,
            LensKind::Fisheye,
            LensKind::Division,
        ] {
            let (camera, mut random) = (camera(kind), Random::new(4));
            let (points, straight): (Vec<_>, Vec<_>) = (0..40)
                .map(|_| {
                    let point = Point3::from(Vector3::from_fn(|_, _| random.uniform(-1.2, 1.2)));
                    let pixel = camera.project(&(pose * point)).unwrap();
                    (point, camera.pinhole_pixel(&pixel).unwrap())
                })
                .unzip();
            let options = RansacOptions::default();
            let found = estimate_absolute_pose(
                &points,
                &straight,
                &Camera::pinhole(camera.intrinsics, 640, 480),
                &options,
                &mut (),
            )
            .unwrap();
            assert_eq!(found.num_inliers, 40, "{kind:?}");
            let off = found.model.to_matrix() - pose.to_matrix();
            assert!(off.norm() < 1e-8, "{kind:?} {off}");
        }
    }

    #[test]
    fn what_no_pinhole_camera_sees_is_refused() {
        let camera = camera(LensKind::Fisheye);
        let beside = camera.project(&Point3::new(1.0, 0.0, -0.1)).unwrap();
        let refused = camera.pinhole_pixel(&beside);
        assert_eq!(refused, Err(Error::PointBehindCamera));
    }
}
