//! The 4×4×8 histogram of gradients around a keypoint.

use super::options::SiftNormalization;
use crate::imaging::GrayImage32;
use crate::imaging::approx::{atan2, exp_negative};
use crate::math::simd::dispatched;
use std::f32::consts::TAU;

/// Number of cells along a side of the descriptor.
const CELLS: usize = 4;
/// Number of directions per cell.
const BINS: usize = 8;
/// Number of sums in a row of cells with its margin, and in all rows.
const STRIDE: usize = (CELLS + 2) * BINS;
const NUM_SUMS: usize = (CELLS + 2) * STRIDE;
/// Side of a cell in units of the keypoint's blur.
const CELL_SIGMAS: f32 = 3.0;

/// Computes sums of weighted gradients in 4×4 cells of 8 directions, in the keypoint's frame.
///
/// Each gradient is distributed to the neighboring cells and directions (trilinear), and weighted
/// by a Gaussian whose standard deviation is two cells.
///
/// Source: Lowe 2004, §6.1.
pub(super) fn histogram(
    layer: &GrayImage32,
    center: (f32, f32),
    sigma: f32,
    angle_rad: f32,
    scratch: &mut Samples,
) -> [f32; 128] {
    // A margin of one cell receives the outward contributions.
    let mut sums = Aligned([0.0f32; NUM_SUMS]);
    let cell = CELL_SIGMAS * sigma;
    let (cos, sin) = (libm::cosf(angle_rad) / cell, libm::sinf(angle_rad) / cell);
    // Half the side of the square that can contribute, in cells.
    let half = 0.5 * (CELLS as f32 + 1.0);
    let radius = half * cell * std::f32::consts::SQRT_2;
    let falloff = -0.5 / (0.5 * CELLS as f32 * cell * 0.5 * CELLS as f32 * cell);
    scratch.collect(layer, center, radius, |dy| {
        // −half < x cos + y sin < half and −half < y cos − x sin < half, solved for x.
        let (mut low, mut high) = (-radius, radius);
        for (slope, offset) in [(cos, dy * sin), (-sin, dy * cos)] {
            if slope.abs() > 1e-6 {
                let (a, b) = ((-half - offset) / slope, (half - offset) / slope);
                low = low.max(a.min(b));
                high = high.min(a.max(b));
            } else if offset.abs() >= half {
                return (1.0, 0.0);
            }
        }
        (low, high)
    });
    scratch.polar(falloff);
    scratch.place(cos, sin, angle_rad);
    scratch.scatter(&mut sums.0);
    let mut out = [0.0; 128];
    for (k, value) in out.iter_mut().enumerate() {
        let (row, column, bin) = (k / 32, k / 8 % 4, k % 8);
        *value = sums.0[((row + 1) * (CELLS + 2) + column + 1) * BINS + bin];
    }
    out
}

/// Returns 512 times the normalized sums, clipped at 255.
pub(super) fn normalize(mut sums: [f32; 128], kind: SiftNormalization) -> [u8; 128] {
    match kind {
        SiftNormalization::L2 => {
            let norm = length(&sums);
            let cap = 0.2 * norm;
            for v in &mut sums {
                *v = v.min(cap);
            }
            let norm = length(&sums);
            let scale = if norm > 0.0 { 512.0 / norm } else { 0.0 };
            sums.map(|v| (v * scale + 0.5) as u8)
        }
        SiftNormalization::Root => {
            let total: f32 = lanes_sum(&sums, |v| v);
            let scale = if total > 0.0 { 1.0 / total } else { 0.0 };
            sums.map(|v| (512.0 * (v * scale).sqrt() + 0.5) as u8)
        }
    }
}

fn length(sums: &[f32; 128]) -> f32 {
    lanes_sum(sums, |v| v * v).sqrt()
}

/// Sums in eight lanes, in a fixed order on every platform.
fn lanes_sum(values: &[f32; 128], f: impl Fn(f32) -> f32) -> f32 {
    let mut lanes = [0.0f32; 8];
    for chunk in values.as_chunks::<8>().0 {
        for (lane, &v) in lanes.iter_mut().zip(chunk) {
            *lane += f(v);
        }
    }
    lanes.iter().sum()
}

/// Samples of a layer around a position: gradients and derived values. Lists are filled first and
/// processed as a whole, so that the loops vectorize.
#[derive(Default)]
pub(super) struct Samples {
    /// Twice the derivative along u.
    du: Vec<f32>,
    dv: Vec<f32>,
    /// Offset from the position along u.
    dx: Vec<f32>,
    dy: Vec<f32>,
    /// Gradient magnitude times falloff.
    pub(super) weight: Vec<f32>,
    /// Gradient direction in [−π, π].
    pub(super) angle: Vec<f32>,
    /// Index into the sums of the first cell that a sample contributes to; then the fractions for
    /// the next cell along u and v.
    cell: Vec<u32>,
    right: Vec<f32>,
    down: Vec<f32>,
    /// First of the two directions; then the fraction for the next.
    bin: Vec<u32>,
    ahead: Vec<f32>,
}

impl Samples {
    /// Collects the samples of each row whose offset along u lies in the interval for the row's
    /// offset along v. Samples on the layer's border have no gradient and are left out.
    pub(super) fn collect(
        &mut self,
        layer: &GrayImage32,
        (cx, cy): (f32, f32),
        radius: f32,
        interval: impl Fn(f32) -> (f32, f32),
    ) {
        let (values, width) = (layer.as_raw(), layer.width() as usize);
        for list in [&mut self.du, &mut self.dv, &mut self.dx, &mut self.dy] {
            list.clear();
        }
        let first = ((cy - radius).ceil().max(1.0)) as usize;
        let last = ((cy + radius).floor().min(layer.height() as f32 - 2.0)) as usize;
        for y in first..=last {
            let dy = y as f32 - cy;
            let (low, high) = interval(dy);
            let from = (cx + low).ceil().max(1.0) as usize;
            let to = (cx + high).floor().min(width as f32 - 2.0);
            if low > high || to < from as f32 {
                continue;
            }
            let n = to as usize - from + 1;
            let at = y * width + from;
            let row = |start: usize| &values[start..start + n];
            let difference = |(a, b): (&f32, &f32)| b - a;
            self.du
                .extend(row(at - 1).iter().zip(row(at + 1)).map(difference));
            self.dv
                .extend(row(at - width).iter().zip(row(at + width)).map(difference));
            self.dx
                .extend((0..n as u16).map(|k| f32::from(k) + (from as f32 - cx)));
            self.dy.resize(self.dx.len(), dy);
        }
    }

    /// Computes direction and weighted magnitude of each gradient.
    pub(super) fn polar(&mut self, falloff: f32) {
        let n = self.dx.len();
        self.weight.resize(n, 0.0);
        self.angle.resize(n, 0.0);
        let gradients = [&self.du[..], &self.dv, &self.dx, &self.dy];
        polar(gradients, falloff, &mut self.weight, &mut self.angle);
    }

    /// Computes the cells and directions of each sample.
    fn place(&mut self, cos: f32, sin: f32, angle_rad: f32) {
        let n = self.dx.len();
        for list in [&mut self.right, &mut self.down, &mut self.ahead] {
            list.resize(n, 0.0);
        }
        self.cell.resize(n, 0);
        self.bin.resize(n, 0);
        let fractions = [&mut self.right[..], &mut self.down];
        place(&self.dx, &self.dy, cos, sin, &mut self.cell, fractions);
        orientation_bins(&self.angle, angle_rad, &mut self.bin, &mut self.ahead);
    }

    fn scatter(&self, sums: &mut [f32; NUM_SUMS]) {
        let n = self.dx.len();
        let fractions = [&self.right[..n], &self.down[..n], &self.ahead[..n]];
        scatter(
            &self.weight[..n],
            &self.cell[..n],
            &self.bin[..n],
            fractions,
            sums,
        );
    }
}

/// Alignment that keeps cells within cache lines.
#[repr(align(32))]
struct Aligned<T>(T);

/// 1 for one direction of a cell, 0 for the others.
static ONE_OF: Aligned<[[f32; BINS]; BINS]> = {
    let mut table = [[0.0; BINS]; BINS];
    let mut k = 0;
    while k < BINS {
        table[k][k] = 1.0;
        k += 1;
    }
    Aligned(table)
};

/// Splits x in [0, 8] into integer and fraction. An integer x may become x − 1 and 1, which
/// distributes a sample in the same way. Adding 1.5 · 2²³ rounds without a function call.
#[inline(always)]
fn whole_and_rest(x: f32) -> (u32, f32) {
    const ROUND: f32 = 12_582_912.0;
    let shifted = (x - 0.5) + ROUND;
    let whole = shifted - ROUND;
    let whole = if whole > 0.0 { whole } else { 0.0 };
    ((whole + ROUND).to_bits() - ROUND.to_bits(), x - whole)
}

dispatched! {
    fn polar(gradients: [&[f32]; 4], falloff: f32, weight: &mut [f32], angle: &mut [f32]) {
        let n = weight.len();
        let [du, dv, dx, dy] = gradients;
        let (du, dv, dx, dy) = (&du[..n], &dv[..n], &dx[..n], &dy[..n]);
        let angle = &mut angle[..n];
        for k in 0..n {
            let magnitude = (du[k] * du[k] + dv[k] * dv[k]).sqrt();
            weight[k] = magnitude * exp_negative(falloff * (dx[k] * dx[k] + dy[k] * dy[k]));
            angle[k] = atan2(dv[k], du[k]);
        }
    }
}
dispatched! {
    fn place(
        dx: &[f32], dy: &[f32], cos: f32, sin: f32, cell: &mut [u32], fractions: [&mut [f32]; 2],
    ) {
        let n = dx.len();
        let [right, down] = fractions;
        let (dy, cell) = (&dy[..n], &mut cell[..n]);
        let (right, down) = (&mut right[..n], &mut down[..n]);
        // The middle of the four cells is between the second and the third, plus one cell of
        // margin.
        let middle = 0.5 * (CELLS as f32 - 1.0) + 1.0;
        for k in 0..n {
            let (column, fc) = whole_and_rest(dx[k] * cos + (dy[k] * sin + middle));
            let (row, fr) = whole_and_rest((dy[k] * cos + middle) - dx[k] * sin);
            // Rounding at the border of the square may reach one cell too far.
            let (column, row) = (column.min(CELLS as u32), row.min(CELLS as u32));
            cell[k] = row * STRIDE as u32 + column * BINS as u32;
            right[k] = fc;
            down[k] = fr;
        }
    }
}
dispatched! {
    fn orientation_bins(angle: &[f32], from: f32, bin: &mut [u32], ahead: &mut [f32]) {
        let n = angle.len();
        let (bin, ahead) = (&mut bin[..n], &mut ahead[..n]);
        for k in 0..n {
            let position = (angle[k] - from) * (BINS as f32 / TAU);
            let position = if position < 0.0 { position + BINS as f32 } else { position };
            (bin[k], ahead[k]) = whole_and_rest(position);
        }
    }
}
dispatched! {
    /// Adds each sample to its four cells: all directions of a cell at once, most of them with 0.
    fn scatter(
        weight: &[f32], cell: &[u32], bin: &[u32], fractions: [&[f32]; 3], sums: &mut [f32; NUM_SUMS],
    ) {
        let n = weight.len();
        let [right, down, ahead] = fractions;
        let (cell, bin) = (&cell[..n], &bin[..n]);
        let (right, down, ahead) = (&right[..n], &down[..n], &ahead[..n]);
        for k in 0..n {
            let b = bin[k] as usize;
            let (here, next) = (&ONE_OF.0[b % BINS], &ONE_OF.0[(b + 1) % BINS]);
            let mut directions = [0.0f32; BINS];
            for i in 0..BINS {
                directions[i] = here[i] * (1.0 - ahead[k]) + next[i] * ahead[k];
            }
            let lower = weight[k] * down[k];
            let upper = weight[k] - lower;
            let from = cell[k] as usize;
            let around = &mut sums[from..from + STRIDE + 2 * BINS];
            let (top, bottom) = around.split_at_mut(STRIDE);
            let (lr, ur) = (lower * right[k], upper * right[k]);
            let (ll, ul) = (lower - lr, upper - ur);
            for i in 0..BINS {
                top[i] += ul * directions[i];
            }
            for i in 0..BINS {
                top[BINS + i] += ur * directions[i];
            }
            for i in 0..BINS {
                bottom[i] += ll * directions[i];
            }
            for i in 0..BINS {
                bottom[BINS + i] += lr * directions[i];
            }
        }
    }
}
