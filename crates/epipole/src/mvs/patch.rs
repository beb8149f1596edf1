//! Photo-consistency: weighted correlation of a patch with its projection in a neighbor.

use super::level::Level;
use super::pair::Affine;
use crate::math::simd::dispatched;

/// Number of samples of a patch.
const LEN: usize = 32;
const LANES: usize = 8;
/// Standard deviation of the weight by distance, pixels.
const SIGMA_PX: f32 = 5.0;
/// Standard deviation of the weight by gray difference.
const SIGMA_GRAY: f32 = 30.0;
/// Gray variance due to noise and rounding; with it, flat patches fit nothing.
const NOISE: f32 = 3.0;

/// Every other pixel of 11 × 11, without the corners: columns and rows relative to the middle.
const OFFSETS: [[f32; LEN]; 2] = offsets();

const fn offsets() -> [[f32; LEN]; 2] {
    let mut offsets = [[0.0; LEN]; 2];
    let (mut row, mut place) = (0, 0);
    while row < 6 {
        let mut column = 0;
        while column < 6 {
            if !((row == 0 || row == 5) && (column == 0 || column == 5)) {
                offsets[0][place] = 2.0 * column as f32 - 5.0;
                offsets[1][place] = 2.0 * row as f32 - 5.0;
                place += 1;
            }
            column += 1;
        }
        row += 1;
    }
    offsets
}

/// Weights of samples by position, not normalized.
const PLACES: [f32; LEN] = places();

const fn places() -> [f32; LEN] {
    let mut places = [0.0; LEN];
    let mut k = 0;
    while k < LEN {
        let [u, v] = [OFFSETS[0][k], OFFSETS[1][k]];
        // 1/(1 + t + t²/2) equals exp(−t) to a few percent, and `exp` is not `const`.
        let t = 0.5 * (u * u + v * v) / (SIGMA_PX * SIGMA_PX);
        places[k] = 1.0 / (1.0 + t + 0.5 * t * t);
        k += 1;
    }
    places
}

/// Weights by gray difference.
pub(super) type GrayWeights = [f32; 256];

pub(super) fn gray_weights() -> GrayWeights {
    std::array::from_fn(|difference| {
        let t = difference as f32 / SIGMA_GRAY;
        libm::expf(-0.5 * t * t)
    })
}

/// Samples around a pixel.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    /// Weights, with sum 1.
    weights: [f32; LEN],
    /// Weighted differences from the mean.
    differences: [f32; LEN],
    mean: f32,
    variance: f32,
}

impl Patch {
    #[inline]
    pub(super) fn new(level: &Level, gray_weights: &GrayWeights, u: usize, v: usize) -> Self {
        let center = level.gray(u as isize, v as isize);
        let (mut grays, mut weights) = ([0.0f32; LEN], [0.0f32; LEN]);
        let [us, vs] = &OFFSETS;
        for k in 0..LEN {
            let gray = level.gray(u as isize + us[k] as isize, v as isize + vs[k] as isize);
            grays[k] = f32::from(gray);
            weights[k] = PLACES[k] * gray_weights[usize::from(gray.abs_diff(center))];
        }
        weigh(&grays, weights)
    }
}

dispatched! {
    fn weigh(grays: &[f32; LEN], weights: [f32; LEN]) -> Patch {
        let total = 1.0 / sum(&weights);
        let mut weights = weights;
        let mut weighted = [0.0f32; LEN];
        for k in 0..LEN {
            weights[k] *= total;
            weighted[k] = weights[k] * grays[k];
        }
        let mean = sum(&weighted);
        let (mut differences, mut squares) = ([0.0f32; LEN], [0.0f32; LEN]);
        for k in 0..LEN {
            differences[k] = weights[k] * (grays[k] - mean);
            squares[k] = differences[k] * (grays[k] - mean);
        }
        Patch {
            weights,
            differences,
            mean,
            variance: sum(&squares),
        }
    }
}

/// Sums in a fixed order that suits vector instructions.
#[inline(always)]
fn sum(values: &[f32; LEN]) -> f32 {
    let mut lanes = [0.0f32; LANES];
    for (k, lane) in lanes.iter_mut().enumerate() {
        *lane = (values[k] + values[k + 8]) + (values[k + 16] + values[k + 24]);
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// Between this number and its double, floats are the integers.
const WHOLE: f32 = 8_388_608.0;

/// Clamps a coordinate to `0..=last` and splits it into fraction and integer, by operations that
/// vectorize.
#[inline(always)]
fn split(x: f32, last: f32) -> (f32, u32) {
    let x = if x > 0.0 { x } else { 0.0 };
    let x = if x < last { x } else { last };
    let nearest = (x + WHOLE) - WHOLE;
    let below = nearest - if nearest > x { 1.0 } else { 0.0 };
    (x - below, (below + WHOLE).to_bits() & 0x7f_ffff)
}

dispatched! {
    /// Returns one minus the weighted correlation of a patch with its affine projection in `other`,
    /// 0 to 2. Border pixels are repeated outside the image.
    pub(super) fn dissimilarity(patch: &Patch, other: &Level, at: &Affine) -> f32 {
        let [us, vs] = &OFFSETS;
        let (last_x, last_y) = (other.width as f32 - 1.0, other.height as f32 - 1.0);
        let ([x0, y0], [xu, xv, yu, yv]) = (at.center, at.matrix);
        // Wrapping, as vectorized code cannot check for overflow.
        let width = other.width as u32;
        let (mut places, mut fu, mut fv) = ([0u32; LEN], [0.0f32; LEN], [0.0f32; LEN]);
        for k in 0..LEN {
            let (x, column) = split(x0 + xu * us[k] + xv * vs[k], last_x);
            let (y, row) = split(y0 + yu * us[k] + yv * vs[k], last_y);
            (fu[k], fv[k]) = (x, y);
            places[k] = row.wrapping_mul(width).wrapping_add(column);
        }
        let mut quads = [0u32; LEN];
        for k in 0..LEN {
            quads[k] = other.quads[places[k] as usize];
        }
        let (mut means, mut squares, mut products) = ([0.0f32; LEN], [0.0f32; LEN], [0.0f32; LEN]);
        for k in 0..LEN {
            let quad = quads[k];
            let byte = |shift: u32| (quad >> shift & 255) as i32 as f32;
            let (a, b, c, d) = (byte(0), byte(8), byte(16), byte(24));
            let top = a + fu[k] * (b - a);
            let bottom = c + fu[k] * (d - c);
            // The means are similar in both images, so subtracting this one preserves the
            // variance's precision.
            let value = top + fv[k] * (bottom - top) - patch.mean;
            let weighted = patch.weights[k] * value;
            means[k] = weighted;
            squares[k] = weighted * value;
            products[k] = patch.differences[k] * value;
        }
        let mean = sum(&means);
        let variance = sum(&squares) - mean * mean;
        let variance = if variance > 0.0 { variance } else { 0.0 };
        let spread = ((patch.variance + NOISE) * (variance + NOISE)).sqrt();
        1.0 - sum(&products) / spread
    }
}
