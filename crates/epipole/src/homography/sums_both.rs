//! Transfer errors of many matches, whitened by the noise of both images.
//!
//! With the derivative A of `x(H x1)` by pixel 1, equal noise in both images gives the transfer
//! error the covariance `S = (1 + A Aᵀ) / 2`, up to a factor: the identity if H preserves lengths.

use super::sums::{by_entries, offsets};
use crate::epipolar::coordinates::{Coordinates, LANES, Lanes, entries, sum};
use crate::math::simd::{Aligned, dispatched};
use nalgebra::{Matrix3, SMatrix, SVector};

/// `w S⁻¹` of eight matches, with w the weight of a match, as `[w1, t, w2]`: the squared error is
/// `w1 du² + w2 (dv − t du)²` for a transfer error (du, dv). All are 0 for a match of weight 0.
pub(super) type Whitening = [Lanes; 3];

dispatched! {
    /// Returns the whitening of all matches' transfer errors at H; `None` if H maps a pixel to
    /// infinity.
    pub(super) fn whitenings(coordinates: &Coordinates, homography: &Matrix3<f64>) -> Option<Vec<Whitening>> {
        let h = entries(homography);
        let mut whitenings = Vec::with_capacity(coordinates.len().div_ceil(LANES));
        for start in (0..coordinates.len()).step_by(LANES) {
            let (lanes, count) = coordinates.lanes(start);
            let (du, dv, per_z) = offsets(&h, lanes);
            let mut weight = [0.0; LANES];
            match coordinates.weights(start) {
                Some(weights) => weight[..count].copy_from_slice(&weights[..count]),
                None => weight[..count].fill(1.0),
            }
            let (mut w1, mut t, mut w2) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            for l in 0..LANES {
                let (u, v) = (du[l] + lanes[2][l], dv[l] + lanes[3][l]);
                let [a, b] = [(h[0] - u * h[6]) * per_z[l], (h[1] - u * h[7]) * per_z[l]];
                let [c, d] = [(h[3] - v * h[6]) * per_z[l], (h[4] - v * h[7]) * per_z[l]];
                let area = a * d - b * c;
                // 2 S and its determinant, from sums of squares only, which do not cancel.
                let (first, both) = (1.0 + a * a + b * b, a * c + b * d);
                let determinant = first + c * c + d * d + area * area;
                w1[l] = 2.0 * weight[l] / first;
                t[l] = both / first;
                w2[l] = 2.0 * weight[l] * first / determinant;
            }
            for lane in [&mut w1, &mut t, &mut w2] {
                if lane[..count].iter().any(|x| !x.is_finite()) {
                    return None;
                }
                lane[count..].fill(0.0);
            }
            whitenings.push([w1, t, w2]);
        }
        Some(whitenings)
    }
}

dispatched! {
    /// Returns half the sum of the squares.
    pub(super) fn cost(coordinates: &Coordinates, whitenings: &[Whitening], homography: &Matrix3<f64>) -> f64 {
        let h = entries(homography);
        let mut total = [0.0; LANES];
        for (group, whitening) in whitenings.iter().enumerate() {
            let (lanes, _) = coordinates.lanes(group * LANES);
            let (du, dv, _) = offsets(&h, lanes);
            let [w1, t, w2] = *whitening;
            for l in 0..LANES {
                let counts = w1[l] > 0.0;
                let du = if counts { du[l] } else { 0.0 };
                let dv = if counts { dv[l] } else { 0.0 };
                let rest = dv - t[l] * du;
                total[l] += w1[l] * du * du + w2[l] * rest * rest;
            }
        }
        0.5 * sum(&total)
    }
}

dispatched! {
    /// Returns the sums for least squares in the nine entries of H, row by row: (`JᵀJ`, `Jᵀr`,
    /// cost).
    ///
    /// The derivatives are those of [`linearize`](super::sums::linearize): with
    /// `x = (u1, v1, 1)/z`, the residuals have `E ⊗ xᵀ` with `E = (1 0 −u'; 0 1 −v')`, so that
    /// `JᵀJ` is the sum of `EᵀS⁻¹E ⊗ x xᵀ`.
    pub(super) fn linearize(
        coordinates: &Coordinates,
        whitenings: &[Whitening],
        homography: &Matrix3<f64>,
    ) -> (SMatrix<f64, 9, 9>, SVector<f64, 9>, f64) {
        let h = entries(homography);
        let mut products = Aligned([[[0.0; LANES]; 6]; 6]);
        let mut gradient = Aligned([[0.0; LANES]; 9]);
        let mut total = [0.0; LANES];
        for (group, whitening) in whitenings.iter().enumerate() {
            let (lanes, _) = coordinates.lanes(group * LANES);
            let (du, dv, per_z) = offsets(&h, lanes);
            let [u1, v1, u2, v2] = *lanes;
            let [w1, t, w2] = *whitening;
            for l in 0..LANES {
                // A match of weight 0 may be at infinity.
                let counts = w1[l] > 0.0;
                let du = if counts { du[l] } else { 0.0 };
                let dv = if counts { dv[l] } else { 0.0 };
                let z = if counts { per_z[l] } else { 0.0 };
                let (u, v) = (du + u2[l], dv + v2[l]);
                let x = [u1[l] * z, v1[l] * z, z];
                let rest = dv - t[l] * du;
                let (own1, pull2) = (w1[l] * du, w2[l] * rest);
                total[l] += own1 * du + pull2 * rest;
                let pull1 = own1 - t[l] * pull2;
                let uv = -w2[l] * t[l];
                let uu = w1[l] - uv * t[l];
                let (u3, v3) = (-(uu * u + uv * v), -(uv * u + w2[l] * v));
                let factors = [uu, uv, w2[l], u3, v3, -(u3 * u + v3 * v)];
                let squares = [
                    x[0] * x[0],
                    x[0] * x[1],
                    x[0] * x[2],
                    x[1] * x[1],
                    x[1] * x[2],
                    x[2] * x[2],
                ];
                for (block, factor) in products.0.iter_mut().zip(factors) {
                    for (sum, square) in block.iter_mut().zip(squares) {
                        sum[l] += factor * square;
                    }
                }
                let pulls = [pull1, pull2, -(pull1 * u + pull2 * v)];
                for i in 0..3 {
                    for j in 0..3 {
                        gradient.0[3 * i + j][l] += pulls[i] * x[j];
                    }
                }
            }
        }
        (
            by_entries(&products.0.map(|block| block.map(|lanes| sum(&lanes)))),
            SVector::from_fn(|i, _| sum(&gradient.0[i])),
            0.5 * sum(&total),
        )
    }
}
