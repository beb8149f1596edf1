//! Transfer errors of many matches, for scoring and least squares.

use crate::epipolar::coordinates::{Coordinates, LANES, Lanes, entries, sum};
use crate::epipolar::judge::{self, LaneErrors, weigh};
use crate::math::simd::{Aligned, dispatched};
use crate::optim::RobustLoss;
use crate::robust::Support;
use nalgebra::{Matrix3, SMatrix, SVector};

/// Returns the transferred pixel minus its match, and 1/z, for eight matches.
#[inline(always)]
pub(super) fn offsets(h: &[f64; 9], lanes: &[Lanes; 4]) -> (Lanes, Lanes, Lanes) {
    let [u1, v1, u2, v2] = lanes;
    let (mut du, mut dv, mut per_z) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for l in 0..LANES {
        let x = h[0] * u1[l] + h[1] * v1[l] + h[2];
        let y = h[3] * u1[l] + h[4] * v1[l] + h[5];
        let z = h[6] * u1[l] + h[7] * v1[l] + h[8];
        per_z[l] = 1.0 / z;
        du[l] = x * per_z[l] - u2[l];
        dv[l] = y * per_z[l] - v2[l];
    }
    (du, dv, per_z)
}

/// Returns the symmetric 9 × 9 matrix `Σ M ⊗ x xᵀ`, where M and x xᵀ are 3 × 3.
///
/// * `products`: for each entry of M, `M00 M01 M11 M02 M12 M22`, the sums with
///   `x0x0 x0x1 x0x2 x1x1 x1x2 x2x2`
pub(super) fn by_entries(products: &[[f64; 6]; 6]) -> SMatrix<f64, 9, 9> {
    const BLOCK: [[usize; 3]; 3] = [[0, 1, 3], [1, 2, 4], [3, 4, 5]];
    const PLACE: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
    SMatrix::from_fn(|i, j| products[BLOCK[i / 3][j / 3]][PLACE[i % 3][j % 3]])
}

/// The entries of H, row by row.
struct Transfer([f64; 9]);

impl LaneErrors for Transfer {
    #[inline(always)]
    fn relative_errors(&self, lanes: &[Lanes; 4], per_threshold_sq: f64) -> Lanes {
        let (du, dv, _) = offsets(&self.0, lanes);
        let mut errors = [0.0; LANES];
        for l in 0..LANES {
            errors[l] = (du[l] * du[l] + dv[l] * dv[l]) * per_threshold_sq;
        }
        errors
    }
}

dispatched! {
    /// Returns the support of H among the matches; stops once the cost exceeds the limit.
    pub(crate) fn support(
        coordinates: &Coordinates,
        homography: &Matrix3<f64>,
        max_error: f64,
        cost_limit: f64,
    ) -> Support {
        judge::support(&Transfer(entries(homography)), coordinates, max_error, cost_limit)
    }
}

dispatched! {
    /// Fills `inliers` with the matches within the threshold.
    pub(crate) fn inliers(
        coordinates: &Coordinates,
        homography: &Matrix3<f64>,
        max_error: f64,
        inliers: &mut Vec<usize>,
    ) {
        judge::inliers(&Transfer(entries(homography)), coordinates, max_error, inliers);
    }
}

dispatched! {
    /// Returns `½ Σ w ρ(e²)` of the transfer errors.
    pub(crate) fn cost(coordinates: &Coordinates, homography: &Matrix3<f64>, loss: &RobustLoss) -> f64 {
        judge::cost(&Transfer(entries(homography)), coordinates, loss)
    }
}

dispatched! {
    /// Returns the sums for least squares in the nine entries of H, row by row: (`JᵀJ`, `Jᵀr`,
    /// cost).
    ///
    /// With `x = (u1, v1, 1)/z`, the residual (du, dv) has the derivatives x by the first row of H,
    /// x by the second, and `−(u', v') x` by the third, where (u', v') is the transferred pixel.
    pub(crate) fn linearize(
        coordinates: &Coordinates,
        homography: &Matrix3<f64>,
        loss: &RobustLoss,
    ) -> (SMatrix<f64, 9, 9>, SVector<f64, 9>, f64) {
        let h = entries(homography);
        // Each of the six products of x with itself is weighted by 1, u', v', u'² + v'².
        let mut products = Aligned([[[0.0; LANES]; 6]; 4]);
        let mut gradient = Aligned([[0.0; LANES]; 9]);
        let mut total = [0.0; LANES];
        for start in (0..coordinates.len()).step_by(LANES) {
            let (lanes, count) = coordinates.lanes(start);
            let (du, dv, per_z) = offsets(&h, lanes);
            let [u1, v1, u2, v2] = *lanes;
            let mut errors_sq = [0.0; LANES];
            for l in 0..LANES {
                errors_sq[l] = du[l] * du[l] + dv[l] * dv[l];
            }
            let weight = weigh(coordinates, start, count, loss, &errors_sq, &mut total);
            for l in 0..LANES {
                // Lanes beyond the end may hold infinities, which a weight of 0 does not remove.
                // Select per lane, as a common branch would prevent vectorization.
                let counts = weight[l] > 0.0;
                let du = if counts { du[l] } else { 0.0 };
                let dv = if counts { dv[l] } else { 0.0 };
                let z = if counts { per_z[l] } else { 0.0 };
                let (u, v) = (du + u2[l], dv + v2[l]);
                let x = [u1[l] * z, v1[l] * z, z];
                let scaled = x.map(|value| value * weight[l]);
                let squares = [
                    scaled[0] * x[0],
                    scaled[0] * x[1],
                    scaled[0] * x[2],
                    scaled[1] * x[1],
                    scaled[1] * x[2],
                    scaled[2] * x[2],
                ];
                let factors = [1.0, u, v, u * u + v * v];
                for (block, factor) in products.0.iter_mut().zip(factors) {
                    for (sum, square) in block.iter_mut().zip(squares) {
                        sum[l] += factor * square;
                    }
                }
                let third = -(du * u + dv * v);
                for i in 0..3 {
                    gradient.0[i][l] += scaled[i] * du;
                    gradient.0[3 + i][l] += scaled[i] * dv;
                    gradient.0[6 + i][l] += scaled[i] * third;
                }
            }
        }
        let [one, u, v, uv] = products.0.map(|block| block.map(|lanes| sum(&lanes)));
        let none = [0.0; 6];
        let hessian = by_entries(&[one, none, one, u.map(|x| -x), v.map(|x| -x), uv]);
        (
            hessian,
            SVector::from_fn(|i, _| sum(&gradient.0[i])),
            0.5 * sum(&total),
        )
    }
}
