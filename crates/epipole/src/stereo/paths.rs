//! Path costs of semi-global matching along straight paths through the image.
//!
//! Along a path r, with the cost C(p, d) of pixel p at disparity d,
//! `L(p, d) = C(p, d) + min(L(p−r, d), L(p−r, d±1) + P1, min L(p−r) + P2) − min L(p−r)`.
//! The subtracted minimum keeps L ≤ C + P2, so that eight bits hold it and a vector register
//! holds 16 or 32 disparities.
//!
//! Source: Hirschmüller 2008, "Stereo processing by semiglobal matching and mutual information",
//! equations 13 and 14.

use crate::math::simd::dispatched;

/// Number of bytes of infinite cost on either side of a path's disparities, so that d ± 1 exists.
const PAD: usize = 8;

/// Penalties for changes of disparity between neighbors.
#[derive(Clone)]
pub(super) struct Penalties {
    /// Penalty for a change by one.
    pub(super) p1: u8,
    /// Penalty for any larger change, by the gray difference between the neighbors.
    pub(super) p2_of_gray_step: [u8; 256],
}

/// The costs of one path at each pixel of a row, with a border pixel at either end.
struct PathRow {
    /// Per pixel: pad, cells, pad.
    cells: Vec<u8>,
    /// The smallest cell of each pixel.
    minima: Vec<u8>,
}

impl PathRow {
    /// Creates the state before the first row: L = 0, so that a first pixel costs C alone.
    fn new(width: usize, num_cells: usize) -> Self {
        let mut cells = vec![u8::MAX; (width + 2) * (num_cells + 2 * PAD)];
        for pixel in cells.chunks_exact_mut(num_cells + 2 * PAD) {
            pixel[PAD..PAD + num_cells].fill(0);
        }
        Self {
            cells,
            minima: vec![0; width + 2],
        }
    }
}

/// Continues a path by one pixel: writes its costs to `next` and returns the smallest.
///
/// * `before`: from the cell before disparity 0 to the cell after the last
/// * `minimum`: the smallest of them, `p2`: the penalty of a large step to here
#[inline(always)]
pub(super) fn advance<const BLOCK: usize>(
    costs: &[u8],
    before: &[u8],
    minimum: u8,
    p1: u8,
    p2: u8,
    next: &mut [u8],
) -> u8 {
    let n = costs.len();
    let jump = minimum.saturating_add(p2);
    let mut least = [u8::MAX; BLOCK];
    // Indexed rather than zipped: this runs for every pixel, and setting up an iterator over five
    // slices costs more than the loop.
    let [below, same, above] = [0, 1, 2].map(|first| before[first..first + n].as_chunks().0);
    let (costs, next) = (costs.as_chunks().0, next.as_chunks_mut().0);
    for block in 0..n / BLOCK {
        let [cost, below, same, above]: [&[u8; BLOCK]; 4] =
            [&costs[block], &below[block], &same[block], &above[block]];
        let after: &mut [u8; BLOCK] = &mut next[block];
        for i in 0..BLOCK {
            let beside = below[i].min(above[i]).saturating_add(p1);
            let best = same[i].min(beside).min(jump).wrapping_sub(minimum);
            let value = cost[i].saturating_add(best);
            after[i] = value;
            least[i] = least[i].min(value);
        }
    }
    let mut lowest = u8::MAX;
    for lane in least {
        lowest = lowest.min(lane);
    }
    lowest
}

dispatched! {
    /// Continues a path from the previous row, straight or one column aside.
    ///
    /// * `p2`: penalty of each pixel's step
    /// * `before`, `before_minima`: from the predecessor of the first pixel on
    /// * `next`, `next_minima`: from the first pixel on
    fn continue_from_before<const BLOCK: usize>(
        num_cells: usize,
        costs: &[u8],
        p1: u8,
        p2: &[u8],
        before: &[u8],
        before_minima: &[u8],
        next: &mut [u8],
        next_minima: &mut [u8],
    ) {
        let stride = num_cells + 2 * PAD;
        let pixels = costs
            .chunks_exact(num_cells)
            .zip(p2)
            .zip(before.chunks_exact(stride))
            .zip(before_minima)
            .zip(next.chunks_exact_mut(stride))
            .zip(next_minima);
        for (((((costs, &p2), before), &minimum), next), next_minimum) in pixels {
            let before = &before[PAD - 1..PAD + num_cells + 1];
            let next = &mut next[PAD..PAD + num_cells];
            *next_minimum = advance::<BLOCK>(costs, before, minimum, p1, p2, next);
        }
    }
}

dispatched! {
    /// Continues the path along the row, forward or backward.
    ///
    /// * `path`: from the first pixel on
    /// * `previous`: pad, cells, pad of the previous pixel; cells are initially zero
    fn continue_along<const BLOCK: usize>(
        num_cells: usize,
        backward: bool,
        costs: &[u8],
        p1: u8,
        p2: &[u8],
        path: &mut [u8],
        previous: &mut [u8],
    ) {
        let stride = num_cells + 2 * PAD;
        let mut minimum = 0;
        for i in 0..p2.len() {
            let u = if backward { p2.len() - 1 - i } else { i };
            let costs = &costs[u * num_cells..(u + 1) * num_cells];
            let next = &mut path[u * stride + PAD..u * stride + PAD + num_cells];
            let before = &previous[PAD - 1..PAD + num_cells + 1];
            minimum = advance::<BLOCK>(costs, before, minimum, p1, p2[u], next);
            // Copied from the row, so that reads cannot alias writes.
            let blocks = previous[PAD..PAD + num_cells].chunks_exact_mut(BLOCK);
            for (blocks, cells) in blocks.zip(next.chunks_exact(BLOCK)) {
                blocks.copy_from_slice(cells);
            }
        }
    }
}

dispatched! {
    /// Computes the rounded mean of N paths' costs.
    ///
    /// * `paths`: rows of the paths, from the first pixel's cells on; only the first N are used
    fn average<const N: usize>(num_cells: usize, paths: [&[u8]; 4], means: &mut [u8]) {
        let stride = num_cells + 2 * PAD;
        for (u, means) in means.chunks_exact_mut(num_cells).enumerate() {
            let at = u * stride;
            let (a, b) = (&paths[0][at..][..num_cells], &paths[1][at..][..num_cells]);
            let (c, d) = (&paths[2][at..][..num_cells], &paths[3][at..][..num_cells]);
            for i in 0..num_cells {
                let total = total::<N>(a[i], b[i], c[i], d[i]);
                means[i] = ((total + N as i16 / 2) >> N.ilog2()) as u8;
            }
        }
    }
}

dispatched! {
    /// Adds N paths' costs to `sums`; arguments as for [`average`].
    fn add<const N: usize>(num_cells: usize, paths: [&[u8]; 4], sums: &mut [i16]) {
        let stride = num_cells + 2 * PAD;
        for (u, sums) in sums.chunks_exact_mut(num_cells).enumerate() {
            let at = u * stride;
            let (a, b) = (&paths[0][at..][..num_cells], &paths[1][at..][..num_cells]);
            let (c, d) = (&paths[2][at..][..num_cells], &paths[3][at..][..num_cells]);
            for i in 0..num_cells {
                sums[i] += total::<N>(a[i], b[i], c[i], d[i]);
            }
        }
    }
}

/// Returns the sum of the first N.
#[inline(always)]
fn total<const N: usize>(a: u8, b: u8, c: u8, d: u8) -> i16 {
    let [a, b, c, d] = [i16::from(a), i16::from(b), i16::from(c), i16::from(d)];
    match N {
        1 => a,
        2 => a + b,
        _ => a + b + c + d,
    }
}

/// A sweep over the rows with N paths: the one along the row (first), for N = 2 also the vertical
/// one, for N = 4 also both diagonals.
pub(super) struct Sweep<const N: usize> {
    rows: [PathRow; N],
    /// Costs of the previous row, except for the path along the row.
    rows_before: Vec<PathRow>,
    gray_before: Vec<u8>,
    /// Penalty of a large step to each pixel.
    p2: Vec<u8>,
    previous: Vec<u8>,
    num_cells: usize,
    /// Whether each row is processed from its last pixel to its first.
    backward: bool,
}

impl<const N: usize> Sweep<N> {
    /// * `num_cells`: disparities per pixel, a multiple of 16
    pub(super) fn new(width: usize, num_cells: usize, backward: bool) -> Self {
        let row = || PathRow::new(width, num_cells);
        Self {
            rows: std::array::from_fn(|_| row()),
            rows_before: (1..N).map(|_| row()).collect(),
            gray_before: vec![0; width],
            p2: vec![0; width],
            previous: vec![u8::MAX; num_cells + 2 * PAD],
            num_cells,
            backward,
        }
    }

    /// Continues all paths through the next row.
    ///
    /// * `costs`: width × `num_cells`
    /// * `gray`: this row of the left image
    pub(super) fn next_row(&mut self, costs: &[u8], gray: &[u8], penalties: &Penalties) {
        if self.num_cells.is_multiple_of(32) {
            self.next_row_in_blocks::<32>(costs, gray, penalties);
        } else {
            self.next_row_in_blocks::<16>(costs, gray, penalties);
        }
        self.gray_before.copy_from_slice(gray);
    }

    fn next_row_in_blocks<const BLOCK: usize>(
        &mut self,
        costs: &[u8],
        gray: &[u8],
        penalties: &Penalties,
    ) {
        let (n, stride) = (self.num_cells, self.num_cells + 2 * PAD);
        let (width, p1) = (gray.len(), penalties.p1);
        let [along, others @ ..] = &mut self.rows[..] else {
            return;
        };
        let back: isize = if self.backward { 1 } else { -1 };
        penalties.of_steps(gray, gray, back, &mut self.p2);
        self.previous[PAD..PAD + n].fill(0);
        let path = &mut along.cells[stride..(width + 1) * stride];
        let (p2, previous) = (&self.p2, &mut self.previous);
        continue_along::<BLOCK>(n, self.backward, costs, p1, p2, path, previous);

        // Diagonals depend on the direction along the rows.
        let steps: [isize; 3] = if N == 4 { [back, 0, -back] } else { [0; 3] };
        for ((next, before), step) in others.iter_mut().zip(&mut self.rows_before).zip(steps) {
            std::mem::swap(next, before);
            penalties.of_steps(gray, &self.gray_before, step, &mut self.p2);
            // Pixel u has index u + 1, after the border.
            let first = (1 + step) as usize;
            continue_from_before::<BLOCK>(
                n,
                costs,
                p1,
                &self.p2,
                &before.cells[first * stride..(first + width) * stride],
                &before.minima[first..first + width],
                &mut next.cells[stride..(width + 1) * stride],
                &mut next.minima[1..width + 1],
            );
        }
    }

    /// Returns the last row of each path, from the first pixel's cells on.
    fn paths(&self) -> [&[u8]; 4] {
        let begin = self.num_cells + 3 * PAD;
        std::array::from_fn(|n| &self.rows[n.min(N - 1)].cells[begin..])
    }

    /// Adds the costs of all paths through the last row to `sums`, width × `num_cells`.
    pub(super) fn add_to(&self, sums: &mut [i16]) {
        add::<N>(self.num_cells, self.paths(), sums);
    }

    /// Returns the rounded mean of the path costs of the last row, which fits eight bits; width ×
    /// `num_cells`.
    pub(super) fn means(&self, means: &mut [u8]) {
        average::<N>(self.num_cells, self.paths(), means);
    }
}

impl Penalties {
    /// Computes P2 of the step to each pixel of a row from the pixel `step` columns aside in the
    /// row `there`. Pixels outside do not matter: a new path has no costs yet.
    fn of_steps(&self, here: &[u8], there: &[u8], step: isize, p2: &mut [u8]) {
        let width = here.len();
        // Pixels with a neighbor inside the image.
        let begin = usize::from(step < 0).min(width);
        let end = width - usize::from(step > 0).min(width);
        p2.fill(self.p2_of_gray_step[0]);
        let there = &there[(begin as isize + step) as usize..];
        for ((p2, &a), &b) in p2[begin..end].iter_mut().zip(&here[begin..end]).zip(there) {
            *p2 = self.p2_of_gray_step[usize::from(a.abs_diff(b))];
        }
    }
}
