//! Lens distortion by a rational function, for wide-angle lenses.

use super::Distortion;
use super::unbend::{RESIDUAL, descend, radial_start};
use crate::math::real_roots::{DEGREE, real_roots};
use crate::{Error, Result};
use nalgebra::{Matrix2, Point2};

/// Distortion whose radial factor is a rational function, with r² = x² + y²:
///
/// `(1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶)`
///
/// The tangential terms are those of [`Distortion`]. These are OpenCV's first eight coefficients,
/// in the order k1, k2, p1, p2, k3, k4, k5, k6.
///
/// Source: Claus & Fitzgibbon 2005, "A rational function lens distortion model for general cameras"
/// (the idea); the form is OpenCV's.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct RationalDistortion {
    /// The numerator k1, k2, k3, and the tangential terms.
    pub numerator: Distortion,
    /// The denominator k4, k5 and k6.
    pub denominator: [f64; 3],
}

impl RationalDistortion {
    /// Returns the radial factor and its derivative by r².
    fn factor(&self, r_sq: f64) -> (f64, f64) {
        let Distortion { k1, k2, k3, .. } = self.numerator;
        let [k4, k5, k6] = self.denominator;
        let above = 1.0 + r_sq * (k1 + r_sq * (k2 + r_sq * k3));
        let below = 1.0 + r_sq * (k4 + r_sq * (k5 + r_sq * k6));
        let above_slope = k1 + r_sq * (2.0 * k2 + r_sq * 3.0 * k3);
        let below_slope = k4 + r_sq * (2.0 * k5 + r_sq * 3.0 * k6);
        let factor = above / below;
        (factor, (above_slope - factor * below_slope) / below)
    }

    /// Returns the distorted position of the ray (x, y, 1), in normalized coordinates.
    ///
    /// ```
    /// use epipole::camera::{Distortion, RationalDistortion};
    /// use nalgebra::Point2;
    /// let lens = RationalDistortion { numerator: Distortion::NONE, denominator: [1.0, 0.0, 0.0] };
    /// // r² = 0.25, so the factor is 1/1.25 = 0.8.
    /// assert!((lens.distort(&Point2::new(0.3, 0.4)) - Point2::new(0.24, 0.32)).norm() < 1e-15);
    /// ```
    pub fn distort(&self, ray: &Point2<f64>) -> Point2<f64> {
        let (x, y) = (ray.x, ray.y);
        let r_sq = x * x + y * y;
        let (factor, _) = self.factor(r_sq);
        let Distortion { p1, p2, .. } = self.numerator;
        Point2::new(
            x * factor + 2.0 * p1 * x * y + p2 * (r_sq + 2.0 * x * x),
            y * factor + p1 * (r_sq + 2.0 * y * y) + 2.0 * p2 * x * y,
        )
    }

    /// Returns the derivative of [`distort`](Self::distort), rows x', y', columns x, y.
    pub fn jacobian(&self, ray: &Point2<f64>) -> Matrix2<f64> {
        let (x, y) = (ray.x, ray.y);
        let (factor, slope) = self.factor(x * x + y * y);
        // r² changes by 2 x dx + 2 y dy.
        let slope = 2.0 * slope;
        let Distortion { p1, p2, .. } = self.numerator;
        let mixed = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
        Matrix2::new(
            factor + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x,
            mixed,
            mixed,
            factor + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x,
        )
    }

    /// Returns the derivatives of [`distort`](Self::distort) by the coefficients, in OpenCV's
    /// order: of x' and of y'.
    pub fn by_coefficients(&self, ray: &Point2<f64>) -> [[f64; 8]; 2] {
        let (x, y) = (ray.x, ray.y);
        let r_sq = x * x + y * y;
        let (factor, _) = self.factor(r_sq);
        let [k4, k5, k6] = self.denominator;
        let below = 1.0 + r_sq * (k4 + r_sq * (k5 + r_sq * k6));
        let powers = [r_sq, r_sq * r_sq, r_sq * r_sq * r_sq];
        let row = |along: f64, p1: f64, p2: f64| {
            let up = powers.map(|power| along * power / below);
            let down = powers.map(|power| -along * factor * power / below);
            [up[0], up[1], p1, p2, up[2], down[0], down[1], down[2]]
        };
        [
            row(x, 2.0 * x * y, r_sq + 2.0 * x * x),
            row(y, r_sq + 2.0 * y * y, 2.0 * x * y),
        ]
    }

    /// Returns the ray (x, y, 1) imaged at a distorted position, inside the radius at which the
    /// radial part stops growing.
    ///
    /// # Errors
    /// [`Error::Degenerate`] if there is no ray, [`Error::NotFinite`] for NaN or infinities.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::{Distortion, RationalDistortion};
    /// use nalgebra::Point2;
    /// let lens = RationalDistortion { numerator: Distortion::NONE, denominator: [1.0, 0.0, 0.0] };
    /// let ray = lens.undistort(&Point2::new(0.24, 0.32))?;
    /// assert!((ray - Point2::new(0.3, 0.4)).norm() < 1e-12);
    /// # Ok(()) }
    /// ```
    pub fn undistort(&self, distorted: &Point2<f64>) -> Result<Point2<f64>> {
        if !(distorted.x.is_finite() && distorted.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "the distorted place",
            });
        }
        let fold_sq = self.fold_sq();
        let start = radial_start(distorted, fold_sq, |r| r * self.factor(r * r).0);
        let (ray, error) = descend(
            distorted,
            start,
            fold_sq,
            |ray| self.distort(ray),
            |ray| self.jacobian(ray),
        );
        if error <= 1e3 * RESIDUAL * (1.0 + distorted.coords.norm()) {
            Ok(ray)
        } else {
            Err(Error::Degenerate {
                what: "the ray of a distorted pixel",
                why: "the lens model bends no ray to it",
            })
        }
    }

    /// Returns the squared radius at which the radial part stops growing, or has a pole; infinite
    /// if there is none.
    pub(crate) fn fold_sq(&self) -> f64 {
        let Distortion { k1, k2, k3, .. } = self.numerator;
        let [k4, k5, k6] = self.denominator;
        let (above, below) = ([1.0, k1, k2, k3], [1.0, k4, k5, k6]);
        // d/dr of r N/D is (N D + 2 s (N' D − N D')) / D², in s = r².
        let mut slope = [0.0; DEGREE + 1];
        let mut pole = [0.0; DEGREE + 1];
        for (i, a) in above.iter().enumerate() {
            pole[i] = below[i];
            for (j, b) in below.iter().enumerate() {
                slope[i + j] += a * b * (1.0 + 2.0 * (i as f64 - j as f64));
            }
        }
        let mut least = f64::INFINITY;
        for polynomial in [&slope, &pole] {
            let mut roots = [0.0; DEGREE];
            let count = real_roots(polynomial, 1e-14, &mut roots);
            for s in &roots[..count] {
                if *s > 0.0 {
                    least = least.min(*s);
                }
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn wide() -> RationalDistortion {
        RationalDistortion {
            numerator: Distortion::from_coefficients([0.4, -0.3, 0.001, -0.002, 0.02]).unwrap(),
            denominator: [0.75, -0.2, 0.05],
        }
    }

    #[test]
    fn without_a_denominator_it_is_the_polynomial() {
        let numerator = Distortion::from_coefficients([-0.3, 0.1, 0.002, -0.001, -0.01]).unwrap();
        let lens = RationalDistortion {
            numerator,
            denominator: [0.0; 3],
        };
        let mut random = Random::new(1);
        for _ in 0..100 {
            let ray = Point2::new(random.uniform(-0.8, 0.8), random.uniform(-0.6, 0.6));
            assert!((lens.distort(&ray) - numerator.distort(&ray)).norm() < 1e-15);
            assert!((lens.jacobian(&ray) - numerator.jacobian(&ray)).norm() < 1e-14);
        }
    }

    /// From OpenCV 5.0's `projectPoints` with K = I and eight coefficients.
    #[test]
    fn agrees_with_another_implementation() {
        for (ray, distorted) in REFERENCE {
            let off = wide().distort(&Point2::from(ray)) - Point2::from(distorted);
            assert!(off.norm() < 1e-14, "{off}");
        }
    }

    const REFERENCE: [([f64; 2], [f64; 2]); 2] = [
        ([0.6, -0.4], [0.5017610202253185, -0.3346806801502124]),
        ([-0.5, 0.9], [-0.3447732610133518, 0.6178358698240333]),
    ];

    #[test]
    fn there_and_back_and_no_further_than_the_fold() {
        let mut random = Random::new(2);
        let fold = wide().fold_sq().sqrt();
        for _ in 0..500 {
            let reach = fold.min(2.0);
            let (r, a) = (random.uniform(0.0, 0.99) * reach, random.uniform(0.0, 6.3));
            let ray = Point2::new(r * libm::cos(a), r * libm::sin(a));
            match wide().undistort(&wide().distort(&ray)) {
                Ok(back) => assert!((back - ray).norm() < 1e-8, "{ray} {back}"),
                Err(error) => panic!("{ray}: {error}"),
            }
        }
        let folded = RationalDistortion {
            numerator: Distortion::NONE,
            denominator: [1.0, 0.0, 0.0],
        };
        // r/(1 + r²) is never more than 1/2.
        assert!((folded.fold_sq() - 1.0).abs() < 1e-9);
        assert!(folded.undistort(&Point2::new(0.51, 0.0)).is_err());
        assert!(folded.undistort(&Point2::new(f64::NAN, 0.0)).is_err());
    }
}
