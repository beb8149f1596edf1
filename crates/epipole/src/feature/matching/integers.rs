//! Squared distances between byte descriptors, in integers.
//!
//! Eight descriptors of the first list are interleaved, so that a vector instruction processes all
//! eight and no sum is taken across a vector. `|a − b|² = |a|² + |b|² − 2 a·b` is exact here.

use super::neighbors::Scanned;

/// Number of descriptors of the second list in a tile: with pairs of 128 numbers they fill 16 KiB.
const TILE: usize = 64;

/// Squared length of padding descriptors: larger than any actual one (4096 · 255² = 2.7 · 10⁸), yet
/// the sum of two fits.
const FILLER: i32 = 1 << 29;

/// Second list.
pub(super) struct Integers {
    dimension: usize,
    /// Number of values per descriptor, halved and rounded up.
    pairs: usize,
    count: usize,
    /// Pairs of values, low half first; padded with zero descriptors to a multiple of four.
    values: Vec<i32>,
    /// Squared lengths.
    norms: Vec<i32>,
}

impl Integers {
    pub(super) fn new(bytes: &[u8], dimension: usize) -> Self {
        let pairs = dimension.div_ceil(2);
        let mut values = Vec::with_capacity(bytes.len() / 2 + 4 * pairs);
        for row in bytes.chunks_exact(dimension) {
            values.extend(row.chunks(2).map(|pair| {
                let high = pair.get(1).copied().unwrap_or(0);
                i32::from(pair[0]) | i32::from(high) << 16
            }));
        }
        let count = bytes.len() / dimension;
        values.resize(count.next_multiple_of(4) * pairs, 0);
        let mut norms: Vec<i32> = bytes.chunks_exact(dimension).map(norm_sq).collect();
        norms.resize(count.next_multiple_of(4), FILLER);
        Self {
            dimension,
            pairs,
            count,
            values,
            norms,
        }
    }
}

fn norm_sq(row: &[u8]) -> i32 {
    row.iter().map(|&v| i32::from(v) * i32::from(v)).sum()
}

/// Two adjacent values of eight descriptors: values 2k and 2k + 1 of the first, then of the second,
/// and so on.
pub(super) type Packed = [i16; 16];

/// A piece of the first list, interleaved by eight.
pub(super) struct Piece {
    count: usize,
    /// `pairs` entries for each eight descriptors.
    packed: Vec<Packed>,
    norms: Vec<[i32; 8]>,
}

impl Piece {
    pub(super) fn new(bytes: &[u8], second: &Integers) -> Self {
        let (dimension, pairs) = (second.dimension, second.pairs);
        let count = bytes.len() / dimension;
        let groups = count.div_ceil(8);
        let mut packed = vec![[0i16; 16]; groups * pairs];
        let mut norms = vec![[FILLER; 8]; groups];
        for (k, row) in bytes.chunks_exact(dimension).enumerate() {
            let (group, lane) = (k / 8, k % 8);
            norms[group][lane] = norm_sq(row);
            for (i, &value) in row.iter().enumerate() {
                packed[group * pairs + i / 2][2 * lane + i % 2] = i16::from(value);
            }
        }
        Self {
            count,
            packed,
            norms,
        }
    }
}

/// Two nearest neighbors so far of eight descriptors. Distances lack the eight's own squared
/// lengths, which do not change the order.
#[derive(Clone, Copy)]
struct Eight {
    near: [i32; 8],
    second: [i32; 8],
    index: [usize; 8],
}

impl Default for Eight {
    fn default() -> Self {
        Self {
            near: [i32::MAX; 8],
            second: [i32::MAX; 8],
            index: [0; 8],
        }
    }
}

/// Results so far, in both directions.
pub(super) struct State {
    rows: Vec<Eight>,
    columns: Vec<(i32, usize)>,
}

impl State {
    /// Creates an empty state.
    pub(super) fn new(second: &Integers, piece: &Piece) -> Self {
        Self {
            rows: vec![Eight::default(); piece.norms.len()],
            columns: vec![(i32::MAX, 0); second.norms.len()],
        }
    }

    /// Returns the neighbors after the comparison with the whole second list.
    pub(super) fn scanned(mut self, second: &Integers, piece: &Piece) -> Scanned<i32> {
        let rows = (0..piece.count).map(|k| {
            let (eight, lane) = (&self.rows[k / 8], k % 8);
            let whole = |d: i32| d.saturating_add(piece.norms[k / 8][lane]);
            (
                eight.index[lane],
                whole(eight.near[lane]),
                whole(eight.second[lane]),
            )
        });
        let rows = rows.collect();
        self.columns.truncate(second.count);
        Scanned {
            rows,
            columns: self.columns,
        }
    }
}

/// Compares every descriptor of the piece with every one of the second list.
#[inline(always)]
pub(super) fn walk(
    second: &Integers,
    piece: &Piece,
    state: &mut State,
    inner_products: impl Fn(&[Packed], [&[i32]; 4]) -> [[i32; 8]; 4],
) {
    let pairs = second.pairs;
    for tile in (0..second.norms.len()).step_by(TILE) {
        let tile_end = (tile + TILE).min(second.norms.len());
        let groups = piece.packed.chunks_exact(pairs).zip(&piece.norms);
        for (group, (eight, own_norms)) in groups.enumerate() {
            let rows = &mut state.rows[group];
            for column in (tile..tile_end).step_by(4) {
                let plain =
                    |j: usize| &second.values[(column + j) * pairs..(column + j + 1) * pairs];
                let products = inner_products(eight, [plain(0), plain(1), plain(2), plain(3)]);
                for (j, products) in products.iter().enumerate() {
                    let norm = second.norms[column + j];
                    let best = &mut state.columns[column + j];
                    let (mut distances, mut near) = ([0i32; 8], 0i32);
                    for lane in 0..8 {
                        let d = norm - 2 * products[lane];
                        distances[lane] = d;
                        near |= i32::from(d < rows.second[lane]);
                        near |= i32::from(d + own_norms[lane] < best.0);
                    }
                    // Rare: a list of n has about 2 ln n improvements per descriptor.
                    if near != 0 {
                        improve(rows, best, &distances, own_norms, column + j, group);
                    }
                }
            }
        }
    }
}

#[inline(never)]
fn improve(
    rows: &mut Eight,
    best: &mut (i32, usize),
    distances: &[i32; 8],
    own_norms: &[i32; 8],
    column: usize,
    group: usize,
) {
    for (lane, &d) in distances.iter().enumerate() {
        if d < rows.near[lane] {
            rows.second[lane] = rows.near[lane];
            rows.near[lane] = d;
            rows.index[lane] = column;
        } else if d < rows.second[lane] {
            rows.second[lane] = d;
        }
        let whole = d + own_norms[lane];
        if whole < best.0 {
            *best = (whole, 8 * group + lane);
        }
    }
}
