//! Homogeneous point of two-view triangulation, for one match or for eight at once.
//!
//! The singular vector of the smallest singular value of a 4×4 matrix: the equations are
//! triangularized by Householder reflections, then inverse iteration with RᵀR converges in a few
//! steps, as the gap between the singular values is wide. Both forms give identical bits.

use crate::math::simd::dispatched;

/// Number of matches solved at once.
pub(super) const LANES: usize = 8;
/// Maximum number of inverse iteration steps.
const MAX_STEPS: usize = 12;
/// Change of direction, 1 − |cos|, below which the iteration ends.
const CONVERGED: f64 = 1e-15;

/// Row of a projection matrix, or homogeneous point.
pub(super) type Row = [f64; 4];

#[inline(always)]
pub(super) fn dot(a: &Row, b: &Row) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])
}

/// Returns the homogeneous point, with a length near 1 but not exactly; arbitrary for invalid
/// input.
///
/// * `pixels`: u1, v1, u2, v2
pub(super) fn null_point(p1: &[Row; 3], p2: &[Row; 3], pixels: [f64; 4]) -> Row {
    let factor = Factor::new(p1, p2, pixels);
    let mut x = factor.start();
    for _ in 0..MAX_STEPS {
        let next = factor.step(&x);
        let change = 1.0 - dot(&next, &x).abs();
        x = next;
        if change < CONVERGED {
            break;
        }
    }
    x
}

dispatched! {
    /// Solves [`null_point`] for eight matches: returns x0 to x3 of each.
    ///
    /// * `pixels`: u1, v1, u2, v2 of each
    pub(super) fn null_points(
        p1: &[Row; 3],
        p2: &[Row; 3],
        pixels: &[[f64; LANES]; 4],
    ) -> [[f64; LANES]; 4] {
        let (mut above, mut inverse) = ([[0.0; LANES]; 6], [[0.0; LANES]; 4]);
        let mut x = [[0.0; LANES]; 4];
        for l in 0..LANES {
            let pixels = [pixels[0][l], pixels[1][l], pixels[2][l], pixels[3][l]];
            let factor = Factor::new(p1, p2, pixels);
            let start = factor.start();
            for i in 0..6 {
                above[i][l] = factor.above[i];
            }
            for i in 0..4 {
                inverse[i][l] = factor.inverse[i];
                x[i][l] = start[i];
            }
        }
        // 1 while a match still changes, else 0: a mask of the same width as the values it selects.
        let mut moves = [1.0; LANES];
        for _ in 0..MAX_STEPS {
            let mut num_moving = 0.0;
            for l in 0..LANES {
                let factor = Factor {
                    above: [
                        above[0][l],
                        above[1][l],
                        above[2][l],
                        above[3][l],
                        above[4][l],
                        above[5][l],
                    ],
                    inverse: [inverse[0][l], inverse[1][l], inverse[2][l], inverse[3][l]],
                };
                let here = [x[0][l], x[1][l], x[2][l], x[3][l]];
                let next = factor.step(&here);
                let change = 1.0 - dot(&next, &here).abs();
                for i in 0..4 {
                    x[i][l] = if moves[l] > 0.0 { next[i] } else { here[i] };
                }
                moves[l] = if change < CONVERGED { 0.0 } else { moves[l] };
            }
            for l in 0..LANES {
                num_moving += moves[l];
            }
            if num_moving == 0.0 {
                break;
            }
        }
        x
    }
}

/// R of the QR decomposition of the four equations.
//
// No closures here: a closure is a separate function, compiled for the baseline only.
struct Factor {
    /// R01, R02, R03, R12, R13, R23.
    above: [f64; 6],
    /// Reciprocals of the diagonal.
    inverse: Row,
}

impl Factor {
    #[inline(always)]
    fn new(p1: &[Row; 3], p2: &[Row; 3], pixels: [f64; 4]) -> Self {
        let mut r = [
            equation(p1, pixels[0], 0),
            equation(p1, pixels[1], 1),
            equation(p2, pixels[2], 0),
            equation(p2, pixels[3], 1),
        ];
        reflect::<0>(&mut r);
        reflect::<1>(&mut r);
        reflect::<2>(&mut r);
        reflect::<3>(&mut r);
        // A zero on the diagonal is an exact null vector; a tiny number in its place leads there.
        // The last column has another unit, that of world lengths.
        let size = r[0][0].abs() + r[1][1].abs() + r[2][2].abs();
        let last_size = r[0][3].abs() + r[1][3].abs() + r[2][3].abs() + r[3][3].abs();
        let tiny = 1e-30 * size.max(f64::MIN_POSITIVE);
        let last_tiny = 1e-30 * last_size.max(f64::MIN_POSITIVE);
        Self {
            above: [r[0][1], r[0][2], r[0][3], r[1][2], r[1][3], r[2][3]],
            inverse: [
                reciprocal(r[0][0], tiny),
                reciprocal(r[1][1], tiny),
                reciprocal(r[2][2], tiny),
                reciprocal(r[3][3], last_tiny),
            ],
        }
    }

    /// Solves R x = e4, which is already the null vector of an exactly singular system.
    #[inline(always)]
    fn start(&self) -> Row {
        normalize_row(self.backward([0.0, 0.0, 0.0, 1.0]))
    }

    /// Solves RᵀR y = x for the direction of y.
    #[inline(always)]
    fn step(&self, x: &Row) -> Row {
        let [r01, r02, r03, r12, r13, r23] = self.above;
        let y0 = x[0] * self.inverse[0];
        let y1 = (x[1] - r01 * y0) * self.inverse[1];
        let y2 = (x[2] - r02 * y0 - r12 * y1) * self.inverse[2];
        let y3 = (x[3] - r03 * y0 - r13 * y1 - r23 * y2) * self.inverse[3];
        normalize_row(self.backward(normalize_row([y0, y1, y2, y3])))
    }

    /// Solves R x = b.
    #[inline(always)]
    fn backward(&self, b: Row) -> Row {
        let [r01, r02, r03, r12, r13, r23] = self.above;
        let x3 = b[3] * self.inverse[3];
        let x2 = (b[2] - r23 * x3) * self.inverse[2];
        let x1 = (b[1] - r12 * x2 - r13 * x3) * self.inverse[1];
        let x0 = (b[0] - r01 * x1 - r02 * x2 - r03 * x3) * self.inverse[0];
        [x0, x1, x2, x3]
    }
}

/// Returns the row of the equation `value P[2] X = P[axis] X`.
#[inline(always)]
fn equation(p: &[Row; 3], value: f64, axis: usize) -> Row {
    let mut row = [0.0; 4];
    for j in 0..4 {
        row[j] = value * p[2][j] - p[axis][j];
    }
    row
}

/// Clears column J below the diagonal by a Householder reflection.
#[inline(always)]
fn reflect<const J: usize>(a: &mut [Row; 4]) {
    let mut norm_sq = 0.0;
    for i in J..4 {
        norm_sq += a[i][J] * a[i][J];
    }
    let top = a[J][J];
    let norm = norm_sq.sqrt().copysign(top);
    let scale = 1.0 / (norm_sq + norm * top);
    let mut v = [0.0; 4];
    v[J] = top + norm;
    for i in J + 1..4 {
        v[i] = a[i][J];
    }
    for k in J..4 {
        let mut s = 0.0;
        for i in J..4 {
            s += v[i] * a[i][k];
        }
        let s = if norm_sq > 0.0 { s * scale } else { 0.0 };
        for i in J..4 {
            a[i][k] -= s * v[i];
        }
    }
}

#[inline(always)]
fn reciprocal(value: f64, tiny: f64) -> f64 {
    1.0 / if value.abs() > tiny { value } else { tiny }
}

#[inline(always)]
fn normalize_row(x: Row) -> Row {
    // Divide by the largest entry first, so that squares neither overflow nor underflow.
    let largest = x[0].abs().max(x[1].abs()).max(x[2].abs().max(x[3].abs()));
    let mut y = [0.0; 4];
    for i in 0..4 {
        y[i] = x[i] / largest;
    }
    let per_norm = 1.0 / dot(&y, &y).sqrt();
    for i in 0..4 {
        y[i] *= per_norm;
    }
    y
}
