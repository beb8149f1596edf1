//! Singular value decomposition of a 3×3 matrix.

use super::length;
use nalgebra::{Matrix3, Vector3};

/// The decomposition `A = U diag(singular_values) Vᵀ`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Svd3 {
    /// Orthogonal matrix whose columns are the left singular vectors.
    pub u: Matrix3<f64>,
    /// Singular values, largest first, none negative.
    pub singular_values: Vector3<f64>,
    /// Orthogonal matrix whose columns are the right singular vectors.
    pub v: Matrix3<f64>,
}

/// Computes the singular value decomposition of a finite 3×3 matrix.
///
/// U and V are orthogonal for every input, also of rank 0, 1 or 2; their determinants are 1 or
/// −1. Small singular values are accurate relative to the largest one.
///
/// Source: one-sided Jacobi; Golub & Van Loan 2013, §8.6.3.
///
/// ```
/// use epipole::math::svd3;
/// use nalgebra::{Matrix3, Vector3};
/// let svd = svd3(&Matrix3::from_diagonal(&Vector3::new(1.0, -3.0, 2.0)));
/// assert_eq!(svd.singular_values, Vector3::new(3.0, 2.0, 1.0));
/// ```
pub fn svd3(matrix: &Matrix3<f64>) -> Svd3 {
    // Squares of very large or small entries would overflow or underflow.
    let scale = matrix.amax();
    let scale = if scale > 0.0 { scale } else { 1.0 };
    // Rotate the columns of A pairwise until they are orthogonal: A V = U Σ.
    let mut a = matrix / scale;
    let mut v = Matrix3::identity();
    for _ in 0..30 {
        let mut rotated = false;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (cp, cq) = (a.column(p).into_owned(), a.column(q).into_owned());
            let (alpha, beta, gamma) = (cp.norm_squared(), cq.norm_squared(), cp.dot(&cq));
            if gamma * gamma <= 1e-33 * alpha * beta || gamma == 0.0 {
                continue;
            }
            rotated = true;
            let zeta = (beta - alpha) / (2.0 * gamma);
            let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
            let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
            let sine = cosine * tangent;
            a.set_column(p, &(cp * cosine - cq * sine));
            a.set_column(q, &(cp * sine + cq * cosine));
            let (vp, vq) = (v.column(p).into_owned(), v.column(q).into_owned());
            v.set_column(p, &(vp * cosine - vq * sine));
            v.set_column(q, &(vp * sine + vq * cosine));
        }
        if !rotated {
            break;
        }
    }
    let norms = [0, 1, 2].map(|i| length(&a.column(i).into_owned()));
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| norms[j].total_cmp(&norms[i]));
    let singular_values = Vector3::from_iterator(order.map(|i| norms[i]));
    let v = Matrix3::from_columns(&order.map(|i| v.column(i).into_owned()));
    let columns = order.map(|i| a.column(i).into_owned());

    // Columns of U whose singular value is rounding error are completed to an orthogonal matrix.
    let noise = 1e-15 * singular_values[0];
    let u1 = columns[0]
        .try_normalize(f64::MIN_POSITIVE)
        .unwrap_or_else(Vector3::x);
    let raw2 = columns[1] - u1 * u1.dot(&columns[1]);
    let u2 = if singular_values[1] > noise && length(&raw2) > 0.5 * singular_values[1] {
        raw2 / length(&raw2)
    } else {
        perpendicular(&u1)
    };
    let u3 = u1.cross(&u2);
    let u3 = if u3.dot(&columns[2]) < 0.0 { -u3 } else { u3 };
    Svd3 {
        u: Matrix3::from_columns(&[u1, u2, u3]),
        singular_values: singular_values * scale,
        v,
    }
}

/// Returns a unit vector perpendicular to a unit vector.
pub(crate) fn perpendicular(direction: &Vector3<f64>) -> Vector3<f64> {
    let axis = match direction.iamin() {
        0 => Vector3::x(),
        1 => Vector3::y(),
        _ => Vector3::z(),
    };
    direction.cross(&axis).normalize()
}

/// Returns the orthogonal matrix nearest to a matrix, for products of many rotations, which lose
/// orthogonality by rounding.
pub(crate) fn nearest_orthogonal(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let svd = svd3(matrix);
    svd.u * svd.v.transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn check(a: &Matrix3<f64>) -> Svd3 {
        let svd = svd3(a);
        let size = a.amax().max(f64::MIN_POSITIVE);
        let rebuilt = svd.u * Matrix3::from_diagonal(&svd.singular_values) * svd.v.transpose();
        assert!((rebuilt - a).norm() <= 1e-14 * size, "{a}");
        for m in [&svd.u, &svd.v] {
            assert!(
                (m.transpose() * m - Matrix3::identity()).norm() < 1e-14,
                "{a}"
            );
        }
        let s = svd.singular_values;
        assert!(s[0] >= s[1] && s[1] >= s[2] && s[2] >= 0.0);
        svd
    }

    #[test]
    fn random_matrices_of_every_rank_and_scale() {
        let mut random = Random::new(3);
        for trial in 0..300 {
            let mut matrix = || Matrix3::from_fn(|_, _| random.uniform(-1.0, 1.0));
            let (full, left, right) = (matrix(), matrix(), matrix());
            check(&full);
            check(&(full * 1e-100));
            let low = Matrix3::from_diagonal(&Vector3::new(1.0, f64::from(trial % 2), 0.0));
            let svd = check(&(left * low * right));
            assert!(svd.singular_values[2] < 1e-15);
        }
        check(&Matrix3::zeros());
        check(&Matrix3::identity());
        check(&Matrix3::from_element(2.0));
    }

    /// The fundamental matrix of pixels: rows and columns differ by orders of magnitude.
    #[test]
    fn badly_scaled_null_vector() {
        let e = Vector3::new(2345.0, -678.0, 1.0);
        let f = Matrix3::from_rows(&[
            Vector3::new(1e-6, 3e-6, -1e-3).transpose(),
            Vector3::new(-2e-6, 1e-6, 2e-3).transpose(),
            Vector3::new(1e-3, -2e-3, 1.0).transpose(),
        ]) * e.cross_matrix();
        let null = check(&f).v.column(2).into_owned();
        assert!((null / null.z - e).norm() < 1e-5);
    }
}
