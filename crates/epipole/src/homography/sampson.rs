//! The Sampson error of H: how far both pixels of a match are from fitting exactly.

use nalgebra::{Matrix2, Matrix2x4, Matrix3, Point2, Vector2, Vector3};

/// The square of [`homography_sampson_px`], px².
pub fn homography_sampson_sq(
    homography: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    let h = homography;
    let x = h * Vector3::new(pixel1.x, pixel1.y, 1.0);
    let (u2, v2) = (pixel2.x, pixel2.y);
    // The constraint is x − z (u2, v2) = 0; it is divided by z, so that entries of H of any size do.
    let per_z = 1.0 / x.z;
    let constraint = Vector2::new(x.x * per_z - u2, x.y * per_z - v2);
    let jacobian = Matrix2x4::new(
        (h[(0, 0)] - u2 * h[(2, 0)]) * per_z,
        (h[(0, 1)] - u2 * h[(2, 1)]) * per_z,
        -1.0,
        0.0,
        (h[(1, 0)] - v2 * h[(2, 0)]) * per_z,
        (h[(1, 1)] - v2 * h[(2, 1)]) * per_z,
        0.0,
        -1.0,
    );
    let spread: Matrix2<f64> = jacobian * jacobian.transpose();
    // The product is the identity and more, so it has an inverse unless H sends the pixel away.
    let error_sq = spread.try_inverse().map_or(f64::INFINITY, |inverse| {
        constraint.dot(&(inverse * constraint))
    });
    if error_sq.is_nan() {
        f64::INFINITY
    } else {
        error_sq
    }
}

/// How far, in first order, the two pixels of a match must move together so that H maps one on the
/// other: the length of the smallest change of (u1, v1, u2, v2), pixels.
///
/// Unlike [`transfer_error_px`](super::transfer_error_px) it treats both images alike: for noise of
/// the same size in both, its square divided by the variance has two degrees of freedom, whatever H
/// does to lengths. Infinite if H sends the pixel infinitely far away.
///
/// Source: Hartley & Zisserman 2004, §4.2.6.
///
/// ```
/// use epipole::homography::{homography_sampson_px, transfer_error_px};
/// use nalgebra::{Matrix3, Point2};
/// // H doubles lengths: an offset of 5 in image 2 is made up by moving (−2, 1) and both pixels share it.
/// let h = Matrix3::from_diagonal(&nalgebra::Vector3::new(2.0, 2.0, 1.0));
/// let (x1, x2) = (Point2::new(10.0, 20.0), Point2::new(25.0, 40.0));
/// assert_eq!(transfer_error_px(&h, &x1, &x2), 5.0);
/// assert!((homography_sampson_px(&h, &x1, &x2) - 5.0_f64.sqrt()).abs() < 1e-12);
/// ```
pub fn homography_sampson_px(
    homography: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    homography_sampson_sq(homography, pixel1, pixel2).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::transfer;
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn it_is_the_length_of_the_smallest_change() {
        let mut random = Random::new(1);
        let h = Matrix3::new(1.2, -0.1, 40.0, 0.2, 0.9, -30.0, 2e-4, -1e-4, 1.0);
        for _ in 0..100 {
            let x1 = Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0));
            let mut x2 = transfer(&h, &x1).unwrap();
            assert!(homography_sampson_px(&h, &x1, &x2) < 1e-9);
            x2.x += 0.3 * random.normal();
            x2.y += 0.3 * random.normal();
            // Gauss–Newton over where the first pixel should have been.
            let mut p = x1;
            for _ in 0..20 {
                let at = |p: &Point2<f64>| {
                    let q = transfer(&h, p).unwrap();
                    [p.x - x1.x, p.y - x1.y, q.x - x2.x, q.y - x2.y]
                };
                let step = 1e-4;
                let residual = nalgebra::Vector4::from(at(&p));
                let column = |du: f64, dv: f64| {
                    (nalgebra::Vector4::from(at(&Point2::new(p.x + du, p.y + dv)))
                        - nalgebra::Vector4::from(at(&Point2::new(p.x - du, p.y - dv))))
                        / (2.0 * step)
                };
                let jacobian =
                    nalgebra::Matrix4x2::from_columns(&[column(step, 0.0), column(0.0, step)]);
                let delta = (jacobian.transpose() * jacobian).try_inverse().unwrap()
                    * (jacobian.transpose() * residual);
                p -= delta;
            }
            let q = transfer(&h, &p).unwrap();
            let smallest = ((p - x1).norm_squared() + (q - x2).norm_squared()).sqrt();
            let sampson = homography_sampson_px(&h, &x1, &x2);
            assert!((sampson - smallest).abs() < 1e-3 * smallest + 1e-9);
        }
    }

    #[test]
    fn a_pixel_sent_to_infinity_is_infinitely_wrong() {
        let h = Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0);
        let (x1, x2) = (Point2::new(0.0, 3.0), Point2::new(1.0, 1.0));
        assert_eq!(homography_sampson_px(&h, &x1, &x2), f64::INFINITY);
        assert_eq!(
            homography_sampson_px(&Matrix3::zeros(), &x1, &x2),
            f64::INFINITY
        );
    }
}
