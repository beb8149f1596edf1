//! Sampson error of H: the distance of both pixels of a match from an exact fit.

use nalgebra::{Matrix3, Point2, Vector3};

/// Returns the square of [`homography_sampson_px`], px², at least 0 and never NaN for finite input.
///
/// With the constraint `c = x(H x1) − x2`, its derivative A by pixel 1 and −1 by pixel 2, it is
/// `cᵀ (A Aᵀ + 1)⁻¹ c = (|c|² + |adj(A) c|²) / (1 + |A|² + det(A)²)`.
///
/// * `homography`: H at any scale
/// * `pixel1`, `pixel2`: a match
///
/// Infinite if H maps pixel 1 to infinity, or so far that the squares overflow.
///
/// Source: Hartley & Zisserman 2004, §4.2.6.
pub(crate) fn homography_sampson_sq(
    homography: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    let h = homography;
    let x = h * Vector3::new(pixel1.x, pixel1.y, 1.0);
    let (u2, v2) = (pixel2.x, pixel2.y);
    // The constraint is x − z (u2, v2) = 0; dividing by z allows any scale of H.
    let per_z = 1.0 / x.z;
    let [cu, cv] = [x.x * per_z - u2, x.y * per_z - v2];
    let [a, b, c, d] = [
        (h[(0, 0)] - u2 * h[(2, 0)]) * per_z,
        (h[(0, 1)] - u2 * h[(2, 1)]) * per_z,
        (h[(1, 0)] - v2 * h[(2, 0)]) * per_z,
        (h[(1, 1)] - v2 * h[(2, 1)]) * per_z,
    ];
    // Only sums of squares: an inverse of A Aᵀ + 1 could become negative by cancellation if H
    // stretches much more in one direction than in the other.
    let (du, dv) = (d * cu - b * cv, a * cv - c * cu);
    let determinant = a * d - b * c;
    let error_sq = (cu * cu + cv * cv + du * du + dv * dv)
        / (1.0 + a * a + b * b + c * c + d * d + determinant * determinant);
    if error_sq.is_nan() {
        f64::INFINITY
    } else {
        error_sq
    }
}

/// Computes the Sampson error: to first order, the smallest change of (u1, v1, u2, v2), in pixels,
/// after which H maps one pixel of a match to the other.
///
/// Unlike [`transfer_error_px`](super::transfer_error_px) it treats both images alike: with equal
/// noise in both, its square divided by the variance has two degrees of freedom at any
/// magnification. Infinite if H maps the pixel to infinity, or so far that squares overflow; never
/// NaN for finite input.
///
/// Source: Hartley & Zisserman 2004, §4.2.6.
///
/// ```
/// use epipole::homography::{homography_sampson_px, transfer_error_px};
/// use nalgebra::{Matrix3, Point2};
/// // H doubles lengths: an offset of 5 in image 2 needs a shift of (−2, 1), shared by both pixels.
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
            // Gauss–Newton over the true position of the first pixel.
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

    /// The value in exact arithmetic, for an H that stretches by 10⁸ in one direction and hardly in
    /// the other.
    #[test]
    fn no_square_is_negative() {
        #[rustfmt::skip]
        let h = Matrix3::new(
            5.191_636_773_953_835e-9, 30.018_255_412_721_267, -0.005_813_476_031_884_998,
            -4.987_454_826_283_36e-5, -5.861_022_920_296_678e-6, -3.576_606_216_887_954e-7,
            0.009_605_509_794_214_172, -42.367_311_506_058_94, 5.067_490_762_029_973e-5,
        );
        let (x1, x2) = (
            Point2::new(0.0, 3.0),
            Point2::new(855_337_319.552_374_8, 688_219_794.966_519_4),
        );
        let found = homography_sampson_px(&h, &x1, &x2);
        assert!((found - 2.999_998_726_947_166).abs() < 1e-6, "{found}");

        let mut random = Random::new(2);
        for _ in 0..100_000 {
            let mut entry = || {
                let power = random.uniform(-40.0, 40.0);
                random.normal() * libm::pow(10.0, power)
            };
            let h = Matrix3::from_fn(|_, _| entry());
            let (x1, x2) = (Point2::new(entry(), entry()), Point2::new(entry(), entry()));
            let found = homography_sampson_sq(&h, &x1, &x2);
            assert!(found >= 0.0, "{found}: {h} {x1} {x2}");
        }
    }
}
