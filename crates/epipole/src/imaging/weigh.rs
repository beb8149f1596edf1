//! Weighted sums of pixels, many at once.
//!
//! Sums have a fixed order, with symmetric kernels folded, and no pixel depends on the block in
//! which it is computed.

use super::kernel::{Kernel, Row, Symmetry};
use crate::math::simd::dispatched;
use std::ops::Range;

/// Number of pixels whose sums are kept in registers at once.
pub(super) const LANES: usize = 32;
/// The same for rows shorter than that; WebAssembly saves the code size, since only narrow images
/// need it.
const FEW: usize = if cfg!(target_arch = "wasm32") { 1 } else { 8 };

/// Fills `out` block by block; the last block may overlap the previous one.
//
// No closures here: a closure is a separate function, compiled for the baseline only.
macro_rules! in_blocks {
    ($kernel:expr, $r:expr, $taps:expr, $out:expr) => {{
        let n = $out.len();
        if n >= LANES {
            let mut x = 0;
            while x < n {
                block::<LANES>(x.min(n - LANES), $kernel, $r, $taps, $out);
                x += LANES;
            }
        } else if n >= FEW {
            let mut x = 0;
            while x < n {
                block::<FEW>(x.min(n - FEW), $kernel, $r, $taps, $out);
                x += FEW;
            }
        } else {
            for x in 0..n {
                block::<1>(x, $kernel, $r, $taps, $out);
            }
        }
    }};
}

dispatched! {
    pub(super) fn along_short<const R: usize>(kernel: &Kernel, row: &[f32], out: &mut [f32]) {
        in_blocks!(kernel, R, &Shifts(row), out);
    }
}
dispatched! {
    pub(super) fn along_any(kernel: &Kernel, row: &[f32], out: &mut [f32]) {
        in_blocks!(kernel, kernel.radius(), &Shifts(row), out);
    }
}
dispatched! {
    pub(super) fn across_short<const R: usize>(
        kernel: &Kernel,
        rows: &[Vec<f32>],
        from: usize,
        out: &mut [f32],
    ) {
        in_blocks!(kernel, R, &Rows(rows, from), out);
    }
}
dispatched! {
    pub(super) fn across_any(kernel: &Kernel, rows: &[Vec<f32>], from: usize, out: &mut [f32]) {
        in_blocks!(kernel, kernel.radius(), &Rows(rows, from), out);
    }
}
dispatched! {
    /// Filters in both directions at once, over a multiple of `LANES` columns; a kernel that is not
    /// even is odd.
    pub(super) fn both<const R: usize, const EVEN_ALONG: bool, const EVEN_ACROSS: bool>(
        kernels: [&Kernel; 2],
        row: &[f32],
        columns: Range<usize>,
        rows: &mut [Vec<f32>],
        out: &mut Row,
    ) {
        let (older, newest) = rows.split_at_mut(2 * R);
        let newest = &mut newest[0][columns.clone()];
        let [along, across] = kernels.map(|kernel| &kernel.weights[..2 * R + 1]);
        for (k, newest) in newest.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
            let x = k * LANES;
            *newest = if EVEN_ALONG {
                even(along, R, &Shifts(row), x)
            } else {
                odd(along, R, &Shifts(row), x)
            };
            let (x, taps) = (columns.start + x, OnTop(older, newest));
            let sums: [f32; LANES] = if EVEN_ACROSS {
                even(across, R, &taps, x)
            } else {
                odd(across, R, &taps, x)
            };
            match out {
                Row::Over(out) => out[x..x + LANES].copy_from_slice(&sums),
                Row::End(list) => list.extend_from_slice(&sums),
            }
        }
    }
}

/// Input of a kernel.
trait Taps<const L: usize> {
    /// Returns L values of tap k, starting at pixel x.
    fn at(&self, k: usize, x: usize) -> &[f32; L];
}

/// A row, with each tap one pixel further on.
struct Shifts<'a>(&'a [f32]);

impl<const L: usize> Taps<L> for Shifts<'_> {
    #[inline(always)]
    fn at(&self, k: usize, x: usize) -> &[f32; L] {
        lanes(self.0, k + x)
    }
}

/// Several rows, from a column on.
struct Rows<'a>(&'a [Vec<f32>], usize);

impl<const L: usize> Taps<L> for Rows<'_> {
    #[inline(always)]
    fn at(&self, k: usize, x: usize) -> &[f32; L] {
        lanes(&self.0[k], self.1 + x)
    }
}

/// Several rows, and the values of one more.
struct OnTop<'a, const L: usize>(&'a [Vec<f32>], &'a [f32; L]);

impl<const L: usize> Taps<L> for OnTop<'_, L> {
    #[inline(always)]
    fn at(&self, k: usize, x: usize) -> &[f32; L] {
        if k == self.0.len() {
            self.1
        } else {
            lanes(&self.0[k], x)
        }
    }
}

#[inline(always)]
fn lanes<const L: usize>(slice: &[f32], from: usize) -> &[f32; L] {
    slice[from..from + L]
        .try_into()
        .expect("the slice has this length")
}

/// Computes `out[x] = Σ weights[k] taps[k][x]` for L pixels.
#[inline(always)]
fn block<const L: usize>(
    x: usize,
    kernel: &Kernel,
    r: usize,
    taps: &impl Taps<L>,
    out: &mut [f32],
) {
    let weights = &kernel.weights[..2 * r + 1];
    let sums = match kernel.symmetry {
        Symmetry::Even => even(weights, r, taps, x),
        Symmetry::Odd => odd(weights, r, taps, x),
        Symmetry::None => {
            let mut sums = [0.0; L];
            for k in 0..2 * r + 1 {
                let tap = taps.at(k, x);
                for i in 0..L {
                    sums[i] += weights[k] * tap[i];
                }
            }
            sums
        }
    };
    out[x..x + L].copy_from_slice(&sums);
}

#[inline(always)]
fn even<const L: usize>(weights: &[f32], r: usize, taps: &impl Taps<L>, x: usize) -> [f32; L] {
    let middle = taps.at(r, x);
    let mut sums = [0.0; L];
    for i in 0..L {
        sums[i] = weights[r] * middle[i];
    }
    for j in 1..=r {
        let (a, b) = (taps.at(r - j, x), taps.at(r + j, x));
        for i in 0..L {
            sums[i] += weights[r + j] * (a[i] + b[i]);
        }
    }
    sums
}

#[inline(always)]
fn odd<const L: usize>(weights: &[f32], r: usize, taps: &impl Taps<L>, x: usize) -> [f32; L] {
    let mut sums = [0.0; L];
    for j in 1..=r {
        let (a, b) = (taps.at(r - j, x), taps.at(r + j, x));
        for i in 0..L {
            sums[i] += weights[r + j] * (b[i] - a[i]);
        }
    }
    sums
}
