//! Uncertainty of the calibrated parameters.

use super::problem::{Problem, SHARED, State};
use crate::optim::BundleProblem;
use nalgebra::{DMatrix, Matrix6, SMatrix};

/// Returns the standard deviations of the shared parameters, 0 for held ones: the square roots of
/// the diagonal of `σ² (JᵀJ)⁻¹`, with σ² the sum of squares over the degrees of freedom. `None` if
/// the views do not determine them.
///
/// Source: Hartley & Zisserman 2004, §5.2 and appendix A6.3 (the poses are eliminated).
pub(super) fn standard_deviations(problem: &Problem, state: &State) -> Option<[f64; SHARED]> {
    let free: Vec<usize> = (0..SHARED).filter(|&i| !problem.held[i]).collect();
    let mut reduced = DMatrix::<f64>::zeros(free.len(), free.len());
    let mut poses = vec![Matrix6::<f64>::zeros(); problem.num_views];
    let mut between = vec![SMatrix::<f64, 6, SHARED>::zeros(); problem.num_views];
    let mut sum_sq = 0.0;
    for (index, o) in problem.observations.iter().enumerate() {
        let terms = problem.linearize(state, index);
        for row in 0..2 {
            sum_sq += terms.residual[row] * terms.residual[row];
            let by_pose = nalgebra::Vector6::from(terms.camera[row]);
            poses[o.view] += by_pose * by_pose.transpose();
            for (a, &i) in free.iter().enumerate() {
                let slope = terms.shared[row][i];
                if slope == 0.0 {
                    continue;
                }
                for k in 0..6 {
                    between[o.view][(k, i)] += by_pose[k] * slope;
                }
                for (b, &j) in free.iter().enumerate() {
                    reduced[(a, b)] += slope * terms.shared[row][j];
                }
            }
        }
    }
    for (pose, between) in poses.iter().zip(&between) {
        let solved = pose.cholesky()?.solve(between);
        for (a, &i) in free.iter().enumerate() {
            for (b, &j) in free.iter().enumerate() {
                reduced[(a, b)] -= between.column(i).dot(&solved.column(j));
            }
        }
    }
    // Focal lengths and k3 differ by orders of magnitude: columns of equal length preserve
    // precision.
    let scales: Vec<f64> = (0..free.len()).map(|a| reduced[(a, a)].sqrt()).collect();
    if !scales.iter().all(|s| *s > 0.0) {
        return None;
    }
    let scaled = DMatrix::from_fn(free.len(), free.len(), |a, b| {
        reduced[(a, b)] / (scales[a] * scales[b])
    });
    let inverse = scaled.cholesky()?.inverse();
    let num_parameters = free.len() + 6 * problem.num_views;
    let degrees = (2 * problem.observations.len()).checked_sub(num_parameters)?;
    let variance = sum_sq / degrees.max(1) as f64;
    let mut deviations = [0.0; SHARED];
    for (a, &i) in free.iter().enumerate() {
        deviations[i] = (variance * inverse[(a, a)]).sqrt() / scales[a];
    }
    deviations
        .iter()
        .all(|d| d.is_finite())
        .then_some(deviations)
}
