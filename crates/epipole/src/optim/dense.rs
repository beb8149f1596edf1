//! Dense problems of any size, solved by QR: slower than normal equations, but with twice as many
//! digits when parameters are strongly correlated.

use super::fixed::damping_scale;
use super::levenberg_marquardt::{
    DampedStep, Linearization, LmOptions, LmReport, System, minimize,
};
use super::loss::RobustLoss;
use crate::progress::Monitor;
use crate::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// A least-squares problem `½ Σ ρ(rᵢ²)` over a vector of parameters.
pub trait DenseProblem {
    /// Returns the number of scalar residuals.
    fn num_residuals(&self) -> usize;

    /// Writes every residual. The solver avoids parameters with residuals that are not finite.
    fn residuals(&self, parameters: &DVector<f64>, residuals: &mut DVector<f64>);

    /// Writes the Jacobian, one row per residual.
    fn jacobian(&self, parameters: &DVector<f64>, jacobian: &mut DMatrix<f64>);

    /// Returns the loss of each residual.
    fn loss(&self) -> RobustLoss {
        RobustLoss::Trivial
    }

    /// Returns whether the `index`-th parameter is held fixed.
    fn is_held(&self, _index: usize) -> bool {
        false
    }
}

struct DenseSystem<'a> {
    problem: &'a dyn DenseProblem,
    loss: RobustLoss,
    residuals: DVector<f64>,
    /// Rows scaled by √ρ'.
    jacobian: DMatrix<f64>,
    weighted_residuals: DVector<f64>,
    gradient: DVector<f64>,
    /// Squared column norms; they decrease only gradually, or the damping would vanish as soon as a
    /// step lands on a plateau.
    scale: DVector<f64>,
    delta: DVector<f64>,
}

impl DenseSystem<'_> {
    fn sum_of_losses(&self) -> f64 {
        let mut sum = 0.0;
        for r in self.residuals.iter() {
            sum += self.loss.rho(r * r);
        }
        0.5 * sum
    }
}

impl System for DenseSystem<'_> {
    type Parameters = DVector<f64>;

    fn linearize(&mut self, parameters: &DVector<f64>) -> Linearization {
        self.problem.residuals(parameters, &mut self.residuals);
        self.problem.jacobian(parameters, &mut self.jacobian);
        for j in 0..self.jacobian.ncols() {
            if self.problem.is_held(j) {
                self.jacobian.column_mut(j).fill(0.0);
            }
        }
        for i in 0..self.residuals.len() {
            let r = self.residuals[i];
            let root = self.loss.weight(r * r).sqrt();
            self.weighted_residuals[i] = root * r;
            self.jacobian.row_mut(i).scale_mut(root);
        }
        self.gradient = self.jacobian.tr_mul(&self.weighted_residuals);
        for j in 0..self.jacobian.ncols() {
            let norm_sq = self.jacobian.column(j).norm_squared();
            self.scale[j] = (0.1 * self.scale[j]).max(norm_sq);
        }
        let gradient_max = if self.gradient.iter().all(|g| g.is_finite()) {
            self.gradient.amax()
        } else {
            f64::NAN
        };
        Linearization {
            cost: self.sum_of_losses(),
            gradient_max,
            parameter_norm: parameters.norm(),
        }
    }

    fn solve(&mut self, damping: f64) -> Option<DampedStep> {
        // min ‖ [J; √(λD)] δ + [r; 0] ‖ by QR.
        let (m, n) = self.jacobian.shape();
        let mut stacked = DMatrix::zeros(m + n, n);
        stacked.rows_mut(0, m).copy_from(&self.jacobian);
        let mut right = DVector::zeros(m + n);
        right.rows_mut(0, m).copy_from(&(-&self.weighted_residuals));
        for j in 0..n {
            stacked[(m + j, j)] = (damping * damping_scale(self.scale[j])).sqrt();
        }
        let qr = stacked.qr();
        qr.q_tr_mul(&mut right);
        let delta = qr
            .unpack_r()
            .solve_upper_triangular(&right.rows(0, n).clone_owned())?;
        let (mut predicted, mut norm_sq) = (0.0, 0.0);
        for j in 0..n {
            let scale = damping_scale(self.scale[j]);
            predicted += delta[j] * (damping * scale * delta[j] - self.gradient[j]);
            norm_sq += delta[j] * delta[j];
        }
        self.delta = delta;
        Some(DampedStep {
            predicted_decrease: 0.5 * predicted,
            norm: norm_sq.sqrt(),
        })
    }

    fn step(&self, from: &DVector<f64>, into: &mut DVector<f64>) {
        into.copy_from(from);
        *into += &self.delta;
    }

    fn cost(&mut self, parameters: &DVector<f64>) -> f64 {
        self.problem.residuals(parameters, &mut self.residuals);
        self.sum_of_losses()
    }
}

/// Minimizes a [`DenseProblem`] from `parameters`, in place.
///
/// * `monitor`: notified after every iteration
///
/// # Errors
/// [`Error::TooFew`] without residuals or parameters, [`Error::OutOfRange`] for a loss that
/// [`RobustLoss::check`] rejects, [`Error::NotFinite`] if the initial cost or gradient is not
/// finite.
///
/// Source: Moré 1978, "The Levenberg–Marquardt algorithm: implementation and theory", §3 (the QR
/// form) and §6 (damping scaled by column norms; there the largest so far, while here it may fall
/// tenfold per iteration).
pub fn minimize_dense(
    problem: &dyn DenseProblem,
    parameters: &mut DVector<f64>,
    options: &LmOptions,
    monitor: &mut dyn Monitor,
) -> Result<LmReport> {
    let (m, n) = (problem.num_residuals(), parameters.len());
    if m == 0 || n == 0 {
        return Err(Error::TooFew {
            what: "a least-squares fit from residuals and parameters",
            needed: 1,
            got: 0,
        });
    }
    let loss = problem.loss();
    loss.check()?;
    let mut system = DenseSystem {
        problem,
        loss,
        residuals: DVector::zeros(m),
        jacobian: DMatrix::zeros(m, n),
        weighted_residuals: DVector::zeros(m),
        gradient: DVector::zeros(n),
        scale: DVector::zeros(n),
        delta: DVector::zeros(n),
    };
    minimize(&mut system, parameters, options, monitor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optim::{Iteration, check_jacobian};
    use crate::progress::{Stage, Status};
    use std::ops::ControlFlow;

    /// y = a exp(b x) through exact data.
    struct Growth {
        loss: RobustLoss,
    }

    impl DenseProblem for Growth {
        fn num_residuals(&self) -> usize {
            12
        }
        fn residuals(&self, p: &DVector<f64>, r: &mut DVector<f64>) {
            for i in 0..12 {
                let x = i as f64 / 4.0;
                let outlier = if i == 7 { 30.0 } else { 0.0 };
                r[i] = p[0] * libm::exp(p[1] * x) - 2.0 * libm::exp(0.5 * x) - outlier;
            }
        }
        fn jacobian(&self, p: &DVector<f64>, j: &mut DMatrix<f64>) {
            for i in 0..12 {
                let x = i as f64 / 4.0;
                j[(i, 0)] = libm::exp(p[1] * x);
                j[(i, 1)] = p[0] * x * libm::exp(p[1] * x);
            }
        }
        fn loss(&self) -> RobustLoss {
            self.loss
        }
    }

    #[test]
    fn the_robust_fit_finds_the_truth_beside_an_outlier() {
        let problem = Growth {
            loss: RobustLoss::Cauchy { width: 0.1 },
        };
        let mut p = DVector::from_vec(vec![1.0, 1.0]);
        let report = minimize_dense(&problem, &mut p, &LmOptions::default(), &mut ()).unwrap();
        let costs: Vec<f64> = report.history.iter().map(|step| step.cost).collect();
        assert!(
            (p[0] - 2.0).abs() < 1e-2 && (p[1] - 0.5).abs() < 1e-2,
            "{p}"
        );
        assert!(costs.windows(2).all(|pair| pair[1] <= pair[0]));
        assert_eq!(costs.len(), report.iterations + 1);
        assert_eq!(costs.last().copied(), Some(report.final_cost));
    }

    #[test]
    fn canceling_leaves_the_best_so_far() {
        let problem = Growth {
            loss: RobustLoss::Trivial,
        };
        let options = LmOptions::default();
        let start = DVector::from_vec(vec![1.0, 1.0]);
        let mut p = start.clone();
        let whole = minimize_dense(&problem, &mut p, &options, &mut ()).unwrap();
        let accepted = |step: &Iteration| step.index > 0 && step.accepted;
        let first = whole.history.iter().position(accepted).unwrap();
        let (mut p, mut calls) = (start, 0);
        let canceled = minimize_dense(&problem, &mut p, &options, &mut |status: Status| {
            assert_eq!(status.stage, Stage::Refinement);
            calls += 1;
            if calls > first {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        assert_eq!(canceled, Err(Error::Canceled));
        let mut residuals = DVector::zeros(12);
        problem.residuals(&p, &mut residuals);
        let cost = 0.5 * residuals.norm_squared();
        assert!(cost < whole.initial_cost);
        assert!((cost / whole.history[first].cost - 1.0).abs() < 1e-12);
    }

    #[test]
    fn its_jacobian_is_right() {
        let problem = Growth {
            loss: RobustLoss::Trivial,
        };
        let p = DVector::from_vec(vec![1.3, 0.7]);
        let mut jacobian = DMatrix::zeros(12, 2);
        problem.jacobian(&p, &mut jacobian);
        let residuals = |delta: &DVector<f64>| {
            let mut r = DVector::zeros(12);
            problem.residuals(&(&p + delta), &mut r);
            r
        };
        assert!(check_jacobian(&jacobian, &residuals, 1e-6) < 1e-8);
    }

    #[test]
    fn bad_losses_are_refused() {
        let problem = Growth {
            loss: RobustLoss::Huber { width: 0.0 },
        };
        let mut p = DVector::from_vec(vec![1.0, 1.0]);
        assert!(minimize_dense(&problem, &mut p, &LmOptions::default(), &mut ()).is_err());
    }
}
