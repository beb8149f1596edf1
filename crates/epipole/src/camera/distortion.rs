//! Lens distortion by the model of Brown and Conrady.

use super::unbend::{RESIDUAL, descend, radial_start};
use crate::math::polynomial::cubic_roots;
use crate::{Error, Result};
use nalgebra::{Matrix2, Point2};

/// Brown–Conrady distortion: radial terms k1, k2, k3 and tangential terms p1, p2.
///
/// A ray through (x, y, 1) is imaged at (x', y'), with r² = x² + y²:
///
/// * `x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²)`
/// * `y' = y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2 y²) + 2 p2 x y`
///
/// The pixel is then `u = fu x' + cu`, `v = fv y' + cv`. These are OpenCV's first five
/// coefficients, in the order k1, k2, p1, p2, k3.
///
/// Sources: Conrady 1919, "Decentred lens-systems"; Brown 1966, "Decentering distortion of
/// lenses".
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Distortion {
    /// Coefficient of r².
    pub k1: f64,
    /// Coefficient of r⁴.
    pub k2: f64,
    /// Tangential coefficient, mostly along y.
    pub p1: f64,
    /// Tangential coefficient, mostly along x.
    pub p2: f64,
    /// Coefficient of r⁶.
    pub k3: f64,
}

impl Distortion {
    /// No distortion.
    pub const NONE: Self = Self {
        k1: 0.0,
        k2: 0.0,
        p1: 0.0,
        p2: 0.0,
        k3: 0.0,
    };

    /// Creates the model from `[k1, k2, p1, p2, k3]`, OpenCV's order.
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

    /// Returns whether there is no distortion.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Returns the distorted position of the ray (x, y, 1), in normalized coordinates.
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

    /// Returns the derivative of [`Distortion::distort`], rows x', y', columns x, y.
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

    /// Returns the ray (x, y, 1) imaged at a distorted position: the inverse of
    /// [`Distortion::distort`], by Newton steps from the center outward.
    ///
    /// Strong distortion folds the plane: beyond some radius a position is the image of two rays,
    /// or of none. The result lies inside the fold, where the lens model is meaningful.
    ///
    /// # Errors
    /// [`Error::Degenerate`] if no ray inside the fold is imaged there, [`Error::NotFinite`] for
    /// NaN or infinities.
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
    pub fn undistort(&self, distorted: &Point2<f64>) -> Result<Point2<f64>> {
        if !(distorted.x.is_finite() && distorted.y.is_finite()) {
            return Err(Error::NotFinite {
                what: "the distorted place",
            });
        }
        if self.is_none() {
            return Ok(*distorted);
        }
        let unseen = Error::Degenerate {
            what: "the ray of a distorted pixel",
            why: "the lens model bends no ray to it",
        };
        let fold_sq = self.fold_sq();
        let answers = |(ray, error): &(Point2<f64>, f64)| {
            // Rounding may stop it a little early, but never far from the solution.
            *error <= 1e3 * RESIDUAL * (1.0 + distorted.coords.norm())
                && ray.coords.norm_squared() < fold_sq
        };
        // Near the fold the position itself is the best initial value.
        let quick = self.descend(distorted, *distorted, f64::INFINITY);
        if answers(&quick) {
            return Ok(quick.0);
        }
        // Newton's method may have jumped over the fold.
        let inside = self.descend(distorted, self.radial_start(distorted, fold_sq), fold_sq);
        if answers(&inside) {
            Ok(inside.0)
        } else {
            Err(unseen)
        }
    }

    /// As [`undistort`](Self::undistort), but a position beyond the range of the lens model gives
    /// the ray at the fold imaged closest to it. For drawing up to the border of an image, where
    /// the model was not calibrated, not for measuring.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for NaN or infinities.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::camera::Distortion;
    /// use nalgebra::Point2;
    /// let barrel = Distortion { k1: -0.2, ..Distortion::NONE };
    /// // x (1 − 0.2 x²) is greatest at x = √(5/3).
    /// let ray = barrel.undistort_nearest(&Point2::new(0.9, 0.0))?;
    /// assert!((ray.x - (5.0_f64 / 3.0).sqrt()).abs() < 1e-6 && ray.y == 0.0);
    /// # Ok(()) }
    /// ```
    pub fn undistort_nearest(&self, distorted: &Point2<f64>) -> Result<Point2<f64>> {
        match self.undistort(distorted) {
            Err(Error::Degenerate { .. }) => {
                let fold_sq = self.fold_sq();
                let start = self.radial_start(distorted, fold_sq);
                Ok(self.descend(distorted, start, fold_sq).0)
            }
            answer => answer,
        }
    }

    fn descend(
        &self,
        distorted: &Point2<f64>,
        start: Point2<f64>,
        fold_sq: f64,
    ) -> (Point2<f64>, f64) {
        descend(
            distorted,
            start,
            fold_sq,
            |ray| self.distort(ray),
            |ray| self.jacobian(ray),
        )
    }

    fn radial_start(&self, distorted: &Point2<f64>, fold_sq: f64) -> Point2<f64> {
        radial_start(distorted, fold_sq, |r| {
            let s = r * r;
            r * (1.0 + s * (self.k1 + s * (self.k2 + s * self.k3)))
        })
    }

    /// Returns the squared radius at which the radial part stops growing; infinite if it never
    /// does.
    fn fold_sq(&self) -> f64 {
        // d/dr of r (1 + k1 r² + k2 r⁴ + k3 r⁶), in r².
        let slope = [1.0, 3.0 * self.k1, 5.0 * self.k2, 7.0 * self.k3];
        let mut roots = [0.0; 3];
        let count = cubic_roots(slope, &mut roots);
        roots[..count]
            .iter()
            .filter(|s| **s > 0.0)
            .fold(f64::INFINITY, |least, s| least.min(*s))
    }

    /// Returns whether the ray lies inside the fold: the radial part grows all the way to it.
    pub(crate) fn is_visible(&self, ray: &Point2<f64>) -> bool {
        ray.coords.norm_squared() < self.fold_sq()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// Coefficients of a real wide-angle camera.
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
        for (distortion, ray, distorted) in reference_points() {
            assert!((distortion.distort(&ray) - distorted).norm() < 1e-14);
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

    /// Inverts lenses of every kind, many with folds: each ray inside the fold is recovered, and no
    /// result is beyond it, even for a fold so narrow that few steps would hit it.
    #[test]
    fn every_ray_inside_the_fold_comes_back() {
        let mut random = Random::new(3);
        let mut num_folded = 0;
        for _ in 0..2000 {
            let lens = Distortion::from_coefficients([
                random.uniform(-0.6, 0.6),
                random.uniform(-0.4, 0.4),
                0.0,
                0.0,
                random.uniform(-0.2, 0.2),
            ])
            .unwrap();
            let fold = lens.fold_sq().sqrt();
            num_folded += usize::from(fold.is_finite());
            let reach = fold.min(3.0);
            for _ in 0..10 {
                let (radius, angle) = (
                    0.999 * reach * random.uniform(0.0, 1.0),
                    random.uniform(0.0, core::f64::consts::TAU),
                );
                let ray = Point2::new(radius * libm::cos(angle), radius * libm::sin(angle));
                let distorted = lens.distort(&ray);
                let back = lens.undistort(&distorted).unwrap();
                assert!(
                    (back - ray).norm() < 1e-7,
                    "{lens:?}: {ray} came back as {back}"
                );
                assert_eq!(lens.undistort_nearest(&distorted).unwrap(), back);
                let anywhere = distorted * random.uniform(0.5, 4.0);
                match lens.undistort(&anywhere) {
                    Ok(ray) => {
                        assert!(ray.coords.norm() < fold);
                        assert!((lens.distort(&ray) - anywhere).norm() < 1e-9);
                    }
                    Err(_) => {
                        let ray = lens.undistort_nearest(&anywhere).unwrap();
                        assert!((ray.coords.norm() / fold - 1.0).abs() < 1e-6, "{lens:?}");
                        assert!(ray.coords.dot(&anywhere.coords) > 0.0);
                    }
                }
            }
        }
        assert!(num_folded > 500, "{num_folded}");
        // 1 − 3.98 s + 3.96 s² is negative only for s from 0.5 to 0.505.
        let narrow =
            Distortion::from_coefficients([-3.98 / 3.0, 3.96 / 5.0, 0.0, 0.0, 0.0]).unwrap();
        let beyond = Point2::new(3.0, 0.0);
        assert!(!narrow.is_visible(&beyond));
        assert!(narrow.undistort(&narrow.distort(&beyond)).is_err());
    }
}
