//! Lens distortion by a single parameter, for strong distortion.

use crate::{Error, Result};
use nalgebra::{Matrix2, Point2};

/// Division model of distortion: a point imaged at distance r from the center lies on the ray at
/// `r / (1 + k r²)`. The parameter, negative for barrel distortion, also suits wide-angle lenses,
/// and both directions have closed forms.
///
/// Source: Fitzgibbon 2001, "Simultaneous linear estimation of multiple view geometry and lens
/// distortion", §2.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Division {
    /// Coefficient of r² in the divisor.
    pub k: f64,
}

impl Division {
    /// Returns √(1 − 4 k r²), which is NaN if the ray is not seen.
    fn root(&self, ray: &Point2<f64>) -> f64 {
        (1.0 - 4.0 * self.k * ray.coords.norm_squared()).sqrt()
    }

    /// Returns the distorted position of the ray (x, y, 1), in normalized coordinates; NaN if it is
    /// not seen.
    ///
    /// ```
    /// use epipole::camera::Division;
    /// use nalgebra::Point2;
    /// let lens = Division { k: -0.75 };
    /// // At a distance of 1 is the ray at 1 / (1 − 0.75) = 4.
    /// assert!((lens.distort(&Point2::new(4.0, 0.0)) - Point2::new(1.0, 0.0)).norm() < 1e-15);
    /// ```
    pub fn distort(&self, ray: &Point2<f64>) -> Point2<f64> {
        ray * (2.0 / (1.0 + self.root(ray)))
    }

    /// Returns the derivative of [`distort`](Self::distort), rows x', y', columns x, y.
    pub fn jacobian(&self, ray: &Point2<f64>) -> Matrix2<f64> {
        let root = self.root(ray);
        // Derivative of the factor 2 / (1 + √(1 − 4 k r²)) by r².
        let slope = 4.0 * self.k / (root * (1.0 + root) * (1.0 + root));
        let outer = ray.coords * ray.coords.transpose();
        Matrix2::from_diagonal_element(2.0 / (1.0 + root)) + outer * (2.0 * slope)
    }

    /// Returns the derivative of [`distort`](Self::distort) by k: of x' and of y'.
    pub fn by_k(&self, ray: &Point2<f64>) -> [f64; 2] {
        let root = self.root(ray);
        let slope = 4.0 * ray.coords.norm_squared() / (root * (1.0 + root) * (1.0 + root));
        [ray.x * slope, ray.y * slope]
    }

    /// Returns the ray (x, y, 1) imaged at a distorted position.
    ///
    /// # Errors
    /// [`Error::Degenerate`] if there is no ray: beyond `1 / √|k|`, where rays are perpendicular to
    /// the axis (barrel) or the model folds (pincushion). [`Error::NotFinite`] for NaN and
    /// infinities.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Division;
    /// use nalgebra::Point2;
    /// let ray = Division { k: -0.75 }.undistort(&Point2::new(0.0, 1.0))?;
    /// assert_eq!(ray, Point2::new(0.0, 4.0));
    /// # Ok(()) }
    /// ```
    pub fn undistort(&self, distorted: &Point2<f64>) -> Result<Point2<f64>> {
        if !(distorted.x.is_finite() && distorted.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "the distorted place",
            });
        }
        let bent = self.k * distorted.coords.norm_squared();
        if bent.abs() >= 1.0 {
            return Err(Error::Degenerate {
                what: "the ray of a distorted pixel",
                why: "the lens model bends no ray to it",
            });
        }
        Ok(distorted / (1.0 + bent))
    }

    /// Returns whether the ray through (x, y, 1) is seen.
    pub(crate) fn is_visible(&self, ray: &Point2<f64>) -> bool {
        self.root(ray) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn there_and_back_and_not_beyond() {
        let mut random = Random::new(2);
        for k in [-0.6, -1e-9, 0.0, 0.2] {
            let lens = Division { k };
            for _ in 0..200 {
                let ray = Point2::new(random.uniform(-1.0, 1.0), random.uniform(-0.4, 0.4));
                assert!(lens.is_visible(&ray));
                let distorted = lens.distort(&ray);
                assert!(
                    (lens.undistort(&distorted).unwrap() - ray).norm() < 1e-12,
                    "{k} {ray}"
                );
                // Fitzgibbon's formula, verbatim.
                let r_sq = distorted.coords.norm_squared();
                assert!((distorted / (1.0 + k * r_sq) - ray).norm() < 1e-12);
            }
        }
        // A pincushion folds where 4 k r² = 1.
        let cushion = Division { k: 0.25 };
        assert!(
            cushion.is_visible(&Point2::new(0.99, 0.0))
                && !cushion.is_visible(&Point2::new(1.0, 0.0))
        );
        for k in [-0.25, 0.25] {
            let lens = Division { k };
            assert!(matches!(
                lens.undistort(&Point2::new(2.0, 0.0)),
                Err(Error::Degenerate { .. })
            ));
            assert!(lens.undistort(&Point2::new(1.99, 0.0)).is_ok());
        }
        assert!(cushion.undistort(&Point2::new(f64::NAN, 0.0)).is_err());
    }
}
