//! The best disparity of each pixel of a row, from the sums of costs, and whether to believe it.

use super::search::Search;

/// What makes an answer credible.
#[derive(Clone, Copy)]
pub(super) struct Tests {
    /// Percent by which every other disparity (two or more away) must cost more; below 100.
    pub(super) uniqueness_percent: u32,
    /// Largest difference between the left picture's and the right picture's answer.
    pub(super) left_right_max: Option<u32>,
}

/// Selects the answers of a row, pixel by pixel.
pub(super) struct Selector<'a> {
    search: Search<'a>,
    tests: Tests,
    /// The best disparity of each left pixel, from the smallest looked for.
    winners: Vec<usize>,
    /// The fraction beside the winner; NaN where the pixel has no answer.
    offsets: Vec<f32>,
    /// The best sum of each right pixel and its disparity, from the row's end on.
    right_sums: Vec<i16>,
    right_winners: Vec<i16>,
}

impl<'a> Selector<'a> {
    pub(super) fn new(search: Search<'a>, tests: Tests) -> Self {
        let len = search.width + search.num_cells;
        Self {
            search,
            tests,
            winners: vec![0; search.width],
            offsets: vec![0.0; search.width],
            right_sums: vec![i16::MAX; len],
            right_winners: vec![0; len],
        }
    }

    /// Takes in the sums of column u, `num_cells` many; those beyond the last disparity are
    /// overwritten.
    #[inline(always)]
    pub(super) fn pixel(&mut self, u: usize, sums: &mut [i16]) {
        let (n, count) = (self.search.num_cells, self.search.num_disparities);
        let sums = &mut sums[..n];
        if count < n {
            sums[count..].fill(i16::MAX);
        }
        if self.tests.left_right_max.is_some() {
            let at = self.search.width - 1 - u;
            keep_smaller(
                sums,
                &mut self.right_sums[at..at + n],
                &mut self.right_winners[at..at + n],
            );
        }
        let (best, winner) = minimum(sums);
        let good =
            self.search.cells_inside(u).contains(&winner) && self.is_unique(sums, best, winner);
        self.winners[u] = winner;
        self.offsets[u] = if good { refine(sums, winner) } else { f32::NAN };
    }

    /// The answers after all pixels were taken in, NaN for none.
    #[inline(always)]
    pub(super) fn finish_row(&mut self, disparities: &mut [f32]) {
        for (u, out) in disparities.iter_mut().enumerate() {
            let (winner, offset) = (self.winners[u], self.offsets[u]);
            *out = if !offset.is_nan() && self.is_mutual(u, winner, offset) {
                (self.search.min_disparity + winner as i32) as f32 + offset
            } else {
                f32::NAN
            };
        }
        self.right_sums.fill(i16::MAX);
    }

    /// No other disparity, apart from the winner's neighbors, comes close.
    #[inline(always)]
    fn is_unique(&self, cells: &[i16], best: i16, winner: usize) -> bool {
        let percent = self.tests.uniqueness_percent as i32;
        if percent == 0 {
            return true;
        }
        let limit = (i32::from(best) * 100 / (100 - percent)).min(i32::from(i16::MAX)) as i16;
        let mut below = 0i16;
        for &sum in cells {
            below += i16::from(sum <= limit);
        }
        let near = winner.saturating_sub(1)..(winner + 2).min(cells.len());
        let expected = cells[near].iter().filter(|&&s| s <= limit).count();
        below as usize <= expected
    }

    /// The right pixel, on either side of the sub-pixel answer, sees it from its side too.
    #[inline(always)]
    fn is_mutual(&self, u: usize, winner: usize, offset: f32) -> bool {
        let Some(max) = self.tests.left_right_max else {
            return true;
        };
        let second = if offset > 0.0 {
            winner + 1
        } else {
            winner.saturating_sub(1)
        };
        let inside = self.search.cells_inside(u);
        [winner, second].into_iter().any(|d| {
            inside.contains(&d) && {
                let other = self.right_winners[self.search.width - 1 - u + d] as usize;
                other.abs_diff(winner) <= max as usize
            }
        })
    }
}

/// Where a sum is smaller than the best so far, it and its place replace them.
#[inline(always)]
fn keep_smaller(sums: &[i16], best: &mut [i16], places: &mut [i16]) {
    let n = sums.len();
    let (best, places) = (&mut best[..n], &mut places[..n]);
    for d in 0..n {
        let (sum, least, place) = (sums[d], best[d], places[d]);
        places[d] = if sum < least { d as i16 } else { place };
        best[d] = least.min(sum);
    }
}

/// The smallest sum and its first place.
#[inline(always)]
fn minimum(cells: &[i16]) -> (i16, usize) {
    let mut lowest = i16::MAX;
    for &sum in cells {
        lowest = lowest.min(sum);
    }
    let mut place = i16::MAX;
    for (d, &sum) in cells.iter().enumerate() {
        place = place.min(if sum == lowest { d as i16 } else { i16::MAX });
    }
    (lowest, place as usize)
}

/// How far the true minimum lies from the winner, −½ to ½: where two lines of opposite slope meet
/// that pass through the winner and its neighbors. Sums of absolute differences and of bits are
/// such wedges; a parabola would draw fractions towards the whole numbers.
///
/// Source: Shimizu & Okutomi 2001, "Precise sub-pixel estimation on area-based matching".
#[inline(always)]
fn refine(cells: &[i16], winner: usize) -> f32 {
    if winner == 0 || winner + 1 >= cells.len() || cells[winner + 1] == i16::MAX {
        return 0.0;
    }
    let [below, best, above] = [
        f32::from(cells[winner - 1]),
        f32::from(cells[winner]),
        f32::from(cells[winner + 1]),
    ];
    let slope = below.max(above) - best;
    if slope <= 0.0 {
        return 0.0;
    }
    0.5 * (below - above) / slope
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wedge_is_refined_exactly() {
        // |d − 2.25| × 8 at 1, 2, 3.
        assert_eq!(refine(&[18, 10, 2, 6, 14], 2), 0.25);
        assert_eq!(refine(&[4, 4, 4], 1), 0.0);
        assert_eq!(refine(&[1, 4], 0), 0.0);
    }

    #[test]
    fn the_first_of_equal_sums_wins() {
        let mut sums = [50i16; 32];
        sums[17] = 9;
        sums[30] = 9;
        assert_eq!(minimum(&sums), (9, 17));
    }
}
