//! Jacobians by central differences, for checking analytic ones.

use nalgebra::{DMatrix, DVector};

/// Computes the Jacobian of `residuals` by a step from zero, by central differences:
/// `J[:, j] = (r(h eⱼ) − r(−h eⱼ)) / 2h`.
///
/// * `residuals`: the residuals after a step δ; for parameters on a manifold,
///   `|δ| r(parameters ⊞ δ)`
/// * `num_parameters`: length of δ
/// * `step`: h; 1e-6 suits residuals and parameters around 1
fn numeric_jacobian(
    residuals: &dyn Fn(&DVector<f64>) -> DVector<f64>,
    num_parameters: usize,
    step: f64,
) -> DMatrix<f64> {
    let mut delta = DVector::zeros(num_parameters);
    let num_residuals = residuals(&delta).len();
    let mut jacobian = DMatrix::zeros(num_residuals, num_parameters);
    for j in 0..num_parameters {
        delta[j] = step;
        let ahead = residuals(&delta);
        delta[j] = -step;
        let behind = residuals(&delta);
        delta[j] = 0.0;
        jacobian.set_column(j, &((ahead - behind) / (2.0 * step)));
    }
    jacobian
}

/// Returns the largest difference between an analytic Jacobian and central differences, each entry
/// relative to the larger of 1 and its own size.
///
/// * `residuals`: the residuals after a step δ; for parameters on a manifold,
///   `|δ| r(parameters ⊞ δ)`
/// * `step`: length of the differences; 1e-6 suits residuals and parameters around 1
///
/// Returns infinity if the shapes differ or an entry is not finite.
///
/// ```
/// use epipole::optim::check_jacobian;
/// use nalgebra::{DMatrix, DVector};
/// // r(x) = x² at 3, with the derivative 6.
/// let residuals = |d: &DVector<f64>| DVector::from_vec(vec![(3.0 + d[0]) * (3.0 + d[0])]);
/// assert!(check_jacobian(&DMatrix::from_element(1, 1, 6.0), &residuals, 1e-6) < 1e-6);
/// ```
pub fn check_jacobian(
    analytic: &DMatrix<f64>,
    residuals: &dyn Fn(&DVector<f64>) -> DVector<f64>,
    step: f64,
) -> f64 {
    let numeric = numeric_jacobian(residuals, analytic.ncols(), step);
    if numeric.shape() != analytic.shape() {
        return f64::INFINITY;
    }
    let mut worst: f64 = 0.0;
    for (a, b) in analytic.iter().zip(numeric.iter()) {
        let difference = (a - b).abs() / a.abs().max(1.0);
        if !difference.is_finite() {
            return f64::INFINITY;
        }
        worst = worst.max(difference);
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_sign_is_found() {
        let residuals = |d: &DVector<f64>| {
            DVector::from_vec(vec![libm::sin(0.3 + d[0]) * (2.0 + d[1]), d[0] - d[1]])
        };
        let (s, c) = libm::sincos(0.3);
        let right = DMatrix::from_row_slice(2, 2, &[2.0 * c, s, 1.0, -1.0]);
        let wrong = DMatrix::from_row_slice(2, 2, &[2.0 * c, -s, 1.0, -1.0]);
        assert!(check_jacobian(&right, &residuals, 1e-6) < 1e-9);
        assert!((check_jacobian(&wrong, &residuals, 1e-6) - 2.0 * s).abs() < 1e-6);
        assert!(check_jacobian(&DMatrix::zeros(3, 2), &residuals, 1e-6).is_infinite());
    }
}
