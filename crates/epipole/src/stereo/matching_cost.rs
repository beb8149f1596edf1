//! Eight-bit matching costs of a left pixel and each candidate of the right row.
//!
//! The sum of two measures with different weaknesses: the Hamming distance of census bits (0…24,
//! independent of brightness and contrast), and the difference of gray values that sampling cannot
//! explain (0…cap, accurate where texture is weak).
//!
//! The right row is stored in reverse, so that candidates of increasing disparity are adjacent in
//! memory.
//!
//! Sources: Zabih & Woodfill 1994, "Non-parametric local transforms for computing visual
//! correspondence"; Birchfield & Tomasi 1998, "A pixel dissimilarity measure that is insensitive
//! to image sampling".

use super::search::Search;
use crate::math::simd::dispatched;
use image::GrayImage;

/// The census window is 5×5: 24 comparisons with the center, three bytes.
const RADIUS: usize = 2;
const NUM_PLANES: usize = 3;

/// Kind of matching cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum StereoCost {
    /// Hamming distance of the census transform over 5×5 pixels: invariant to brightness and
    /// contrast changes between the images.
    Census,
    /// Sampling-insensitive difference of gray values (Birchfield–Tomasi), capped.
    BirchfieldTomasi,
    /// Sum of both: the best on every image that we tried.
    #[default]
    Both,
}

/// One row of an image, prepared for comparison.
struct PreparedRow {
    gray: Vec<u8>,
    /// Minimum gray value within half a pixel along the row; `high` is the maximum.
    low: Vec<u8>,
    high: Vec<u8>,
    census: [Vec<u8>; NUM_PLANES],
}

impl PreparedRow {
    fn new(len: usize) -> Self {
        Self {
            gray: vec![0; len],
            low: vec![0; len],
            high: vec![0; len],
            census: std::array::from_fn(|_| vec![0; len]),
        }
    }

    fn fill(&mut self, image: &GrayImage, v: usize, window: &mut [Vec<u8>]) {
        let (width, height) = (image.width() as usize, image.height() as usize);
        for (k, row) in window.iter_mut().enumerate() {
            let from = (v + k).saturating_sub(RADIUS).min(height - 1);
            let pixels = &image.as_raw()[from * width..(from + 1) * width];
            row[..RADIUS].fill(pixels[0]);
            row[RADIUS..RADIUS + width].copy_from_slice(pixels);
            row[RADIUS + width..].fill(pixels[width - 1]);
        }
        let middle = &window[RADIUS];
        let center = &middle[RADIUS..RADIUS + width];
        self.gray.copy_from_slice(center);
        let (before, after) = (&middle[RADIUS - 1..], &middle[RADIUS + 1..]);
        half_pixel_range(center, before, after, &mut self.low, &mut self.high);
        for plane in &mut self.census {
            plane.fill(0);
        }
        let mut bit = 0;
        for dv in 0..=2 * RADIUS {
            for du in 0..=2 * RADIUS {
                if (dv, du) != (RADIUS, RADIUS) {
                    let neighbors = &window[dv][du..du + width];
                    mark_darker(center, neighbors, 1 << (bit % 8), &mut self.census[bit / 8]);
                    bit += 1;
                }
            }
        }
    }
}

dispatched! {
    /// Computes the minimum and maximum within half a pixel on either side.
    fn half_pixel_range(
        center: &[u8],
        before: &[u8],
        after: &[u8],
        low: &mut [u8],
        high: &mut [u8],
    ) {
        let n = center.len();
        let (before, after, low, high) = (&before[..n], &after[..n], &mut low[..n], &mut high[..n]);
        for u in 0..n {
            let a = ((u16::from(center[u]) + u16::from(before[u])) / 2) as u8;
            let b = ((u16::from(center[u]) + u16::from(after[u])) / 2) as u8;
            low[u] = center[u].min(a).min(b);
            high[u] = center[u].max(a).max(b);
        }
    }
}

dispatched! {
    /// Sets a bit where the neighbor is darker than the center.
    fn mark_darker(center: &[u8], neighbors: &[u8], bit: u8, plane: &mut [u8]) {
        let n = center.len();
        let (neighbors, plane) = (&neighbors[..n], &mut plane[..n]);
        for u in 0..n {
            plane[u] |= if neighbors[u] < center[u] { bit } else { 0 };
        }
    }
}

/// Computes the costs of one row after another.
pub(super) struct CostRows<'a> {
    search: Search<'a>,
    kind: StereoCost,
    cap: u8,
    /// Cost of a candidate outside the right image.
    outside: u8,
    left: PreparedRow,
    right: PreparedRow,
    /// The right row in reverse, shifted so that cell d of column u is at `width − 1 − u + d`.
    reversed: PreparedRow,
    window: Vec<Vec<u8>>,
}

impl<'a> CostRows<'a> {
    pub(super) fn new(search: Search<'a>, kind: StereoCost, cap: u8, outside: u8) -> Self {
        let padded = search.width + search.num_cells;
        Self {
            search,
            kind,
            cap,
            outside,
            left: PreparedRow::new(search.width),
            right: PreparedRow::new(search.width),
            reversed: PreparedRow::new(padded),
            window: vec![vec![0; search.width + 2 * RADIUS]; 2 * RADIUS + 1],
        }
    }

    /// Computes the costs of row v: width × `num_cells`.
    pub(super) fn row(&mut self, v: usize, costs: &mut [u8]) {
        let search = self.search;
        self.left.fill(search.left, v, &mut self.window);
        self.right.fill(search.right, v, &mut self.window);
        search.reverse(&self.right.gray, &mut self.reversed.gray);
        search.reverse(&self.right.low, &mut self.reversed.low);
        search.reverse(&self.right.high, &mut self.reversed.high);
        for (from, to) in self.right.census.iter().zip(&mut self.reversed.census) {
            search.reverse(from, to);
        }
        match self.kind {
            StereoCost::Census => compare::<CENSUS>(
                search.num_cells,
                self.cap,
                &self.left,
                &self.reversed,
                costs,
            ),
            StereoCost::BirchfieldTomasi => compare::<GRAY>(
                search.num_cells,
                self.cap,
                &self.left,
                &self.reversed,
                costs,
            ),
            StereoCost::Both => compare::<BOTH>(
                search.num_cells,
                self.cap,
                &self.left,
                &self.reversed,
                costs,
            ),
        }
        for (u, cells) in costs.chunks_exact_mut(search.num_cells).enumerate() {
            let inside = search.cells_inside(u);
            if inside.len() < cells.len() {
                cells[..inside.start].fill(self.outside);
                cells[inside.end..search.num_disparities].fill(self.outside);
                cells[search.num_disparities..].fill(u8::MAX);
            }
        }
    }
}

/// Bits of `KIND` in [`compare`].
const CENSUS: u8 = 1;
const GRAY: u8 = 2;
const BOTH: u8 = CENSUS | GRAY;

dispatched! {
    /// Computes the costs of a row, width × `num_cells`; those outside the right image are
    /// arbitrary.
    fn compare<const KIND: u8>(
        num_cells: usize,
        cap: u8,
        left: &PreparedRow,
        reversed: &PreparedRow,
        costs: &mut [u8],
    ) {
        let width = left.gray.len();
        for (u, costs) in costs.chunks_exact_mut(num_cells).enumerate() {
            let at = width - 1 - u;
            let (gray, low, high) = (left.gray[u], left.low[u], left.high[u]);
            let bits = [left.census[0][u], left.census[1][u], left.census[2][u]];
            let (grays, lows, highs) = (
                &reversed.gray[at..][..num_cells],
                &reversed.low[at..][..num_cells],
                &reversed.high[at..][..num_cells],
            );
            let (bits_0, bits_1, bits_2) = (
                &reversed.census[0][at..][..num_cells],
                &reversed.census[1][at..][..num_cells],
                &reversed.census[2][at..][..num_cells],
            );
            for d in 0..num_cells {
                let mut cost = 0;
                if KIND & CENSUS != 0 {
                    let (a, b) = (bits[0] ^ bits_0[d], bits[1] ^ bits_1[d]);
                    let c = bits[2] ^ bits_2[d];
                    // Three bytes added bit by bit leave two whose bits are counted.
                    let half = a ^ b;
                    let (ones, twos) = (half ^ c, (a & b) | (half & c));
                    cost = count_bits(ones) + 2 * count_bits(twos);
                }
                if KIND & GRAY != 0 {
                    let from_left = gray
                        .saturating_sub(highs[d])
                        .max(lows[d].saturating_sub(gray));
                    let from_right = grays[d]
                        .saturating_sub(high)
                        .max(low.saturating_sub(grays[d]));
                    cost += from_left.min(from_right).min(cap);
                }
                costs[d] = cost;
            }
        }
    }
}

/// Counts the ones in a byte, by operations that a vector unit has.
#[inline(always)]
fn count_bits(x: u8) -> u8 {
    x.count_ones() as u8
}
