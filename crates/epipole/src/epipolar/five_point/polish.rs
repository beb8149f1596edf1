//! Removal of rounding errors from nearly essential matrices.

use nalgebra::{Matrix3, Matrix4, Vector4};

/// Maximum residual of `E Eᵀ E = ½ tr(E Eᵀ) E`; matrices above are polished, and dropped if that
/// fails.
const GOOD: f64 = 5e-9;

/// Residual at which polishing ends.
const EXACT: f64 = 1e-14;

/// Maximum number of polishing steps: each doubles the digits, but gains only about a bit at double
/// solutions.
const MAX_STEPS: usize = 10;

/// Damping for families of solutions, where the equations are singular and any member will do.
const DAMPING: f64 = 1e-15;

/// Finds the essential matrix in the span of the basis close to the nearly essential `near`; both
/// of unit norm. `None` if there is none.
#[inline]
pub(super) fn polished(near: &Matrix3<f64>, basis: &[[f64; 9]; 4]) -> Option<Matrix3<f64>> {
    if missing_sq(near) < GOOD * GOOD {
        Some(*near)
    } else {
        sought(near, basis)
    }
}

/// Returns the squared constraint residual of a matrix of unit norm.
#[inline]
pub(super) fn missing_sq(e: &Matrix3<f64>) -> f64 {
    constraint(e).norm_squared()
}

/// Returns `E Eᵀ E − ½ E`: zero for an essential matrix of unit Frobenius norm.
#[inline(always)]
fn constraint(e: &Matrix3<f64>) -> Matrix3<f64> {
    let dot =
        |i: usize, j: usize| e[(i, 0)] * e[(j, 0)] + e[(i, 1)] * e[(j, 1)] + e[(i, 2)] * e[(j, 2)];
    let (xy, xz, yz) = (dot(0, 1), dot(0, 2), dot(1, 2));
    #[rustfmt::skip]
    let eet = Matrix3::new(
        dot(0, 0) - 0.5, xy,              xz,
        xy,              dot(1, 1) - 0.5, yz,
        xz,              yz,              dot(2, 2) - 0.5,
    );
    eet * e
}

/// Runs Gauss–Newton on the four coefficients, to remove rounding errors.
#[cold]
fn sought(near: &Matrix3<f64>, basis: &[[f64; 9]; 4]) -> Option<Matrix3<f64>> {
    let basis = basis.map(|vector| Matrix3::from_row_slice(&vector));
    let mut e = *near;
    for _ in 0..MAX_STEPS {
        let missing = constraint(&e);
        if missing.norm() < EXACT {
            return Some(e);
        }
        let (ete, eet) = (e.transpose() * e, e * e.transpose());
        // The derivatives of the constraint by each coefficient; the last row keeps the length.
        let columns = basis.map(|d| {
            let cubic = d * ete + e * d.transpose() * e + eet * d;
            (cubic - d * 0.5 - e * e.dot(&d), e.dot(&d))
        });
        let normal = Matrix4::from_fn(|i, j| {
            let damping = if i == j { DAMPING } else { 0.0 };
            columns[i].0.dot(&columns[j].0) + columns[i].1 * columns[j].1 + damping
        });
        let right = Vector4::from_fn(|i, _| columns[i].0.dot(&missing));
        let step = normal.cholesky()?.solve(&right);
        for (d, s) in basis.iter().zip(step.iter()) {
            e -= d * *s;
        }
        e /= e.norm();
    }
    (constraint(&e).norm() < GOOD).then_some(e)
}
