//! Lines of the image plane.

use crate::{Error, Result};
use nalgebra::{Point2, Vector3};

/// Line `a u + b v + c = 0`, scaled so that `a² + b² = 1`.
///
/// With this scale `a u + b v + c` is the signed distance of (u, v) from the line: (a, b) is the
/// unit normal and points to the positive side.
///
/// Source: Hartley & Zisserman 2004, §2.2.1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line2 {
    /// Component of the normal along u.
    pub a: f64,
    /// Component of the normal along v.
    pub b: f64,
    /// Negated signed distance of the origin along the normal.
    pub c: f64,
}

impl Line2 {
    /// Creates the line through two points; its normal is the direction from `p` to `q`, rotated by
    /// 90° from u towards v.
    ///
    /// # Errors
    /// [`Error::Degenerate`] if the points are equal, [`Error::NotFinite`] for NaN and infinities.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::math::Line2;
    /// use nalgebra::Point2;
    /// let line = Line2::through(&Point2::new(0.0, 1.0), &Point2::new(5.0, 1.0))?;
    /// assert_eq!(line, Line2 { a: 0.0, b: 1.0, c: -1.0 });
    /// assert_eq!(line.signed_distance(&Point2::new(3.0, 4.0)), 3.0);
    /// # Ok(()) }
    /// ```
    pub fn through(p: &Point2<f64>, q: &Point2<f64>) -> Result<Self> {
        if ![p.x, p.y, q.x, q.y].into_iter().all(f64::is_finite) {
            return Err(Error::NotFinite {
                what: "a point of a line",
            });
        }
        let (du, dv) = (q.x - p.x, q.y - p.y);
        let length = libm::hypot(du, dv);
        if length <= 0.0 || !length.is_finite() {
            return Err(Error::Degenerate {
                what: "a line through two points",
                why: "the points are equal",
            });
        }
        let (a, b) = (-dv / length, du / length);
        // Measure the distance from the midpoint, so that swapping p and q only flips signs.
        let (mid_u, mid_v) = (0.5 * p.x + 0.5 * q.x, 0.5 * p.y + 0.5 * q.y);
        Ok(Self {
            a,
            b,
            c: -(a * mid_u + b * mid_v),
        })
    }

    /// Creates the line of the homogeneous vector (a, b, c), at any scale; the sign is kept.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for (0, 0, c), the line at infinity or no line, [`Error::NotFinite`]
    /// for NaN and infinities.
    pub fn from_homogeneous(line: &Vector3<f64>) -> Result<Self> {
        if !line.iter().all(|x| x.is_finite()) {
            return Err(Error::NotFinite {
                what: "a homogeneous line",
            });
        }
        let scale = libm::hypot(line.x, line.y);
        let normalized = Self {
            a: line.x / scale,
            b: line.y / scale,
            c: line.z / scale,
        };
        if scale > 0.0 && normalized.c.is_finite() && normalized.a.is_finite() {
            Ok(normalized)
        } else {
            Err(Error::Degenerate {
                what: "a line of the image",
                why: "it is infinitely far away",
            })
        }
    }

    /// Returns (a, b, c) as a homogeneous vector.
    pub fn homogeneous(&self) -> Vector3<f64> {
        Vector3::new(self.a, self.b, self.c)
    }

    /// Returns the distance of `point` from the line, positive on the side of the normal (a, b).
    pub fn signed_distance(&self, point: &Point2<f64>) -> f64 {
        self.a * point.x + self.b * point.y + self.c
    }

    /// Returns the point of the line nearest to `point`.
    pub fn nearest(&self, point: &Point2<f64>) -> Point2<f64> {
        let distance = self.signed_distance(point);
        Point2::new(point.x - distance * self.a, point.y - distance * self.b)
    }

    /// Returns the angle from the u axis to the line, towards v, in (−π/2, π/2].
    pub fn angle_rad(&self) -> f64 {
        if self.b == 0.0 {
            core::f64::consts::FRAC_PI_2
        } else {
            libm::atan(-self.a / self.b)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_rotates_from_u_towards_v() {
        let line = Line2::through(&Point2::new(0.0, 0.0), &Point2::new(1.0, 1.0)).unwrap();
        assert!(line.signed_distance(&Point2::new(0.0, 1.0)) > 0.0);
        assert!((line.angle_rad() - core::f64::consts::FRAC_PI_4).abs() < 1e-15);
        let foot = line.nearest(&Point2::new(0.0, 2.0));
        assert!((foot - Point2::new(1.0, 1.0)).norm() < 1e-15);
    }

    #[test]
    fn angles_stay_in_range() {
        for step in 0..36 {
            let angle = f64::from(step) * core::f64::consts::PI / 18.0;
            let q = Point2::new(libm::cos(angle), libm::sin(angle));
            let line = Line2::through(&Point2::origin(), &q).unwrap();
            let (lo, hi) = (-core::f64::consts::FRAC_PI_2, core::f64::consts::FRAC_PI_2);
            assert!(line.angle_rad() >= lo && line.angle_rad() <= hi);
            assert!(libm::sin(line.angle_rad() - angle).abs() < 1e-14);
        }
    }

    #[test]
    fn degenerate_lines_are_refused() {
        let p = Point2::new(3.0, 4.0);
        assert!(matches!(
            Line2::through(&p, &p),
            Err(Error::Degenerate { .. })
        ));
        assert!(Line2::through(&p, &Point2::new(f64::NAN, 0.0)).is_err());
        assert!(Line2::from_homogeneous(&Vector3::new(0.0, 0.0, 1.0)).is_err());
        assert!(Line2::from_homogeneous(&Vector3::zeros()).is_err());
        let line = Line2::from_homogeneous(&Vector3::new(-3.0, 4.0, 10.0)).unwrap();
        assert_eq!((line.a, line.b, line.c), (-0.6, 0.8, 2.0));
    }
}
