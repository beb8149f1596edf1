//! Sampson errors of many matches, for scoring and least squares.

use super::coordinates::{Coordinates, LANES, Lanes, entries, sum};
use super::judge::{self, LaneErrors, weigh};
use crate::math::simd::{Aligned, dispatched};
use crate::optim::RobustLoss;
use crate::robust::Support;
use nalgebra::{Matrix3, SMatrix, SVector};

/// The entries of F, row by row.
pub(super) struct Sampson(pub(super) [f64; 9]);

impl LaneErrors for Sampson {
    /// Returns NaN for a match without any epipolar line (0/0).
    #[inline(always)]
    fn relative_errors(&self, lanes: &[Lanes; 4], per_threshold_sq: f64) -> Lanes {
        let f = &self.0;
        let [u1, v1, u2, v2] = lanes;
        let mut errors = [0.0; LANES];
        for l in 0..LANES {
            let a = f[0] * u1[l] + f[1] * v1[l] + f[2];
            let b = f[3] * u1[l] + f[4] * v1[l] + f[5];
            let c = f[6] * u1[l] + f[7] * v1[l] + f[8];
            let p = f[0] * u2[l] + f[3] * v2[l] + f[6];
            let q = f[1] * u2[l] + f[4] * v2[l] + f[7];
            let algebraic = u2[l] * a + v2[l] * b + c;
            let slope_sq = (a * a + b * b) + (p * p + q * q);
            errors[l] = algebraic * algebraic * per_threshold_sq / slope_sq;
        }
        errors
    }
}

dispatched! {
    /// Returns the support of F among the matches; stops once the cost exceeds the limit.
    pub(crate) fn support(
        coordinates: &Coordinates,
        fundamental: &Matrix3<f64>,
        max_error: f64,
        cost_limit: f64,
    ) -> Support {
        judge::support(&Sampson(entries(fundamental)), coordinates, max_error, cost_limit)
    }
}

dispatched! {
    /// Fills `inliers` with the matches within the threshold.
    pub(crate) fn inliers(
        coordinates: &Coordinates,
        fundamental: &Matrix3<f64>,
        max_error: f64,
        inliers: &mut Vec<usize>,
    ) {
        judge::inliers(&Sampson(entries(fundamental)), coordinates, max_error, inliers);
    }
}

dispatched! {
    /// Returns `½ Σ w ρ(e²)` of the Sampson errors.
    pub(crate) fn cost(
        coordinates: &Coordinates,
        fundamental: &Matrix3<f64>,
        loss: &RobustLoss,
    ) -> f64 {
        judge::cost(&Sampson(entries(fundamental)), coordinates, loss)
    }
}

/// Sums for least squares in the nine entries of F, row by row.
#[derive(Debug, Clone)]
pub(crate) struct EntrySums {
    pub(crate) hessian: SMatrix<f64, 9, 9>,
    pub(crate) gradient: SVector<f64, 9>,
    pub(crate) cost: f64,
}

dispatched! {
    /// Linearizes the Sampson errors of all matches: `r = C/√D` with `C = x2ᵀ F x1`, and
    /// `∂r/∂F = (x2 x1ᵀ − (C/D) ½ ∂D/∂F)/√D`.
    pub(crate) fn linearize(
        coordinates: &Coordinates,
        fundamental: &Matrix3<f64>,
        loss: &RobustLoss,
    ) -> EntrySums {
        let f = entries(fundamental);
        let mut products = Aligned([[0.0; LANES]; 45]);
        let mut gradient = Aligned([[0.0; LANES]; 9]);
        // Each group overwrites all of it, so it is cleared once.
        let mut jacobian = [[0.0; LANES]; 9];
        let mut total = [0.0; LANES];
        for start in (0..coordinates.len()).step_by(LANES) {
            let ([u1, v1, u2, v2], count) = coordinates.lanes(start);
            let mut residual = [0.0; LANES];
            let mut errors_sq = [0.0; LANES];
            for l in 0..LANES {
                let a = f[0] * u1[l] + f[1] * v1[l] + f[2];
                let b = f[3] * u1[l] + f[4] * v1[l] + f[5];
                let c = f[6] * u1[l] + f[7] * v1[l] + f[8];
                let p = f[0] * u2[l] + f[3] * v2[l] + f[6];
                let q = f[1] * u2[l] + f[4] * v2[l] + f[7];
                let algebraic = u2[l] * a + v2[l] * b + c;
                let slope_sq = (a * a + b * b) + (p * p + q * q);
                let per_slope = 1.0 / slope_sq.sqrt();
                let s = algebraic * per_slope * per_slope;
                residual[l] = algebraic * per_slope;
                errors_sq[l] = residual[l] * residual[l];
                jacobian[0][l] = (u2[l] * u1[l] - s * (a * u1[l] + p * u2[l])) * per_slope;
                jacobian[1][l] = (u2[l] * v1[l] - s * (a * v1[l] + q * u2[l])) * per_slope;
                jacobian[2][l] = (u2[l] - s * a) * per_slope;
                jacobian[3][l] = (v2[l] * u1[l] - s * (b * u1[l] + p * v2[l])) * per_slope;
                jacobian[4][l] = (v2[l] * v1[l] - s * (b * v1[l] + q * v2[l])) * per_slope;
                jacobian[5][l] = (v2[l] - s * b) * per_slope;
                jacobian[6][l] = (u1[l] - s * p) * per_slope;
                jacobian[7][l] = (v1[l] - s * q) * per_slope;
                jacobian[8][l] = per_slope;
            }
            let weight = weigh(coordinates, start, count, loss, &errors_sq, &mut total);
            if count < LANES {
                // Lanes beyond the end may hold any values, even NaN.
                for l in count..LANES {
                    residual[l] = 0.0;
                    for entry in &mut jacobian {
                        entry[l] = 0.0;
                    }
                }
            }
            let mut k = 0;
            for i in 0..9 {
                let mut weighted = [0.0; LANES];
                for l in 0..LANES {
                    weighted[l] = weight[l] * jacobian[i][l];
                    gradient.0[i][l] += weighted[l] * residual[l];
                }
                for other in &jacobian[i..] {
                    for l in 0..LANES {
                        products.0[k][l] += weighted[l] * other[l];
                    }
                    k += 1;
                }
            }
        }
        let mut hessian = SMatrix::zeros();
        let mut k = 0;
        for i in 0..9 {
            for j in i..9 {
                hessian[(i, j)] = sum(&products.0[k]);
                hessian[(j, i)] = hessian[(i, j)];
                k += 1;
            }
        }
        EntrySums {
            hessian,
            gradient: SVector::from_fn(|i, _| sum(&gradient.0[i])),
            cost: 0.5 * sum(&total),
        }
    }
}
