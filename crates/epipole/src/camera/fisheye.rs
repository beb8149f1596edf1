//! Fisheye lenses, with fields of view of 180° and more.

use crate::math::real_roots::{DEGREE, real_roots};
use crate::{Error, Result};
use nalgebra::{Matrix2x3, Point2, Vector2, Vector3};

/// Fisheye lens: a ray at the angle θ from the optical axis is imaged at the radius
/// `θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸)`, in units of the focal length.
///
/// These are the four coefficients of OpenCV's fisheye model. Rays beside and behind the camera are
/// seen as well.
///
/// Source: Kannala & Brandt 2006, "A generic camera model and calibration method for conventional,
/// wide-angle, and fish-eye lenses".
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Fisheye {
    /// k1 to k4.
    pub coefficients: [f64; 4],
}

impl Fisheye {
    /// Returns the radius for the angle θ, and its derivative.
    fn radius(&self, theta: f64) -> (f64, f64) {
        let [k1, k2, k3, k4] = self.coefficients;
        let s = theta * theta;
        (
            theta * (1.0 + s * (k1 + s * (k2 + s * (k3 + s * k4)))),
            1.0 + s * (3.0 * k1 + s * (5.0 * k2 + s * (7.0 * k3 + s * 9.0 * k4))),
        )
    }

    /// Returns the distorted position of a ray, in units of the focal length; `None` for a zero ray
    /// and straight backwards.
    ///
    /// ```
    /// use epipole::camera::Fisheye;
    /// use nalgebra::Vector3;
    /// // 45° to the right.
    /// let distorted = Fisheye::default().project(&Vector3::new(2.0, 0.0, 2.0)).unwrap();
    /// assert!((distorted.x - core::f64::consts::FRAC_PI_4).abs() < 1e-15 && distorted.y == 0.0);
    /// ```
    pub fn project(&self, ray: &Vector3<f64>) -> Option<Point2<f64>> {
        let across = libm::hypot(ray.x, ray.y);
        let theta = libm::atan2(across, ray.z);
        if across == 0.0 {
            return (ray.z > 0.0).then(Point2::origin);
        }
        let distorted = Point2::from(ray.xy() * (self.radius(theta).0 / across));
        (distorted.x.is_finite() && distorted.y.is_finite()).then_some(distorted)
    }

    /// Returns the derivatives of [`project`](Self::project) by the ray and by the four
    /// coefficients.
    pub fn derivatives(&self, ray: &Vector3<f64>) -> (Matrix2x3<f64>, [[f64; 4]; 2]) {
        let (x, y, z) = (ray.x, ray.y, ray.z);
        let across = libm::hypot(x, y);
        let length_sq = ray.norm_squared();
        // On the axis it is a pinhole.
        if across <= 1e-9 * z.abs() {
            let by_ray = Matrix2x3::new(1.0 / z, 0.0, 0.0, 0.0, 1.0 / z, 0.0);
            return (by_ray, [[0.0; 4]; 2]);
        }
        let theta = libm::atan2(across, z);
        let (radius, slope) = self.radius(theta);
        let factor = radius / across;
        // Derivatives of the factor by the distance from the axis (divided by that distance) and by
        // z.
        let by_across = (slope * z / length_sq - factor) / (across * across);
        let by_z = -slope / length_sq;
        let by_ray = Matrix2x3::new(
            factor + x * x * by_across,
            x * y * by_across,
            x * by_z,
            x * y * by_across,
            factor + y * y * by_across,
            y * by_z,
        );
        let s = theta * theta;
        let first = theta * s / across;
        let powers = [first, first * s, first * s * s, first * s * s * s];
        (by_ray, [powers.map(|p| p * x), powers.map(|p| p * y)])
    }

    /// Returns the unit ray imaged at a position.
    ///
    /// # Errors
    /// [`Error::Degenerate`] if there is no ray: beyond the angle at which the radius stops
    /// growing, or beyond straight backwards. [`Error::NotFinite`] for NaN or infinities.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Fisheye;
    /// use nalgebra::Point2;
    /// let ray = Fisheye::default().ray(&Point2::new(core::f64::consts::FRAC_PI_2, 0.0))?;
    /// assert!((ray - nalgebra::Vector3::x()).norm() < 1e-12);
    /// # Ok(()) }
    /// ```
    pub fn ray(&self, distorted: &Point2<f64>) -> Result<Vector3<f64>> {
        if !(distorted.x.is_finite() && distorted.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "the distorted place",
            });
        }
        let wanted = distorted.coords.norm();
        if wanted == 0.0 {
            return Ok(Vector3::z());
        }
        let (mut low, mut high) = (0.0, self.fold().min(core::f64::consts::PI));
        if self.radius(high).0 < wanted {
            return Err(Error::Degenerate {
                what: "the ray of a distorted pixel",
                why: "the lens model bends no ray to it",
            });
        }
        // Monotone in between; 60 bisections are accurate enough and cannot diverge.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.radius(middle).0 < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        let (sine, cosine) = libm::sincos(high);
        let across: Vector2<f64> = distorted.coords * (sine / wanted);
        Ok(Vector3::new(across.x, across.y, cosine))
    }

    /// Returns whether the ray is inside the angle at which the radius stops growing.
    pub(super) fn is_visible(&self, ray: &Vector3<f64>) -> bool {
        let theta = libm::atan2(libm::hypot(ray.x, ray.y), ray.z);
        theta < self.fold().min(core::f64::consts::PI)
    }

    /// Returns the angle at which the radius stops growing; infinite if it never does.
    fn fold(&self) -> f64 {
        let [k1, k2, k3, k4] = self.coefficients;
        let mut slope = [0.0; DEGREE + 1];
        slope[..5].copy_from_slice(&[1.0, 3.0 * k1, 5.0 * k2, 7.0 * k3, 9.0 * k4]);
        let mut roots = [0.0; DEGREE];
        let count = real_roots(&slope, 1e-14, &mut roots);
        roots[..count]
            .iter()
            .filter(|s| **s > 0.0)
            .fold(f64::INFINITY, |least, s| least.min(s.sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn lens() -> Fisheye {
        Fisheye {
            coefficients: [-0.02, 0.008, -0.004, 0.0006],
        }
    }

    /// From OpenCV 5.0's `fisheye.projectPoints` with K = I.
    #[test]
    fn agrees_with_another_implementation() {
        for (ray, distorted) in REFERENCE {
            let off = lens().project(&Vector3::from(ray)).unwrap() - Point2::from(distorted);
            assert!(off.norm() < 1e-14, "{off}");
        }
    }

    const REFERENCE: [([f64; 3], [f64; 2]); 2] = [
        ([0.6, -0.4, 0.5], [0.7909381099428479, -0.527292073295232]),
        ([-1.5, 0.9, 0.2], [-1.2087477289934756, 0.7252486373960854]),
    ];

    #[test]
    fn there_and_back_also_behind_the_camera() {
        let mut random = Random::new(1);
        for _ in 0..1000 {
            let theta = random.uniform(0.0, 1.9);
            let angle_rad = random.uniform(0.0, 6.3);
            let ray = Vector3::new(
                libm::sin(theta) * libm::cos(angle_rad),
                libm::sin(theta) * libm::sin(angle_rad),
                libm::cos(theta),
            );
            let back = lens().ray(&lens().project(&(ray * 3.0)).unwrap()).unwrap();
            assert!((back - ray).norm() < 1e-9, "{ray} {back}");
        }
        assert!(lens().ray(&Point2::new(20.0, 0.0)).is_err());
        assert!(lens().ray(&Point2::new(f64::NAN, 0.0)).is_err());
        assert_eq!(lens().project(&-Vector3::z()), None);
    }

    #[test]
    fn derivatives_are_differences() {
        let mut random = Random::new(2);
        for _ in 0..50 {
            let ray = Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0)) + Vector3::z();
            let (by_ray, by_k) = lens().derivatives(&ray);
            let h = 1e-6;
            for axis in 0..3 {
                let mut step = Vector3::zeros();
                step[axis] = h;
                let [up, down] = [ray + step, ray - step].map(|r| lens().project(&r).unwrap());
                assert!((by_ray.column(axis) - (up - down) / (2.0 * h)).norm() < 1e-7);
            }
            for k in 0..4 {
                let [up, down] = [h, -h].map(|d| {
                    let mut moved = lens();
                    moved.coefficients[k] += d;
                    moved.project(&ray).unwrap()
                });
                let slope = (up - down) / (2.0 * h);
                assert!((slope.x - by_k[0][k]).abs() + (slope.y - by_k[1][k]).abs() < 1e-7);
            }
        }
    }
}
