//! Squared distances between descriptors of floats.
//!
//! Eight descriptors of the first list are interleaved, one per lane. Squared differences are
//! summed, as subtracting squared lengths would lose precision for near neighbors.

use super::neighbors::Scanned;
use crate::math::simd::dispatched;

/// Number of descriptors of the second list in a tile.
const TILE: usize = 64;

/// Second list.
pub(super) struct Floats {
    dimension: usize,
    values: Vec<f32>,
}

/// Two nearest neighbors so far of eight descriptors.
#[derive(Clone, Copy)]
struct Eight {
    near: [f32; 8],
    second: [f32; 8],
    index: [usize; 8],
}

impl Floats {
    pub(super) fn new(values: Vec<f32>, dimension: usize) -> Self {
        Self { dimension, values }
    }

    pub(super) fn count(&self) -> usize {
        self.values.len() / self.dimension
    }

    /// Returns the two nearest neighbors of each descriptor in a piece of the first list.
    pub(super) fn scan(&self, piece: &[f32]) -> Scanned<f32> {
        let n = self.dimension;
        let count = piece.len() / n;
        let mut packed = vec![[0.0f32; 8]; count.div_ceil(8) * n];
        for (k, row) in piece.chunks_exact(n).enumerate() {
            for (i, &value) in row.iter().enumerate() {
                packed[k / 8 * n + i][k % 8] = value;
            }
        }
        let nothing = Eight {
            near: [f32::INFINITY; 8],
            second: [f32::INFINITY; 8],
            index: [0; 8],
        };
        let mut rows = vec![nothing; count.div_ceil(8)];
        let mut columns = vec![(f32::INFINITY, 0); self.count()];
        for tile in (0..self.count()).step_by(TILE) {
            let tile_end = (tile + TILE).min(self.count());
            for (group, eight) in packed.chunks_exact(n).enumerate() {
                let lanes = (count - 8 * group).min(8);
                for column in (tile..tile_end).step_by(4) {
                    // Repeated descriptors fill the last group of four; they are not counted twice.
                    let last = tile_end - 1;
                    let plain = |j: usize| {
                        let at = (column + j).min(last) * n;
                        &self.values[at..at + n]
                    };
                    let squares = squares(eight, [plain(0), plain(1), plain(2), plain(3)]);
                    for j in 0..(tile_end - column).min(4) {
                        let held = &mut columns[column + j];
                        improve(
                            &mut rows[group],
                            held,
                            &squares[j][..lanes],
                            column + j,
                            group,
                        );
                    }
                }
            }
        }
        let rows = (0..count).map(|k| {
            let (eight, lane) = (&rows[k / 8], k % 8);
            (eight.index[lane], eight.near[lane], eight.second[lane])
        });
        Scanned {
            rows: rows.collect(),
            columns,
        }
    }
}

dispatched! {
    fn squares(eight: &[[f32; 8]], four: [&[f32]; 4]) -> [[f32; 8]; 4] {
        let n = eight.len();
        let four = [&four[0][..n], &four[1][..n], &four[2][..n], &four[3][..n]];
        let mut sums = [[0.0f32; 8]; 4];
        for k in 0..n {
            for j in 0..4 {
                let value = four[j][k];
                for lane in 0..8 {
                    let difference = eight[k][lane] - value;
                    sums[j][lane] += difference * difference;
                }
            }
        }
        sums
    }
}

#[inline]
fn improve(
    rows: &mut Eight,
    best: &mut (f32, usize),
    squares: &[f32],
    column: usize,
    group: usize,
) {
    for (lane, &d) in squares.iter().enumerate() {
        if d < rows.near[lane] {
            rows.second[lane] = rows.near[lane];
            rows.near[lane] = d;
            rows.index[lane] = column;
        } else if d < rows.second[lane] {
            rows.second[lane] = d;
        }
        if d < best.0 {
            *best = (d, 8 * group + lane);
        }
    }
}
