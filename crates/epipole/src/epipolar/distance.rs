//! How far a match is from an epipolar geometry.

use nalgebra::{Matrix3, Point2};

/// The algebraic error `x2ᵀ F x1` and the parts of both epipolar lines that have a direction:
/// (error, |F x1|² without the third entry, |Fᵀ x2|² without the third entry).
fn parts(
    fundamental: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> (f64, f64, f64) {
    let line2 = fundamental * pixel1.to_homogeneous();
    let line1 = fundamental.transpose() * pixel2.to_homogeneous();
    let error = pixel2.x * line2.x + pixel2.y * line2.y + line2.z;
    (
        error,
        line2.x * line2.x + line2.y * line2.y,
        line1.x * line1.x + line1.y * line1.y,
    )
}

/// 0/0 counts as 0: a match of the two epipoles fits every epipolar geometry.
fn ratio(numerator: f64, denominator: f64) -> f64 {
    if numerator == 0.0 {
        0.0
    } else {
        numerator / denominator
    }
}

/// The square of [`sampson_px`], px².
pub fn sampson_sq(fundamental: &Matrix3<f64>, pixel1: &Point2<f64>, pixel2: &Point2<f64>) -> f64 {
    let (error, along2, along1) = parts(fundamental, pixel1, pixel2);
    ratio(error * error, along1 + along2)
}

/// How far a match must be moved, in both images together, to satisfy the constraint, to first
/// order: `|x2ᵀ F x1| / √(|F x1|²₁₂ + |Fᵀ x2|²₁₂)`, pixels.
///
/// `|·|₁₂` is the length of the first two entries. The scale of F does not matter. Infinite for a
/// match that no small movement can mend.
///
/// Source: Sampson 1982; Hartley & Zisserman 2004, equation 11.9.
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
    sampson_sq(fundamental, pixel1, pixel2).sqrt()
}

/// The square of [`symmetric_epipolar_px`], px².
pub fn symmetric_epipolar_sq(
    fundamental: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    let (error, along2, along1) = parts(fundamental, pixel1, pixel2);
    let error_sq = error * error;
    0.5 * (ratio(error_sq, along1) + ratio(error_sq, along2))
}

/// The distances of both points from their epipolar lines, as a root mean square:
/// `√(½ (d(x2, F x1)² + d(x1, Fᵀ x2)²))`, pixels.
///
/// Easier to picture than [`sampson_px`], but not what one should minimize.
///
/// Source: Hartley & Zisserman 2004, §11.4.3; the root mean square is ours, so that it is in
/// pixels.
pub fn symmetric_epipolar_px(
    fundamental: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    symmetric_epipolar_sq(fundamental, pixel1, pixel2).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::from_cameras::tests::{random_cameras, random_point};
    use super::super::fundamental_from_cameras;
    use super::super::{epipolar_line1, epipolar_line2, essential_from_motion};
    use super::*;
    use crate::camera::RigidTransform;
    use crate::math::random::Random;
    use nalgebra::Vector2;

    /// COLMAP's essential_matrix_test: squared Sampson errors 0, 0.5 and 2.
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

    /// The Sampson error is the length of the smallest movement that mends a small error.
    #[test]
    fn sampson_is_the_smallest_movement() {
        let mut random = Random::new(2);
        let (cam1, cam2) = random_cameras(&mut random);
        let f = fundamental_from_cameras(&cam1, &cam2).unwrap();
        for _ in 0..50 {
            let point = random_point(&mut random);
            let (x1, x2) = (cam1.project(&point).unwrap(), cam2.project(&point).unwrap());
            // Moving along the gradient of the constraint is the direct way off the geometry.
            let g2 = (f * x1.to_homogeneous()).xy();
            let g1 = (f.transpose() * x2.to_homogeneous()).xy();
            let length = (g1.norm_squared() + g2.norm_squared()).sqrt();
            let (m1, m2) = (x1 + g1 * (0.01 / length), x2 + g2 * (0.01 / length));
            assert!((sampson_px(&f, &m1, &m2) - 0.01).abs() < 1e-5);
        }
    }
}
