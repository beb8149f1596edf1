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

/// Where a path comes from, at one pixel.
#[derive(Clone, Copy)]
struct Previous<'a> {
    /// From the cell before disparity 0 to the cell after the last.
    cells: &'a [u8],
    minimum: u8,
    /// `minimum + P2`.
    jump: u8,
}

/// Continues one path by one pixel: writes its costs to `next` and tells the smallest.
#[inline(always)]
fn advance<const BLOCK: usize>(costs: &[u8], previous: Previous, p1: u8, next: &mut [u8]) -> u8 {
    let (jump, minimum) = (previous.jump, previous.minimum);
    let mut least = [u8::MAX; BLOCK];
    for at in (0..costs.len()).step_by(BLOCK) {
        let cost = &costs[at..at + BLOCK];
        let before = &previous.cells[at..at + BLOCK + 2];
        let after = &mut next[at..at + BLOCK];
        for i in 0..BLOCK {
            let beside = before[i].min(before[i + 2]).saturating_add(p1);
            let best = before[i + 1].min(beside).min(jump).wrapping_sub(minimum);
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

/// Adds up (to `sums`, with ADD) the costs of N paths that lie `stride` apart. Apart from
/// [`advance`], since sums need twice the bits and would halve the lanes there.
#[inline(always)]
fn add_up<const BLOCK: usize, const N: usize, const ADD: bool>(
    paths: &[u8],
    stride: usize,
    sums: &mut [i16],
) {
    for at in (0..sums.len()).step_by(BLOCK) {
        let sum = &mut sums[at..at + BLOCK];
        let path_0 = &paths[at..at + BLOCK];
        let other = |n: usize| if n < N { n * stride + at } else { at };
        let path_1 = &paths[other(1)..][..BLOCK];
        let path_2 = &paths[other(2)..][..BLOCK];
        let path_3 = &paths[other(3)..][..BLOCK];
        for i in 0..BLOCK {
            let mut total = i16::from(path_0[i]);
            if N >= 2 {
                total += i16::from(path_1[i]);
            }
            if N >= 4 {
                total += i16::from(path_2[i]) + i16::from(path_3[i]);
            }
            sum[i] = if ADD { sum[i] + total } else { total };
        }
    }
}

/// The path costs of one row of pixels in N directions, with a border pixel at either end.
struct PathRow<const N: usize> {
    /// Per pixel N × (pad, cells, pad).
    cells: Vec<u8>,
    minima: Vec<[u8; N]>,
}

impl<const N: usize> PathRow<N> {
    /// Paths yet to begin: L = 0, so that a first pixel costs C alone.
    fn new(width: usize, num_cells: usize) -> Self {
        let mut cells = vec![u8::MAX; (width + 2) * N * (num_cells + 2 * PAD)];
        for path in cells.chunks_exact_mut(num_cells + 2 * PAD) {
            path[PAD..PAD + num_cells].fill(0);
        }
        Self {
            cells,
            minima: vec![[0; N]; width + 2],
        }
    }
}

/// A sweep over the rows that carries N paths: always the one along the row (first), with N = 2
/// also the vertical one, with N = 4 also both diagonals.
pub(super) struct Sweep<const N: usize> {
    row: PathRow<N>,
    row_before: PathRow<N>,
    gray_before: Vec<u8>,
    num_cells: usize,
    /// From the last pixel to the first.
    backward: bool,
}

impl<const N: usize> Sweep<N> {
    /// * `num_cells`: disparities per pixel, a multiple of 16
    pub(super) fn new(width: usize, num_cells: usize, backward: bool) -> Self {
        Self {
            row: PathRow::new(width, num_cells),
            row_before: PathRow::new(width, num_cells),
            gray_before: vec![0; width],
            num_cells,
            backward,
        }
    }

    /// Continues all paths through the next row.
    ///
    /// * `costs`: width × `num_cells`
    /// * `gray`: this row of the left picture
    /// * `sums`: receives (or, with ADD, gains) the sum of the N path costs
    #[inline(always)]
    pub(super) fn next_row<const ADD: bool>(
        &mut self,
        costs: &[u8],
        gray: &[u8],
        penalties: &Penalties,
        sums: &mut [i16],
    ) {
        if self.num_cells % 32 == 0 {
            self.next_row_in_blocks::<32, ADD>(costs, gray, penalties, sums);
        } else {
            self.next_row_in_blocks::<16, ADD>(costs, gray, penalties, sums);
        }
    }

    #[inline(always)]
    fn next_row_in_blocks<const BLOCK: usize, const ADD: bool>(
        &mut self,
        costs: &[u8],
        gray: &[u8],
        penalties: &Penalties,
        sums: &mut [i16],
    ) {
        let (width, num_cells) = (gray.len(), self.num_cells);
        let stride = num_cells + 2 * PAD;
        let pixel_len = N * stride;
        // The step in u from a pixel to where its path along the row comes from.
        let back: isize = if self.backward { 1 } else { -1 };
        std::mem::swap(&mut self.row, &mut self.row_before);
        let row_before = &self.row_before;
        for i in 0..width {
            let u = if self.backward { width - 1 - i } else { i };
            // The pixel before in this row is read while this one is written.
            let (along, next, along_minimum) = if self.backward {
                let (low, high) = self.row.cells.split_at_mut((u + 2) * pixel_len);
                let next = &mut low[(u + 1) * pixel_len..];
                (&high[..stride], next, self.row.minima[u + 2][0])
            } else {
                let (low, high) = self.row.cells.split_at_mut((u + 1) * pixel_len);
                let along = &low[u * pixel_len..];
                (along, &mut high[..pixel_len], self.row.minima[u][0])
            };
            let costs = &costs[u * num_cells..(u + 1) * num_cells];
            let mut minima = [0; N];
            for n in 0..N {
                let step = match (N, n) {
                    (_, 0) | (4, 1) => back,
                    (4, 3) => -back,
                    _ => 0,
                };
                let there = (u as isize + step).clamp(0, width as isize - 1) as usize;
                let (cells, minimum, gray_there) = if n == 0 {
                    (&along[PAD - 1..], along_minimum, gray[there])
                } else {
                    let pixel = (u as isize + 1 + step) as usize;
                    let begin = pixel * pixel_len + n * stride + PAD - 1;
                    let minimum = row_before.minima[pixel][n];
                    (&row_before.cells[begin..], minimum, self.gray_before[there])
                };
                let p2 = penalties.p2_of_gray_step[usize::from(gray[u].abs_diff(gray_there))];
                let previous = Previous {
                    cells: &cells[..num_cells + 2],
                    minimum,
                    jump: minimum.saturating_add(p2),
                };
                let target = &mut next[n * stride + PAD..][..num_cells];
                minima[n] = advance::<BLOCK>(costs, previous, penalties.p1, target);
            }
            self.row.minima[u + 1] = minima;
            let sums = &mut sums[u * num_cells..(u + 1) * num_cells];
            add_up::<BLOCK, N, ADD>(&next[PAD..], stride, sums);
        }
        self.gray_before.copy_from_slice(gray);
    }
}
