//! A camera with its lens and the size of its photographs.

use crate::camera::{Intrinsics, Lens, SeenRay};
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

    /// A pixel with its ray, and how it moves with it: what
    /// [`estimate_relative_pose_of_rays`](crate::epipolar::estimate_relative_pose_of_rays) and
    /// [`estimate_absolute_pose_of_rays`](crate::absolute_pose::estimate_absolute_pose_of_rays) take of any lens.
    ///
    /// # Errors
    /// As [`SeenRay::through`].
    pub fn seen_ray(&self, pixel: &Point2<f64>) -> Result<SeenRay> {
        SeenRay::through(&self.lens, &self.intrinsics, pixel)
    }

    /// The pixel where a camera with the same K and no distortion would see what this one sees at `pixel`.
    ///
    /// Functions that take [`Intrinsics`], for a pose, a motion or a triangulation, take such pixels of any lens,
    /// together with [`CalibratedCamera::intrinsics`]. Errors in pixels are then those of the straightened
    /// photograph: where the lens squeezes the margin, they count for more there.
    ///
    /// # Errors
    /// As [`Lens::ray`]; [`Error::PointBehindCamera`] for what a fisheye sees 90° and more off its axis.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::calibration::CalibratedCamera;
    /// use epipole::camera::{Intrinsics, Lens, LensKind};
    /// use nalgebra::Point2;
    /// let camera = CalibratedCamera {
    ///     intrinsics: Intrinsics::new(500.0, 500.0, 320.0, 240.0)?,
    ///     lens: Lens::from_coefficients(LensKind::Brown, &[0.1, 0.0, 0.0, 0.0, 0.0])?,
    ///     width: 640,
    ///     height: 480,
    /// };
    /// // Of the ray (0.3, 0.4), which the lens bends to 1.025 times as much.
    /// let straight = camera.pinhole_pixel(&Point2::new(473.75, 445.0))?;
    /// assert!((straight - Point2::new(470.0, 440.0)).norm() < 1e-9);
    /// # Ok(()) }
    /// ```
    #[doc(alias = "undistortPoints")]
    pub fn pinhole_pixel(&self, pixel: &Point2<f64>) -> Result<Point2<f64>> {
        self.intrinsics.project(&self.ray(pixel)?.into())
    }

    pub(super) fn to_pixel(self, seen: &Point2<f64>) -> Point2<f64> {
        let center = self.intrinsics.principal_point();
        Point2::new(
            self.intrinsics.fu_px() * seen.x + center.x,
            self.intrinsics.fv_px() * seen.y + center.y,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::absolute_pose::estimate_absolute_pose;
    use crate::camera::{LensKind, RigidTransform};
    use crate::math::random::Random;
    use crate::robust::RansacOptions;

    fn camera(kind: LensKind) -> CalibratedCamera {
        let coefficients: &[f64] = match kind {
            LensKind::Brown => &[-0.27, 0.05, 0.001, -0.0005, 0.02],
            LensKind::Rational => &[0.5, 0.05, 0.001, 0.0, 0.0, 0.8, 0.15, 0.01],
            LensKind::Fisheye => &[-0.02, 0.004, -0.001, 0.0002],
            LensKind::Division => &[-0.2],
        };
        CalibratedCamera {
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
            let found =
                estimate_absolute_pose(&points, &straight, &camera.intrinsics, &options, &mut ())
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
