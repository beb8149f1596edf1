//! The 4×4×8 histogram of gradients around a keypoint.

use super::SiftNormalization;
use crate::imaging::GrayImage32;
use crate::imaging::approx::{atan2, exp_negative};
use crate::imaging::simd::dispatched;
use std::f32::consts::TAU;

/// Cells along a side of the descriptor.
const CELLS: usize = 4;
/// Directions in a cell.
const BINS: usize = 8;
/// A cell's side in units of the keypoint's blur.
const CELL_SIGMAS: f32 = 3.0;

/// Sums of weighted gradients in 4×4 cells of 8 directions, in the keypoint's own frame.
///
/// Each gradient is shared by the neighboring cells and directions (trilinear), and weighs less
/// away from the middle: a Gaussian whose standard deviation is two cells.
///
/// Source: Lowe 2004, §6.1.
pub(super) fn histogram(
    layer: &GrayImage32,
    center: (f32, f32),
    sigma: f32,
    angle_rad: f32,
) -> [f32; 128] {
    // One cell of margin all around takes what is shared outwards.
    let mut sums = [0.0f32; (CELLS + 2) * (CELLS + 2) * BINS];
    let cell = CELL_SIGMAS * sigma;
    let (cos, sin) = (libm::cosf(angle_rad) / cell, libm::sinf(angle_rad) / cell);
    // Half the side of the square that can contribute, in cells.
    let half = 0.5 * (CELLS as f32 + 1.0);
    let radius = half * cell * std::f32::consts::SQRT_2;
    let falloff = -0.5 / (0.5 * CELLS as f32 * cell * 0.5 * CELLS as f32 * cell);
    let mut scratch = Scratch::default();
    let square = Samples::new(layer, center, radius);
    square.for_each_row(
        &mut scratch,
        |dy| {
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
        },
        |samples| {
            samples.gradients(falloff);
            samples.bins(cos, sin, angle_rad);
            samples.scatter(&mut sums);
        },
    );
    let mut out = [0.0; 128];
    for (k, value) in out.iter_mut().enumerate() {
        let (row, column, bin) = (k / 32, k / 8 % 4, k % 8);
        *value = sums[((row + 1) * (CELLS + 2) + column + 1) * BINS + bin];
    }
    out
}

/// 512 times the normalized sums, cut at 255.
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

/// A sum in eight lanes, the same order everywhere.
fn lanes_sum(values: &[f32; 128], f: impl Fn(f32) -> f32) -> f32 {
    let mut lanes = [0.0f32; 8];
    for chunk in values.as_chunks::<8>().0 {
        for (lane, &v) in lanes.iter_mut().zip(chunk) {
            *lane += f(v);
        }
    }
    lanes.iter().sum()
}

/// The samples of a layer within reach of a place, row by row.
pub(super) struct Samples<'a> {
    values: &'a [f32],
    width: usize,
    height: usize,
    center: (f32, f32),
    radius: f32,
}

/// One row of samples: gradients and what is made of them.
#[derive(Default)]
pub(super) struct Scratch {
    du: Vec<f32>,
    dv: Vec<f32>,
    /// Offset from the place along u; that along v is `dy`.
    dx: Vec<f32>,
    dy: f32,
    /// Magnitude times falloff.
    pub(super) weight: Vec<f32>,
    /// Direction in [−π, π].
    pub(super) angle: Vec<f32>,
    column: Vec<f32>,
    row: Vec<f32>,
    bin: Vec<f32>,
}

impl<'a> Samples<'a> {
    pub(super) fn new(layer: &'a GrayImage32, center: (f32, f32), radius: f32) -> Self {
        Self {
            values: layer.as_raw(),
            width: layer.width() as usize,
            height: layer.height() as usize,
            center,
            radius,
        }
    }

    /// Visits each row; `interval` gives the range of offsets along u for an offset along v.
    /// Samples on the layer's edge have no gradient and are left out.
    pub(super) fn for_each_row(
        &self,
        scratch: &mut Scratch,
        interval: impl Fn(f32) -> (f32, f32),
        mut visit: impl FnMut(&mut Scratch),
    ) {
        let (cx, cy) = self.center;
        let first = ((cy - self.radius).ceil().max(1.0)) as usize;
        let last = ((cy + self.radius).floor().min(self.height as f32 - 2.0)) as usize;
        for y in first..=last {
            let dy = y as f32 - cy;
            let (low, high) = interval(dy);
            let from = (cx + low).ceil().max(1.0) as usize;
            let to = (cx + high).floor().min(self.width as f32 - 2.0);
            if low > high || to < from as f32 {
                continue;
            }
            let n = to as usize - from + 1;
            let at = y * self.width + from;
            for list in [
                &mut scratch.du,
                &mut scratch.dv,
                &mut scratch.dx,
                &mut scratch.weight,
                &mut scratch.angle,
                &mut scratch.column,
                &mut scratch.row,
                &mut scratch.bin,
            ] {
                list.resize(n, 0.0);
            }
            scratch.dy = dy;
            let left = &self.values[at - 1..at - 1 + n];
            let right = &self.values[at + 1..at + 1 + n];
            let above = &self.values[at - self.width..at - self.width + n];
            let below = &self.values[at + self.width..at + self.width + n];
            differences(left, right, &mut scratch.du);
            differences(above, below, &mut scratch.dv);
            for (k, dx) in scratch.dx.iter_mut().enumerate() {
                *dx = (from + k) as f32 - cx;
            }
            visit(scratch);
        }
    }
}

impl Scratch {
    pub(super) fn len(&self) -> usize {
        self.dx.len()
    }

    /// Direction and weighted magnitude of each gradient.
    pub(super) fn gradients(&mut self, falloff: f32) {
        let dy_sq = self.dy * self.dy;
        polar(
            &self.du,
            &self.dv,
            &self.dx,
            dy_sq,
            falloff,
            &mut self.weight,
            &mut self.angle,
        );
    }

    /// Where each sample falls in the descriptor: cells from −1 to 4, directions from 0 to 8.
    fn bins(&mut self, cos: f32, sin: f32, angle_rad: f32) {
        rotate(&self.dx, self.dy, cos, sin, &mut self.column, &mut self.row);
        turn(&self.angle, angle_rad, &mut self.bin);
    }

    fn scatter(&self, sums: &mut [f32; (CELLS + 2) * (CELLS + 2) * BINS]) {
        const STRIDE: usize = (CELLS + 2) * BINS;
        for k in 0..self.len() {
            let (column, row, bin) = (self.column[k], self.row[k], self.bin[k]);
            // Offset by one cell, all are in 0..5; rounding may reach the ends.
            let (c, r, b) = (column as usize, row as usize, bin as usize);
            let (c, r, b) = (c.min(CELLS), r.min(CELLS), b & (BINS - 1));
            let (fc, fr, fb) = (column - c as f32, row - r as f32, bin - bin as usize as f32);
            let weight = self.weight[k];
            let (w1, b1) = (weight * fr, (b + 1) & (BINS - 1));
            let w0 = weight - w1;
            let at = r * STRIDE + c * BINS;
            for (from, w) in [(at, w0), (at + STRIDE, w1)] {
                let right = w * fc;
                let left = w - right;
                let cells = &mut sums[from..from + 2 * BINS];
                let (ahead_l, ahead_r) = (left * fb, right * fb);
                cells[b] += left - ahead_l;
                cells[b1] += ahead_l;
                cells[BINS + b] += right - ahead_r;
                cells[BINS + b1] += ahead_r;
            }
        }
    }
}

dispatched! {
    fn differences(from: &[f32], to: &[f32], out: &mut [f32]) {
        for ((out, a), b) in out.iter_mut().zip(to).zip(from) {
            *out = a - b;
        }
    }
}
dispatched! {
    fn polar(
        du: &[f32], dv: &[f32], dx: &[f32], dy_sq: f32, falloff: f32,
        weight: &mut [f32], angle: &mut [f32],
    ) {
        let n = weight.len();
        let (du, dv, dx, angle) = (&du[..n], &dv[..n], &dx[..n], &mut angle[..n]);
        for k in 0..n {
            let magnitude = (du[k] * du[k] + dv[k] * dv[k]).sqrt();
            weight[k] = magnitude * exp_negative(falloff * (dx[k] * dx[k] + dy_sq));
            angle[k] = atan2(dv[k], du[k]);
        }
    }
}
dispatched! {
    fn rotate(dx: &[f32], dy: f32, cos: f32, sin: f32, column: &mut [f32], row: &mut [f32]) {
        let n = dx.len();
        let (column, row) = (&mut column[..n], &mut row[..n]);
        // The middle of the four cells is between the second and the third, one cell of margin.
        let middle = 0.5 * (CELLS as f32 - 1.0) + 1.0;
        let (across, down) = (dy * sin + middle, dy * cos + middle);
        for k in 0..n {
            column[k] = dx[k] * cos + across;
            row[k] = down - dx[k] * sin;
        }
    }
}
dispatched! {
    fn turn(angle: &[f32], from: f32, bin: &mut [f32]) {
        let n = angle.len();
        let bin = &mut bin[..n];
        for k in 0..n {
            let mut turned = (angle[k] - from) * (BINS as f32 / TAU);
            turned = if turned < 0.0 { turned + BINS as f32 } else { turned };
            bin[k] = if turned >= BINS as f32 { turned - BINS as f32 } else { turned };
        }
    }
}
