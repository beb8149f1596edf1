//! How unlike a left pixel is to each candidate of the right row, in eight bits.
//!
//! Two measures that fail in different places are added: the Hamming distance of census bits
//! (0…24, blind to brightness and contrast), and the difference of gray that sampling cannot
//! explain (0…cap, sharp where texture is weak).
//!
//! The right row is stored from its end to its beginning, so that the candidates of increasing
//! disparity lie side by side in memory.
//!
//! Sources: Zabih & Woodfill 1994, "Non-parametric local transforms for computing visual
//! correspondence"; Birchfield & Tomasi 1998, "A pixel dissimilarity measure that is insensitive
//! to image sampling".

use super::search::Search;
use image::GrayImage;

/// The census window is 5×5: 24 comparisons with the center, three bytes.
const RADIUS: usize = 2;
const NUM_PLANES: usize = 3;

/// What the cost is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum StereoCost {
    /// Hamming distance of the census transform over 5×5 pixels: immune to a change of
    /// brightness or contrast between the pictures.
    Census,
    /// Difference of gray values that is insensitive to sampling (Birchfield–Tomasi), capped.
    BirchfieldTomasi,
    /// The sum of both: the best on every picture that we tried.
    #[default]
    Both,
}

/// One row of one picture, prepared for comparison.
struct PreparedRow {
    gray: Vec<u8>,
    /// The smallest and largest gray value within half a pixel along the row.
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

    #[inline(always)]
    fn fill(&mut self, image: &GrayImage, v: usize, window: &mut [Vec<u8>]) {
        let (width, height) = (image.width() as usize, image.height() as usize);
        for (k, row) in window.iter_mut().enumerate() {
            let from = (v + k).saturating_sub(RADIUS).min(height - 1);
            let pixels = &image.as_raw()[from * width..(from + 1) * width];
            row[..RADIUS].fill(pixels[0]);
            row[RADIUS..RADIUS + width].copy_from_slice(pixels);
            row[RADIUS + width..].fill(pixels[width - 1]);
        }
        let center = &window[RADIUS][RADIUS..RADIUS + width];
        self.gray[..width].copy_from_slice(center);
        let before = &window[RADIUS][RADIUS - 1..RADIUS - 1 + width];
        let after = &window[RADIUS][RADIUS + 1..RADIUS + 1 + width];
        let (low, high) = (&mut self.low[..width], &mut self.high[..width]);
        for u in 0..width {
            let half_before = (u16::from(center[u]) + u16::from(before[u])) / 2;
            let half_after = (u16::from(center[u]) + u16::from(after[u])) / 2;
            let (a, b) = (half_before as u8, half_after as u8);
            low[u] = center[u].min(a).min(b);
            high[u] = center[u].max(a).max(b);
        }
        for plane in &mut self.census {
            plane[..width].fill(0);
        }
        let mut bit = 0;
        for dv in 0..=2 * RADIUS {
            for du in 0..=2 * RADIUS {
                if (dv, du) == (RADIUS, RADIUS) {
                    continue;
                }
                let neighbor = &window[dv][du..du + width];
                let plane = &mut self.census[bit / 8][..width];
                let mask = 1u8 << (bit % 8);
                for u in 0..width {
                    plane[u] |= if neighbor[u] < center[u] { mask } else { 0 };
                }
                bit += 1;
            }
        }
    }
}

/// Makes the costs of one row after another.
pub(super) struct CostRows<'a> {
    search: Search<'a>,
    kind: StereoCost,
    cap: u8,
    /// The cost of a candidate outside the right picture.
    outside: u8,
    left: PreparedRow,
    right: PreparedRow,
    /// The right row from its end, shifted so that cell d of column u is at
    /// `width − 1 − u + d`.
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

    /// The costs of row v: width × `num_cells`.
    #[inline(always)]
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
            StereoCost::Census => self.compare::<true, false>(costs),
            StereoCost::BirchfieldTomasi => self.compare::<false, true>(costs),
            StereoCost::Both => self.compare::<true, true>(costs),
        }
    }

    #[inline(always)]
    fn compare<const CENSUS: bool, const GRAY: bool>(&self, costs: &mut [u8]) {
        let search = &self.search;
        let n = search.num_cells;
        let (left, right, cap) = (&self.left, &self.reversed, self.cap);
        for (u, cells) in costs.chunks_exact_mut(n).enumerate() {
            let at = search.width - 1 - u;
            let (gray, low, high) = (left.gray[u], left.low[u], left.high[u]);
            let bits = [left.census[0][u], left.census[1][u], left.census[2][u]];
            let (grays, lows, highs) = (
                &right.gray[at..at + n],
                &right.low[at..at + n],
                &right.high[at..at + n],
            );
            let (bits_0, bits_1, bits_2) = (
                &right.census[0][at..at + n],
                &right.census[1][at..at + n],
                &right.census[2][at..at + n],
            );
            let cells_here = &mut cells[..n];
            for d in 0..n {
                let mut cost = 0;
                if CENSUS {
                    let (a, b, c) = (
                        bits[0] ^ bits_0[d],
                        bits[1] ^ bits_1[d],
                        bits[2] ^ bits_2[d],
                    );
                    // Three bytes added bit by bit leave two to be counted.
                    let half = a ^ b;
                    let (ones, twos) = (half ^ c, (a & b) | (half & c));
                    cost = count_bits(ones) + 2 * count_bits(twos);
                }
                if GRAY {
                    let from_left = gray
                        .saturating_sub(highs[d])
                        .max(lows[d].saturating_sub(gray));
                    let from_right = grays[d]
                        .saturating_sub(high)
                        .max(low.saturating_sub(grays[d]));
                    cost += from_left.min(from_right).min(cap);
                }
                cells_here[d] = cost;
            }
            let inside = search.cells_inside(u);
            if inside.len() < n {
                cells[..inside.start].fill(self.outside);
                cells[inside.end..search.num_disparities].fill(self.outside);
                cells[search.num_disparities..].fill(u8::MAX);
            }
        }
    }
}

/// The number of ones in a byte, in steps that a vector unit has.
#[inline(always)]
fn count_bits(x: u8) -> u8 {
    x.count_ones() as u8
}
