//! Hartley's normalization of points.

use crate::{Error, Result};
use nalgebra::{Matrix3, Point2};

/// The map `x' = s (x − c)`, which moves points to the origin and scales them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Normalization {
    /// c, pixels.
    pub centroid: Point2<f64>,
    /// s, per pixel.
    pub scale: f64,
}

impl Normalization {
    /// Moves the centroid to the origin and scales the **root-mean-square** distance from it to √2.
    ///
    /// Some texts scale the mean distance instead; the results differ a little.
    ///
    /// # Errors
    /// [`Error::TooFew`] without points, [`Error::NotFinite`] for NaN and infinities,
    /// [`Error::Degenerate`] if all points are equal.
    ///
    /// Source: Hartley 1997, "In defense of the eight-point algorithm", §5.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::epipolar::Normalization;
    /// use nalgebra::Point2;
    /// let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
    /// let n = Normalization::new(&square.map(|(u, v)| Point2::new(u, v)))?;
    /// assert_eq!(n.centroid, Point2::new(2.0, 2.0));
    /// assert_eq!(n.scale, 0.5); // distances were √8
    /// # Ok(()) }
    /// ```
    pub fn new(points: &[Point2<f64>]) -> Result<Self> {
        if points.is_empty() {
            return Err(Error::TooFew {
                what: "a normalization of points",
                needed: 1,
                got: 0,
            });
        }
        let weight = 1.0 / points.len() as f64;
        let mut centroid = Point2::origin();
        for p in points {
            centroid += p.coords * weight;
        }
        let mut mean_sq = 0.0;
        for p in points {
            mean_sq += (p - centroid).norm_squared() * weight;
        }
        if !(centroid.x.is_finite() && centroid.y.is_finite() && mean_sq.is_finite()) {
            return Err(Error::NotFinite {
                what: "a point to be normalized",
            });
        }
        let rounding = 4.0 * f64::EPSILON * centroid.coords.norm();
        if mean_sq <= rounding * rounding || mean_sq <= f64::MIN_POSITIVE {
            return Err(Error::Degenerate {
                what: "a normalization of points",
                why: "all points are equal",
            });
        }
        Ok(Self {
            centroid,
            scale: (2.0 / mean_sq).sqrt(),
        })
    }

    /// Returns the identity map.
    pub fn identity() -> Self {
        Self {
            centroid: Point2::origin(),
            scale: 1.0,
        }
    }

    /// Maps a point.
    pub fn apply(&self, p: &Point2<f64>) -> Point2<f64> {
        Point2::from((p - self.centroid) * self.scale)
    }

    /// Returns the map as a 3×3 matrix T.
    #[rustfmt::skip]
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::new(
            self.scale, 0.0,        -self.scale * self.centroid.x,
            0.0,        self.scale, -self.scale * self.centroid.y,
            0.0,        0.0,        1.0,
        )
    }

    /// Returns T⁻¹.
    #[rustfmt::skip]
    pub fn inverse_matrix(&self) -> Matrix3<f64> {
        let size = 1.0 / self.scale;
        Matrix3::new(
            size, 0.0,  self.centroid.x,
            0.0,  size, self.centroid.y,
            0.0,  0.0,  1.0,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn root_mean_square_distance_is_root_two() {
        let mut random = Random::new(1);
        let points: Vec<_> = (0..20)
            .map(|_| Point2::new(random.uniform(0.0, 4000.0), random.uniform(500.0, 600.0)))
            .collect();
        let n = Normalization::new(&points).unwrap();
        let moved: Vec<_> = points.iter().map(|p| n.apply(p)).collect();
        let mean_sq: f64 = moved.iter().map(|p| p.coords.norm_squared()).sum::<f64>() / 20.0;
        assert!((mean_sq - 2.0).abs() < 1e-12);
        let back = n.inverse_matrix() * moved[3].to_homogeneous();
        assert!((back.xy() - points[3].coords).norm() < 1e-9);
        assert!((n.matrix() * n.inverse_matrix() - Matrix3::identity()).norm() < 1e-12);
    }

    #[test]
    fn degenerate_points_are_refused() {
        assert!(Normalization::new(&[]).is_err());
        assert!(Normalization::new(&[Point2::new(0.1, 0.7); 9]).is_err());
        assert!(Normalization::new(&[Point2::new(f64::NAN, 0.7)]).is_err());
        assert!(Normalization::new(&[Point2::new(f64::INFINITY, 0.7), Point2::origin()]).is_err());
    }
}
