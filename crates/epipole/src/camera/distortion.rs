//! Lens distortion after Brown and Conrady.

use crate::{Error, Result};
use nalgebra::{Matrix2, Point2};

/// The bending of rays by a lens: radial terms k1, k2, k3 and tangential terms p1, p2.
///
/// A ray through (x, y, 1) leaves the lens as the ray through (x', y', 1), with r² = x² + y²:
///
/// * `x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²)`
/// * `y' = y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2 y²) + 2 p2 x y`
///
/// The pixel is then `u = fu x' + cu`, `v = fv y' + cv`. These are OpenCV's first five numbers, in
/// the order k1, k2, p1, p2, k3.
///
/// Sources: Conrady 1919, "Decentred lens-systems"; Brown 1966, "Decentering distortion of
/// lenses".
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distortion {
    /// Of r².
    pub k1: f64,
    /// Of r⁴.
    pub k2: f64,
    /// Tangential, mostly along y.
    pub p1: f64,
    /// Tangential, mostly along x.
    pub p2: f64,
    /// Of r⁶.
    pub k3: f64,
}

/// Steps after which undistortion gives up; five are usual.
const MAX_STEPS: usize = 50;
/// The residual at which it stops, in units of the focal length: 1e-9 px or better.
const RESIDUAL: f64 = 1e-13;

impl Distortion {
    /// A lens that bends nothing.
    pub const NONE: Self = Self {
        k1: 0.0,
        k2: 0.0,
        p1: 0.0,
        p2: 0.0,
        k3: 0.0,
    };

    /// From `[k1, k2, p1, p2, k3]`, OpenCV's order.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for NaN or infinities.
    pub fn from_coefficients(coefficients: [f64; 5]) -> Result<Self> {
        if coefficients.iter().any(|k| !k.is_finite()) {
            return Err(Error::NotFinite {
                what: "every coefficient of the lens distortion",
            });
        }
        let [k1, k2, p1, p2, k3] = coefficients;
        Ok(Self { k1, k2, p1, p2, k3 })
    }

    /// Whether the lens bends nothing.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Where the ray through (x, y, 1) is seen, in the same normalized coordinates.
    ///
    /// ```
    /// use epipole::camera::Distortion;
    /// use nalgebra::Point2;
    /// let barrel = Distortion { k1: -0.2, ..Distortion::NONE };
    /// // r² = 0.25, so the factor is 1 − 0.2 × 0.25 = 0.95.
    /// let bent = barrel.distort(&Point2::new(0.3, 0.4));
    /// assert!((bent - Point2::new(0.285, 0.38)).norm() < 1e-15);
    /// ```
    pub fn distort(&self, ray: &Point2<f64>) -> Point2<f64> {
        let (x, y) = (ray.x, ray.y);
        let r2 = x * x + y * y;
        let radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
        Point2::new(
            x * radial + 2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x),
            y * radial + self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y,
        )
    }

    /// The derivative of [`Distortion::distort`], rows x', y', columns x, y.
    pub fn jacobian(&self, ray: &Point2<f64>) -> Matrix2<f64> {
        let (x, y) = (ray.x, ray.y);
        let r2 = x * x + y * y;
        let radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
        // d radial / d r², doubled: r² changes by 2 x dx + 2 y dy.
        let slope = 2.0 * (self.k1 + r2 * (2.0 * self.k2 + r2 * 3.0 * self.k3));
        let (p1, p2) = (self.p1, self.p2);
        let mixed = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
        Matrix2::new(
            radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x,
            mixed,
            mixed,
            radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x,
        )
    }

    /// The ray (x, y, 1) that is seen at a distorted place: the inverse of
    /// [`Distortion::distort`], by Newton steps from the center outward.
    ///
    /// Strong distortion folds the plane: beyond some radius a place is seen for two rays, or for
    /// none. The answer lies inside the fold, where the lens model means something.
    ///
    /// # Errors
    /// [`Error::Degenerate`] where no ray inside the fold is seen, [`Error::NotFinite`] for NaN
    /// or infinities.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Distortion;
    /// use nalgebra::Point2;
    /// let barrel = Distortion { k1: -0.2, ..Distortion::NONE };
    /// let ray = barrel.undistort(&Point2::new(0.285, 0.38))?;
    /// assert!((ray - Point2::new(0.3, 0.4)).norm() < 1e-12);
    /// // x (1 − 0.2 x²) is never more than 0.861.
    /// assert!(barrel.undistort(&Point2::new(0.9, 0.0)).is_err());
    /// # Ok(()) }
    /// ```
    pub fn undistort(&self, seen: &Point2<f64>) -> Result<Point2<f64>> {
        if !(seen.x.is_finite() && seen.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "the distorted place",
            });
        }
        if self.is_none() {
            return Ok(*seen);
        }
        let unseen = Error::Degenerate {
            what: "the ray of a distorted pixel",
            why: "the lens model bends no ray to it",
        };
        // Beside the fold the undistorted place is the best start.
        let mut ray = *seen;
        let mut error = (self.distort(&ray) - seen).norm();
        let tolerance = RESIDUAL * (1.0 + seen.coords.norm());
        for _ in 0..MAX_STEPS {
            if error <= tolerance {
                break;
            }
            let jacobian = self.jacobian(&ray);
            let Some(inverse) = jacobian.try_inverse() else {
                return Err(unseen);
            };
            let step = inverse * (self.distort(&ray) - seen);
            // Newton may leap over the fold, so a step that does not help is halved.
            let mut scale = 1.0;
            let better = loop {
                let candidate = ray - step * scale;
                let candidate_error = (self.distort(&candidate) - seen).norm();
                if candidate_error < error {
                    break Some((candidate, candidate_error));
                }
                scale *= 0.5;
                if scale < 1e-6 {
                    break None;
                }
            };
            match better {
                Some((candidate, candidate_error)) => (ray, error) = (candidate, candidate_error),
                None => break,
            }
        }
        // Rounding may stop it a little early, never far from the answer.
        if error <= 1e3 * tolerance && self.is_seen(&ray) {
            Ok(ray)
        } else {
            Err(unseen)
        }
    }

    /// Whether the ray lies inside the fold: the radial part grows all the way to it.
    pub(crate) fn is_seen(&self, ray: &Point2<f64>) -> bool {
        let r2 = ray.coords.norm_squared();
        // d/dr of r (1 + k1 r² + k2 r⁴ + k3 r⁶), at steps that no usual lens hides a fold between.
        (0..=32).all(|i| {
            let s = r2 * f64::from(i) / 32.0;
            1.0 + s * (3.0 * self.k1 + s * (5.0 * self.k2 + s * 7.0 * self.k3)) > 0.0
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// The coefficients of a real wide-angle camera.
    fn wide_angle() -> Distortion {
        Distortion::from_coefficients([-0.28340811, 0.07395907, 0.00019359, 1.76187114e-5, 0.0])
            .unwrap()
    }

    #[test]
    fn there_and_back() {
        let mut random = Random::new(1);
        for distortion in [
            wide_angle(),
            Distortion::NONE,
            Distortion::from_coefficients([-0.27, -0.04, 0.0018, -0.0003, 0.24]).unwrap(),
            Distortion::from_coefficients([0.3, 0.1, -0.002, 0.001, 0.0]).unwrap(),
        ] {
            for _ in 0..500 {
                let ray = Point2::new(random.uniform(-0.7, 0.7), random.uniform(-0.5, 0.5));
                let back = distortion.undistort(&distortion.distort(&ray)).unwrap();
                assert!((back - ray).norm() < 1e-11, "{ray} came back as {back}");
            }
        }
    }

    /// Numbers from OpenCV 5.0's `projectPoints` with K = I.
    #[test]
    fn agrees_with_another_implementation() {
        for (distortion, ray, seen) in reference_points() {
            assert!((distortion.distort(&ray) - seen).norm() < 1e-14);
        }
    }

    fn reference_points() -> Vec<(Distortion, Point2<f64>, Point2<f64>)> {
        REFERENCE
            .iter()
            .map(|r| {
                (
                    Distortion::from_coefficients([r[0], r[1], r[2], r[3], r[4]]).unwrap(),
                    Point2::new(r[5], r[6]),
                    Point2::new(r[7], r[8]),
                )
            })
            .collect()
    }

    #[rustfmt::skip]
    const REFERENCE: [[f64; 9]; 2] = [
        [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0, 0.6, -0.4, 0.523504713198936, -0.348896367512672],
        [-0.27, -0.04, 0.0018, -0.0003, 0.24, -0.5, 0.45, -0.447031389375, 0.40302057543750003],
    ];

    #[test]
    fn the_jacobian_is_the_derivative() {
        let distortion = Distortion::from_coefficients([-0.27, 0.05, 0.003, -0.002, 0.02]).unwrap();
        let ray = Point2::new(0.35, -0.2);
        let h = 1e-6;
        for axis in 0..2 {
            let mut step = nalgebra::Vector2::zeros();
            step[axis] = h;
            let slope =
                (distortion.distort(&(ray + step)) - distortion.distort(&(ray - step))) / (2.0 * h);
            assert!((distortion.jacobian(&ray).column(axis) - slope).norm() < 1e-9);
        }
    }

    #[test]
    fn places_that_no_ray_reaches_are_refused() {
        // x − 0.3 x³ peaks at x = 1.054, where it is 0.703.
        let barrel = Distortion {
            k1: -0.3,
            ..Distortion::NONE
        };
        for x in [0.71, 1.0, 5.0, 1e6] {
            assert!(matches!(
                barrel.undistort(&Point2::new(x, 0.0)),
                Err(Error::Degenerate { .. })
            ));
        }
        assert!(barrel.undistort(&Point2::new(0.70, 0.0)).unwrap().x < 1.054);
        assert!(barrel.undistort(&Point2::new(f64::NAN, 0.0)).is_err());
        assert!(Distortion::from_coefficients([0.0, f64::INFINITY, 0.0, 0.0, 0.0]).is_err());
    }
}
