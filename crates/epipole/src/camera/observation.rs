//! Observations: pixels with their rays, for any lens.

use nalgebra::{Matrix2x3, Matrix3x2, Point2, Vector2, Vector3};

/// A pixel, its ray, and the derivative of the pixel by the ray: sufficient for estimating poses
/// and motions with any lens.
///
/// Residuals are in pixels of the distorted image, because the derivative predicts the projection
/// of points near the ray. A ray may point sideways or behind the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    pixel: Point2<f64>,
    ray: Vector3<f64>,
    px_by_ray: Matrix2x3<f64>,
    ray_by_px: Matrix3x2<f64>,
}

impl Observation {
    /// * `pixel`: observed position
    /// * `ray`: direction in the camera frame, of any nonzero length
    /// * `px_by_ray`: derivative of the pixel by a unit ray, pixels; it is 0 along the ray
    ///
    /// Returns `None` if these are not finite, or if a lateral step of the ray does not move the
    /// pixel, as at the fold of a lens.
    ///
    /// ```
    /// use epipole::camera::Observation;
    /// use nalgebra::{Matrix2x3, Point2, Vector3};
    /// // A pinhole camera with a focal length of 100 pixels, and the ray of its principal point.
    /// let by_ray = Matrix2x3::new(100.0, 0.0, 0.0, 0.0, 100.0, 0.0);
    /// let observation = Observation::new(Point2::new(320.0, 240.0), Vector3::z(), by_ray).unwrap();
    /// // A point 1/50 to the right appears two pixels to the right.
    /// let off_px = observation.offset_px(&Vector3::new(0.1, 0.0, 5.0)).unwrap();
    /// assert!((off_px.x - 2.0).abs() < 1e-12 && off_px.y == 0.0);
    /// // Points behind the camera are not seen there.
    /// assert_eq!(observation.offset_px(&-Vector3::z()), None);
    /// ```
    pub fn new(pixel: Point2<f64>, ray: Vector3<f64>, px_by_ray: Matrix2x3<f64>) -> Option<Self> {
        let ray = ray / ray.norm();
        let transposed = px_by_ray.transpose();
        let ray_by_px = transposed * (px_by_ray * transposed).try_inverse()?;
        let numbers = pixel.iter().chain(ray.iter()).chain(px_by_ray.iter());
        let is_finite = |x: &f64| x.is_finite();
        numbers
            .chain(ray_by_px.iter())
            .all(is_finite)
            .then_some(Self {
                pixel,
                ray,
                px_by_ray,
                ray_by_px,
            })
    }

    /// Returns the pixel.
    pub fn pixel(&self) -> Point2<f64> {
        self.pixel
    }

    /// Returns the unit direction in the camera frame.
    pub fn ray(&self) -> Vector3<f64> {
        self.ray
    }

    /// Returns the derivative of the unit ray by the pixel, 1/pixels.
    pub fn ray_by_px(&self) -> Matrix3x2<f64> {
        self.ray_by_px
    }

    /// Returns the offset from the pixel to the projection of a point in the camera frame, pixels,
    /// to first order: accurate to 1 % or better for errors of a few pixels. `None` for a point 90°
    /// or more off the ray.
    pub fn offset_px(&self, x_in_cam: &Vector3<f64>) -> Option<Vector2<f64>> {
        let along = self.ray.dot(x_in_cam);
        (along > 0.0).then(|| self.px_by_ray * x_in_cam / along)
    }

    /// Returns the square of [`offset_px`](Self::offset_px); infinite if undefined.
    pub(crate) fn error_sq(&self, x_in_cam: &Vector3<f64>) -> f64 {
        let error_sq = self.offset_px(x_in_cam).map(|off| off.norm_squared());
        error_sq.unwrap_or(f64::INFINITY)
    }

    /// Returns [`offset_px`](Self::offset_px) with its derivative by the point.
    pub(crate) fn offset_with_derivative(
        &self,
        x_in_cam: &Vector3<f64>,
    ) -> Option<(Vector2<f64>, Matrix2x3<f64>)> {
        let off = self.offset_px(x_in_cam)?;
        let along = self.ray.dot(x_in_cam);
        let by_point = (self.px_by_ray - off * self.ray.transpose()) / along;
        Some((off, by_point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Intrinsics;
    use crate::math::random::Random;

    #[test]
    fn errors_near_the_ray_are_those_of_the_image() {
        let mut random = Random::new(5);
        let k = Intrinsics::new(500.0, 520.0, 320.0, 240.0).unwrap();
        for _ in 0..50 {
            let at = Vector3::new(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 1.0);
            let (ray, z) = (at.normalize(), at.normalize().z);
            let (x, y) = (ray.x / z, ray.y / z);
            let by_ray = Matrix2x3::new(500.0, 0.0, -500.0 * x, 0.0, 520.0, -520.0 * y) / z;
            let pixel = k.project(&ray.into()).unwrap();
            let observation = Observation::new(pixel, at, by_ray).unwrap();
            let point = 4.0 * at + 0.3 * Vector3::from_fn(|_, _| random.normal());
            let exact = k.project(&point.into()).unwrap() - pixel;
            let (off, by_point) = observation.offset_with_derivative(&point).unwrap();
            // Near the ray this is first-order accurate for a pinhole camera.
            assert!((off - exact).norm() < 0.2 * exact.norm(), "{off} {exact}");
            let near = at + 1e-5 * (point - 4.0 * at);
            let exact = k.project(&near.into()).unwrap() - pixel;
            assert!((observation.offset_px(&near).unwrap() - exact).norm() < 1e-3 * exact.norm());
            for axis in 0..3 {
                let mut step = Vector3::zeros();
                step[axis] = 1e-6;
                let [up, down] =
                    [point + step, point - step].map(|x| observation.offset_px(&x).unwrap());
                assert!((by_point.column(axis) - (up - down) / 2e-6).norm() < 1e-5);
            }
            let there_and_back = by_ray * observation.ray_by_px();
            assert!((there_and_back - nalgebra::Matrix2::identity()).norm() < 1e-9);
        }
    }

    #[test]
    fn a_fold_and_what_is_not_finite_have_no_ray() {
        let flat = Matrix2x3::new(100.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        assert_eq!(Observation::new(Point2::origin(), Vector3::z(), flat), None);
        let fine = Matrix2x3::new(100.0, 0.0, 0.0, 0.0, 100.0, 0.0);
        assert_eq!(
            Observation::new(Point2::origin(), Vector3::zeros(), fine),
            None
        );
        let nowhere = Point2::new(f64::NAN, 0.0);
        assert_eq!(Observation::new(nowhere, Vector3::z(), fine), None);
    }
}
