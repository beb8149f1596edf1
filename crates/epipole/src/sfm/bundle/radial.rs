//! The lens distortion that the cameras of a bundle share.

use nalgebra::Point2;

/// Radial distortion: the normalized point p is moved to `(1 + k1 ‖p‖² + k2 ‖p‖⁴) p`.
///
/// Source: Brown 1971, "Close-range camera calibration", the first two radial terms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RadialDistortion {
    /// Factor of ‖p‖².
    pub k1: f64,
    /// Factor of ‖p‖⁴.
    pub k2: f64,
}

impl RadialDistortion {
    /// Whether the lens is a perfect pinhole.
    pub fn is_none(&self) -> bool {
        self.k1 == 0.0 && self.k2 == 0.0
    }

    /// Moves a normalized point (x/z, y/z) to where the lens shows it.
    pub fn distort(&self, normalized: &Point2<f64>) -> Point2<f64> {
        let r_sq = normalized.coords.norm_squared();
        normalized * (1.0 + r_sq * (self.k1 + r_sq * self.k2))
    }

    /// The normalized point that [`distort`](Self::distort) moves to `distorted`.
    ///
    /// Newton's method on the radius. Where the distortion is so strong that no radius or
    /// several fit, the result is the nearest stage of the search; it is always finite.
    pub fn undistort(&self, distorted: &Point2<f64>) -> Point2<f64> {
        let wanted = distorted.coords.norm();
        if self.is_none() || wanted == 0.0 {
            return *distorted;
        }
        let mut radius = wanted;
        for _ in 0..20 {
            let r_sq = radius * radius;
            let value = radius * (1.0 + r_sq * (self.k1 + r_sq * self.k2)) - wanted;
            let slope = 1.0 + r_sq * (3.0 * self.k1 + 5.0 * r_sq * self.k2);
            if slope < 0.1 {
                break;
            }
            let step = value / slope;
            radius = (radius - step).max(0.0);
            if step.abs() <= 1e-15 * wanted {
                break;
            }
        }
        distorted * (radius / wanted)
    }
}

/// The distortion's factor at a normalized point, and its Jacobian times the point.
pub(in crate::sfm) struct RadialTerms {
    pub(in crate::sfm) r_sq: f64,
    pub(in crate::sfm) factor: f64,
    /// ∂(factor p)/∂p.
    pub(in crate::sfm) jacobian: [[f64; 2]; 2],
}

#[inline]
pub(in crate::sfm) fn radial_terms(p: [f64; 2], k1: f64, k2: f64) -> RadialTerms {
    let [x, y] = p;
    let r_sq = x * x + y * y;
    let factor = 1.0 + r_sq * (k1 + r_sq * k2);
    let slope = 2.0 * (k1 + 2.0 * k2 * r_sq);
    RadialTerms {
        r_sq,
        factor,
        jacobian: [
            [factor + slope * x * x, slope * x * y],
            [slope * x * y, factor + slope * y * y],
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undistorting_undoes_distorting() {
        let lens = RadialDistortion { k1: -0.2, k2: 0.05 };
        for (x, y) in [(0.0, 0.0), (0.3, -0.2), (0.7, 0.6)] {
            let p = Point2::new(x, y);
            assert!((lens.undistort(&lens.distort(&p)) - p).norm() < 1e-14);
        }
        let absurd = RadialDistortion { k1: -50.0, k2: 0.0 };
        let p = absurd.undistort(&Point2::new(3.0, 4.0));
        assert!(p.x.is_finite() && p.y.is_finite());
    }
}
