//! Distances of matches from an epipolar geometry.

use crate::math::scaling::power_of_two;
use nalgebra::{Matrix3, Point2, Vector2, Vector3};

/// The algebraic error `x2ᵀ F x1` and the normals of both epipolar lines.
#[derive(Clone, Copy)]
struct Parts {
    error: f64,
    /// F x1 without the third entry.
    line2: Vector2<f64>,
    /// Fᵀ x2 without the third entry.
    line1: Vector2<f64>,
}

impl Parts {
    fn new(fundamental: &Matrix3<f64>, x1: &Vector3<f64>, x2: &Vector3<f64>) -> Self {
        let line2 = fundamental * x1;
        let line1 = fundamental.transpose() * x2;
        Self {
            error: x2.x * line2.x + x2.y * line2.y + x2.z * line2.z,
            line2: line2.xy(),
            line1: line1.xy(),
        }
    }

    /// Returns |F x1|² and |Fᵀ x2|², both without the third entry.
    fn along_sq(&self) -> (f64, f64) {
        (self.line2.norm_squared(), self.line1.norm_squared())
    }

    fn sampson_sq(&self) -> f64 {
        let (along2, along1) = self.along_sq();
        self.error * self.error / (along2 + along1)
    }

    fn symmetric_sq(&self) -> f64 {
        let (along2, along1) = self.along_sq();
        // A pixel at the epipole satisfies the constraint with any other pixel, so a single 0/0
        // counts as 0. With both lines 0/0 it does not, as the match is no evidence.
        let distance_sq = |along_sq: f64| {
            if self.error == 0.0 && along2 + along1 > 0.0 {
                0.0
            } else {
                self.error * self.error / along_sq
            }
        };
        0.5 * (distance_sq(along1) + distance_sq(along2))
    }
}

/// A distance as root and factor, so that its square may exceed the range of numbers.
#[derive(Clone, Copy)]
struct Distance {
    root_sq: f64,
    factor: f64,
}

impl Distance {
    /// Computes a distance by applying `distance_sq` to the parts of the constraint.
    #[inline]
    fn new(
        fundamental: &Matrix3<f64>,
        pixel1: &Point2<f64>,
        pixel2: &Point2<f64>,
        distance_sq: impl Fn(&Parts) -> f64,
    ) -> Self {
        let (x1, x2) = (pixel1.to_homogeneous(), pixel2.to_homogeneous());
        let parts = Parts::new(fundamental, &x1, &x2);
        let (along2, along1) = parts.along_sq();
        let squares = [parts.error * parts.error, along2, along1];
        if squares.iter().all(|x| x.is_normal()) {
            return Self {
                root_sq: distance_sq(&parts),
                factor: 1.0,
            };
        }
        // Squares may overflow or underflow, so sizes are factored out first. The scale of F does
        // not matter; the distance of pixels is in units of their size.
        let size = power_of_two(x1.amax().max(x2.amax()));
        let parts = Parts::new(
            &(fundamental / power_of_two(fundamental.amax())),
            &(x1 / size),
            &(x2 / size),
        );
        let slope = power_of_two(parts.line1.amax().max(parts.line2.amax()));
        let error = power_of_two(parts.error);
        Self {
            root_sq: distance_sq(&Parts {
                error: parts.error / error,
                line2: parts.line2 / slope,
                line1: parts.line1 / slope,
            }),
            factor: error / slope * size,
        }
    }

    fn px(&self) -> f64 {
        infinite_if_undefined(self.root_sq.sqrt() * self.factor)
    }

    fn sq(&self) -> f64 {
        infinite_if_undefined(self.root_sq * self.factor * self.factor)
    }
}

fn infinite_if_undefined(distance: f64) -> f64 {
    if distance.is_nan() {
        f64::INFINITY
    } else {
        distance
    }
}

/// Returns the square of [`sampson_px`], px².
pub(crate) fn sampson_sq(
    fundamental: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    Distance::new(fundamental, pixel1, pixel2, Parts::sampson_sq).sq()
}

/// Computes the Sampson distance: the first-order length of the correction, in both images
/// together, that makes a match satisfy the constraint, `|x2ᵀ F x1| / √(|F x1|²₁₂ + |Fᵀ x2|²₁₂)`,
/// pixels.
///
/// `|·|₁₂` is the length of the first two entries. The scale of F does not matter.
///
/// Infinite for a match that no small correction makes consistent, and for NaN and infinities. Also
/// infinite for a match of the two epipoles: it satisfies the constraint for any F with these
/// epipoles, so it must not support a model. There the expression is 0/0.
///
/// Source: Sampson 1982; Hartley & Zisserman 2004, equation 11.9, which is undefined if both points
/// are epipoles.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{essential_from_motion, sampson_px, symmetric_epipolar_px};
/// use nalgebra::Point2;
/// // A step to the right: rows must agree. Here they differ by 2.
/// let f = essential_from_motion(&RigidTransform::translation(-1.0, 0.0, 0.0))?;
/// let (x1, x2) = (Point2::new(5.0, 3.0), Point2::new(1.0, 5.0));
/// // Each point moves by 1: √(1² + 1²).
/// assert!((sampson_px(&f, &x1, &x2) - 2.0_f64.sqrt()).abs() < 1e-12);
/// assert!((symmetric_epipolar_px(&f, &x1, &x2) - 2.0).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn sampson_px(fundamental: &Matrix3<f64>, pixel1: &Point2<f64>, pixel2: &Point2<f64>) -> f64 {
    Distance::new(fundamental, pixel1, pixel2, Parts::sampson_sq).px()
}

/// Computes the root mean square distance of both points from their epipolar lines:
/// `√(½ (d(x2, F x1)² + d(x1, Fᵀ x2)²))`, pixels.
///
/// More intuitive than [`sampson_px`], but not suited for minimization. Infinite where that is; if
/// only one pixel is an epipole, the match fits and the distance is 0.
///
/// Source: Hartley & Zisserman 2004, §11.4.3; we take the root mean square, for a result in pixels.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::camera::RigidTransform;
/// use epipole::epipolar::{essential_from_motion, symmetric_epipolar_px};
/// use nalgebra::Point2;
/// // Straight ahead: lines pass through the middle. (3, 4) is on one with slope 4/3, and the line
/// // of (1, 0) is the row 0: distances 0.8 and 4.
/// let f = essential_from_motion(&RigidTransform::translation(0.0, 0.0, -1.0))?;
/// let distance_px = symmetric_epipolar_px(&f, &Point2::new(1.0, 0.0), &Point2::new(3.0, 4.0));
/// assert!((distance_px - ((0.8 * 0.8 + 4.0 * 4.0) / 2.0_f64).sqrt()).abs() < 1e-12);
/// # Ok(()) }
/// ```
pub fn symmetric_epipolar_px(
    fundamental: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    Distance::new(fundamental, pixel1, pixel2, Parts::symmetric_sq).px()
}

#[cfg(test)]
mod tests {
    use super::super::coordinates::Coordinates;
    use super::super::from_cameras::tests::{random_cameras, random_point};
    use super::super::fundamental_from_cameras;
    use super::super::sampson::support;
    use super::super::{epipolar_line1, epipolar_line2, essential_from_motion};
    use super::*;
    use crate::camera::RigidTransform;
    use crate::math::random::Random;
    use crate::robust::MatchSet;

    /// COLMAP's src/colmap/geometry/essential_matrix_test.cc: squared Sampson errors 0, 0.5 and 2.
    #[test]
    fn published_squared_errors() {
        let e = essential_from_motion(&RigidTransform::translation(1.0, 0.0, 0.0)).unwrap();
        let x1 = Point2::new(0.0, 0.0);
        for (v2, expected) in [(0.0, 0.0), (1.0, 0.5), (2.0, 2.0)] {
            assert_eq!(sampson_sq(&e, &x1, &Point2::new(2.0, v2)), expected);
        }
    }

    #[test]
    fn symmetric_distance_is_the_distance_from_both_lines() {
        let mut random = Random::new(1);
        let (cam1, cam2) = random_cameras(&mut random);
        let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
        for _ in 0..50 {
            let point = random_point(&mut random);
            let x1 = cam1.project(&point).unwrap();
            let x2 = cam2.project(&point).unwrap()
                + Vector2::new(random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0));
            let d1 = epipolar_line1(&f, &x2).unwrap().signed_distance(&x1);
            let d2 = epipolar_line2(&f, &x1).unwrap().signed_distance(&x2);
            let expected = ((d1 * d1 + d2 * d2) / 2.0).sqrt();
            assert!((symmetric_epipolar_px(&f, &x1, &x2) - expected).abs() < 1e-9);
        }
    }

    /// The Sampson error is the length of the smallest correction of a small error.
    #[test]
    fn sampson_is_the_smallest_movement() {
        let mut random = Random::new(2);
        let (cam1, cam2) = random_cameras(&mut random);
        let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
        for _ in 0..50 {
            let point = random_point(&mut random);
            let (x1, x2) = (cam1.project(&point).unwrap(), cam2.project(&point).unwrap());
            // The gradient of the constraint is the shortest way off the geometry.
            let g2 = (f * x1.to_homogeneous()).xy();
            let g1 = (f.transpose() * x2.to_homogeneous()).xy();
            let length = (g1.norm_squared() + g2.norm_squared()).sqrt();
            let (m1, m2) = (x1 + g1 * (0.01 / length), x2 + g2 * (0.01 / length));
            assert!((sampson_px(&f, &m1, &m2) - 0.01).abs() < 1e-5);
        }
    }

    /// The public distance and the scoring kernel must agree on a match.
    #[test]
    fn a_match_of_both_epipoles_supports_nothing() {
        let ahead = essential_from_motion(&RigidTransform::translation(0.0, 0.0, 1.0)).unwrap();
        let (o, off) = (Point2::origin(), Point2::new(3.0, 1.0));
        let kernel = |f: &Matrix3<f64>, x1: Point2<f64>, x2: Point2<f64>| {
            let matches = MatchSet::new(&[x1], &[x2]).unwrap();
            support(&Coordinates::pixels(&matches), f, 1.0, f64::INFINITY).num_inliers
        };
        for (f, x1, x2, fits) in [
            (ahead, o, o, false),
            (ahead, o, off, true),
            (ahead, off, o, true),
            (Matrix3::zeros(), off, off, false),
        ] {
            let expected = if fits { 0.0 } else { f64::INFINITY };
            assert_eq!(sampson_px(&f, &x1, &x2), expected);
            assert_eq!(symmetric_epipolar_px(&f, &x1, &x2), expected);
            assert_eq!(kernel(&f, x1, x2), usize::from(fits));
        }
        let nan = Point2::new(f64::NAN, 0.0);
        assert_eq!(sampson_px(&ahead, &nan, &off), f64::INFINITY);
        assert_eq!(symmetric_epipolar_px(&ahead, &off, &nan), f64::INFINITY);
    }

    /// The images of the doctest, scaled to the limits of floating point.
    #[test]
    fn sizes_beyond_the_range_of_squares() {
        let right = essential_from_motion(&RigidTransform::translation(-1.0, 0.0, 0.0)).unwrap();
        for size in [1e-300, 1e-160, 1e-9, 1.0, 1e9, 1e160, 1e300] {
            let x1 = Point2::new(5.0, 3.0) * size;
            let x2 = Point2::new(1.0, 5.0) * size;
            for scale in [1e-300, 1.0, 1e300] {
                let f = right * scale;
                // The square may overflow, but is never NaN.
                assert!(sampson_sq(&f, &x1, &x2) >= 0.0);
                let sampson = sampson_px(&f, &x1, &x2) / (2.0_f64.sqrt() * size);
                assert!((sampson - 1.0).abs() < 1e-9, "{size} {scale}: {sampson}");
                let symmetric = symmetric_epipolar_px(&f, &x1, &x2) / (2.0 * size);
                assert!(
                    (symmetric - 1.0).abs() < 1e-9,
                    "{size} {scale}: {symmetric}"
                );
            }
        }
    }
}
