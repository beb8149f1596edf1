//! H from four or more matches, by linear least squares.

use crate::epipolar::Normalization;
use crate::math::null_space::right_singular_vectors;
use crate::{Error, Result};
use nalgebra::{Matrix3, Point2, Vector3};

/// Fits the homography that minimizes the algebraic error `Σ ‖x2 × H x1‖²` after normalization;
/// unit Frobenius norm.
///
/// Points of each image are translated and scaled so that their root-mean-square distance from the
/// origin is √2.
///
/// * `pixels1`, `pixels2`: at least 4 matching pixels
///
/// # Errors
/// [`Error::TooFew`] for fewer than 4 matches, [`Error::SizeMismatch`] for lists of different
/// length, [`Error::NotFinite`] for NaN and infinities, [`Error::Degenerate`] if all points, or all
/// but one, are collinear.
///
/// Source: Hartley & Zisserman 2004, algorithm 4.2.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::homography::fit_homography;
/// use nalgebra::Point2;
/// let p1 = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(|(u, v)| Point2::new(u, v));
/// let p2 = p1.map(|p| Point2::new(p.x + 2.0, p.y)); // a shift by 2
/// let h = fit_homography(&p1, &p2)?;
/// assert!((h[(0, 2)] / h[(2, 2)] - 2.0).abs() < 1e-9);
/// # Ok(()) }
/// ```
pub fn fit_homography(pixels1: &[Point2<f64>], pixels2: &[Point2<f64>]) -> Result<Matrix3<f64>> {
    if pixels1.len() != pixels2.len() {
        return Err(Error::SizeMismatch {
            what: "the two lists of matching pixels",
            first: pixels1.len(),
            second: pixels2.len(),
        });
    }
    if pixels1.len() < 4 {
        return Err(Error::TooFew {
            what: "a homography from matches",
            needed: 4,
            got: pixels1.len(),
        });
    }
    let (n1, n2) = (Normalization::new(pixels1)?, Normalization::new(pixels2)?);
    let (values, vectors) = right_singular_vectors(2 * pixels1.len(), |row| {
        let (p, q) = (n1.apply(&pixels1[row / 2]), n2.apply(&pixels2[row / 2]));
        homography_row(row % 2, [p.x, p.y, q.x, q.y])
    });
    let h = Matrix3::from_row_slice(&vectors[8]);
    // A second small singular value leaves a pencil; a singular H collapses the plane to a line.
    if values[7] <= 1e-10 * values[0] || h.determinant().abs() <= 1e-10 {
        return Err(Error::Degenerate {
            what: "a homography from matches",
            why: "the pixels of an image lie on one line, all but one at most",
        });
    }
    let undone = n2.inverse_matrix() * h * n1.matrix();
    let norm = undone.norm();
    if norm.is_finite() && norm > 0.0 {
        Ok(undone / norm)
    } else {
        Err(Error::NotFinite {
            what: "a homography",
        })
    }
}

/// Returns one of the two rows of the linear system of a match.
#[inline]
pub(crate) fn homography_row(which: usize, [u1, v1, u2, v2]: [f64; 4]) -> [f64; 9] {
    if which == 0 {
        [u1, v1, 1.0, 0.0, 0.0, 0.0, -u2 * u1, -u2 * v1, -u2]
    } else {
        [0.0, 0.0, 0.0, u1, v1, 1.0, -v2 * u1, -v2 * v1, -v2]
    }
}

/// Maps a pixel by H; `None` if the result is at infinity.
///
/// Source: Hartley & Zisserman 2004, §2.3.
///
/// ```
/// use epipole::homography::transfer;
/// use nalgebra::{Matrix3, Point2};
/// // Twice the size, then 10 to the right.
/// let h = Matrix3::new(2.0, 0.0, 10.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0);
/// assert_eq!(transfer(&h, &Point2::new(3.0, 4.0)), Some(Point2::new(16.0, 8.0)));
/// // If the last row is zero, every pixel maps to infinity.
/// assert_eq!(transfer(&Matrix3::from_diagonal(&[1.0, 1.0, 0.0].into()), &Point2::origin()), None);
/// ```
pub fn transfer(homography: &Matrix3<f64>, pixel1: &Point2<f64>) -> Option<Point2<f64>> {
    let x = homography * Vector3::new(pixel1.x, pixel1.y, 1.0);
    let pixel2 = Point2::new(x.x / x.z, x.y / x.z);
    (pixel2.x.is_finite() && pixel2.y.is_finite()).then_some(pixel2)
}

/// Returns the square of [`transfer_error_px`], px².
pub(crate) fn transfer_error_sq(
    homography: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    match transfer(homography, pixel1) {
        Some(p) => (p - pixel2).norm_squared(),
        None => f64::INFINITY,
    }
}

/// Computes the transfer error of a match, in image 2: `‖x2 − H x1‖`, pixels.
///
/// Infinite if H maps the pixel to infinity.
///
/// Source: Hartley & Zisserman 2004, equation 4.6.
///
/// ```
/// use epipole::homography::transfer_error_px;
/// use nalgebra::{Matrix3, Point2};
/// // Twice the size, then 10 to the right.
/// let h = Matrix3::new(2.0, 0.0, 10.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0);
/// // H maps (3, 4) to (16, 8), at an offset of (3, 4) from its match.
/// assert_eq!(transfer_error_px(&h, &Point2::new(3.0, 4.0), &Point2::new(19.0, 12.0)), 5.0);
/// ```
pub fn transfer_error_px(
    homography: &Matrix3<f64>,
    pixel1: &Point2<f64>,
    pixel2: &Point2<f64>,
) -> f64 {
    transfer_error_sq(homography, pixel1, pixel2).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn exact_matches_give_the_truth() {
        let mut random = Random::new(1);
        let truth = Matrix3::new(1.2, -0.1, 40.0, 0.2, 0.9, -30.0, 2e-4, -1e-4, 1.0);
        for count in [4, 5, 20, 500] {
            let p1: Vec<_> = (0..count)
                .map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0)))
                .collect();
            let p2: Vec<_> = p1.iter().map(|p| transfer(&truth, p).unwrap()).collect();
            let h = fit_homography(&p1, &p2).unwrap();
            assert!((h / h[(2, 2)] - truth).norm() < 1e-8);
        }
    }

    #[test]
    fn degenerate_matches_are_refused() {
        let line: Vec<_> = (0..6).map(|i| Point2::new(f64::from(i), 0.5)).collect();
        let mut one_off = line.clone();
        one_off[3].y = 9.0;
        for p in [&line, &one_off, &vec![Point2::new(1.0, 1.0); 6]] {
            assert!(fit_homography(p, p).is_err());
        }
        assert!(fit_homography(&line[..3], &line[..3]).is_err());
        assert!(fit_homography(&line, &line[..4]).is_err());
        let mut bad = one_off.clone();
        bad[0].x = f64::NAN;
        assert!(fit_homography(&bad, &one_off).is_err());
    }
}
