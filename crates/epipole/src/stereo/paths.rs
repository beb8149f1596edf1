//! The recursion of semi-global matching along straight paths through the picture.
//!
//! Along a path r, with the cost C(p, d) of pixel p at disparity d,
//! `L(p, d) = C(p, d) + min(L(p−r, d), L(p−r, d±1) + P1, min L(p−r) + P2) − min L(p−r)`.
//! The subtracted minimum keeps L ≤ C + P2, so that eight bits hold it and a vector register
//! holds 16 or 32 disparities.
//!
//! Source: Hirschmüller 2008, "Stereo processing by semiglobal matching and mutual information",
//! equations 13 and 14.

/// Bytes of "infinite cost" on either side of a path's disparities, so that d ± 1 exists.
const PAD: usize = 8;

/// Penalties for a change of disparity between neighbors.
#[derive(Clone)]
pub(super) struct Penalties {
    /// For a change by one.
    pub(super) p1: u8,
    /// For any larger change, by the difference of gray across the step.
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
    /// Paths yet to begin: L = 0, so that a first pixel costs C alone.
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

/// Continues one path by one pixel: writes its costs to `next` and tells the smallest.
///
/// * `before`: from the cell before disparity 0 to the cell after the last
/// * `minimum`: the smallest of them, `p2`: the penalty of a large step to here
#[inline(always)]
fn advance<const BLOCK: usize>(
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
    let blocks = costs
        .chunks_exact(BLOCK)
        .zip(before[..n].chunks_exact(BLOCK))
        .zip(before[1..n + 1].chunks_exact(BLOCK))
        .zip(before[2..n + 2].chunks_exact(BLOCK))
        .zip(next.chunks_exact_mut(BLOCK));
    for ((((cost, below), same), above), after) in blocks {
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

/// A row of pixels that paths are continued through.
#[derive(Clone, Copy)]
struct Row<'a> {
    /// width × `num_cells`.
    costs: &'a [u8],
    gray: &'a [u8],
    num_cells: usize,
    penalties: &'a Penalties,
}

impl Row<'_> {
    #[inline(always)]
    fn p2(&self, here: u8, there: u8) -> u8 {
        self.penalties.p2_of_gray_step[usize::from(here.max(there) - here.min(there))]
    }

    /// A path that comes from the row before, `step` columns aside (−1, 0 or 1).
    #[inline(always)]
    fn continue_from_before<const BLOCK: usize>(
        &self,
        step: isize,
        gray_before: &[u8],
        before: &PathRow,
        next: &mut PathRow,
    ) {
        let stride = self.num_cells + 2 * PAD;
        let first = (1 + step) as usize;
        let pixels = self
            .costs
            .chunks_exact(self.num_cells)
            .zip(before.cells.chunks_exact(stride).skip(first))
            .zip(before.minima.iter().skip(first))
            .zip(next.cells.chunks_exact_mut(stride).skip(1))
            .zip(next.minima.iter_mut().skip(1));
        // The gray value at the other end of each step; the border's does not matter, since a
        // path that begins has no costs yet.
        let grays = self.gray.iter().enumerate();
        let last = self.gray.len() as isize - 1;
        for (((((costs, before), &minimum), next), next_minimum), (u, &here)) in pixels.zip(grays) {
            let there = gray_before[(u as isize + step).clamp(0, last) as usize];
            *next_minimum = advance::<BLOCK>(
                costs,
                &before[PAD - 1..PAD + self.num_cells + 1],
                minimum,
                self.penalties.p1,
                self.p2(here, there),
                &mut next[PAD..PAD + self.num_cells],
            );
        }
    }

    /// The path along the row, from its first pixel to its last or the other way.
    #[inline(always)]
    fn continue_along<const BLOCK: usize>(&self, backward: bool, path: &mut PathRow) {
        let (n, width) = (self.num_cells, self.gray.len());
        let stride = n + 2 * PAD;
        let mut minimum = 0;
        let mut there = self.gray[if backward { width - 1 } else { 0 }];
        for i in 0..width {
            let u = if backward { width - 1 - i } else { i };
            // Pixel u has the index u + 1, behind the border's.
            let (low, high) = path
                .cells
                .split_at_mut((u + 1 + usize::from(backward)) * stride);
            let (before, next) = if backward {
                (&high[..stride], &mut low[(u + 1) * stride..])
            } else {
                (&low[u * stride..], &mut high[..stride])
            };
            minimum = advance::<BLOCK>(
                &self.costs[u * n..(u + 1) * n],
                &before[PAD - 1..PAD + n + 1],
                minimum,
                self.penalties.p1,
                self.p2(self.gray[u], there),
                &mut next[PAD..PAD + n],
            );
            there = self.gray[u];
        }
    }
}

/// A sweep over the rows that carries N paths: always the one along the row (first), with N = 2
/// also the vertical one, with N = 4 also both diagonals.
pub(super) struct Sweep<const N: usize> {
    rows: [PathRow; N],
    /// Of the row before, except for the path along the row, which needs none.
    rows_before: Vec<PathRow>,
    gray_before: Vec<u8>,
    num_cells: usize,
    /// From the last pixel to the first.
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
            num_cells,
            backward,
        }
    }

    /// Continues all paths through the next row.
    ///
    /// * `costs`: width × `num_cells`
    /// * `gray`: this row of the left picture
    #[inline(always)]
    pub(super) fn next_row(&mut self, costs: &[u8], gray: &[u8], penalties: &Penalties) {
        let row = Row {
            costs,
            gray,
            num_cells: self.num_cells,
            penalties,
        };
        if self.num_cells.is_multiple_of(32) {
            self.next_row_in_blocks::<32>(row);
        } else {
            self.next_row_in_blocks::<16>(row);
        }
        self.gray_before.copy_from_slice(gray);
    }

    #[inline(always)]
    fn next_row_in_blocks<const BLOCK: usize>(&mut self, row: Row) {
        let [along, others @ ..] = &mut self.rows[..] else {
            return;
        };
        row.continue_along::<BLOCK>(self.backward, along);
        // Diagonals lean the way that the sweep goes along its rows.
        let back = if self.backward { 1 } else { -1 };
        let steps: [isize; 3] = if N == 4 { [back, 0, -back] } else { [0; 3] };
        for ((next, before), step) in others.iter_mut().zip(&mut self.rows_before).zip(steps) {
            std::mem::swap(next, before);
            row.continue_from_before::<BLOCK>(step, &self.gray_before, before, next);
        }
    }

    /// The costs of each path at column u of the last row.
    #[inline(always)]
    fn paths_at(&self, u: usize) -> [&[u8]; 4] {
        let begin = (u + 1) * (self.num_cells + 2 * PAD) + PAD;
        let path = |n: usize| &self.rows[n.min(N - 1)].cells[begin..begin + self.num_cells];
        [path(0), path(1), path(2), path(3)]
    }

    /// Adds the costs of all paths at column u to `sums`.
    #[inline(always)]
    pub(super) fn add_to(&self, u: usize, sums: &mut [i16]) {
        add::<N>(self.paths_at(u), sums);
    }

    /// The mean of the path costs of the last row, rounded, which fits eight bits; width ×
    /// `num_cells`.
    #[inline(always)]
    pub(super) fn means(&self, means: &mut [u8]) {
        for (u, means) in means.chunks_exact_mut(self.num_cells).enumerate() {
            average::<N>(self.paths_at(u), means);
        }
    }
}

#[inline(always)]
fn add<const N: usize>(paths: [&[u8]; 4], sums: &mut [i16]) {
    let n = sums.len();
    let [a, b, c, d] = paths.map(|path| &path[..n]);
    for i in 0..n {
        sums[i] += total::<N>(a[i], b[i], c[i], d[i]);
    }
}

#[inline(always)]
fn average<const N: usize>(paths: [&[u8]; 4], means: &mut [u8]) {
    let n = means.len();
    let [a, b, c, d] = paths.map(|path| &path[..n]);
    for i in 0..n {
        let total = total::<N>(a[i], b[i], c[i], d[i]);
        means[i] = ((total + N as i16 / 2) >> N.ilog2()) as u8;
    }
}

/// The sum of the first N.
#[inline(always)]
fn total<const N: usize>(a: u8, b: u8, c: u8, d: u8) -> i16 {
    let [a, b, c, d] = [i16::from(a), i16::from(b), i16::from(c), i16::from(d)];
    match N {
        1 => a,
        2 => a + b,
        _ => a + b + c + d,
    }
}
