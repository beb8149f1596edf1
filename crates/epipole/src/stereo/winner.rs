//! Selection of the best disparity of each pixel of a row from the cost sums, with validity tests.

use super::filter::DisparityFilter;
use super::search::Search;
use crate::math::simd::dispatched;

/// Selector of disparities, row by row.
pub(super) struct Selector<'a> {
    search: Search<'a>,
    filter: DisparityFilter,
    /// Best disparity of each left pixel, relative to the minimum.
    winners: Vec<i16>,
    /// Sub-pixel offset from the winner; NaN if it is not unique.
    offsets: Vec<f32>,
    /// Best sum of each right pixel and its disparity, in reverse; empty without a left–right test.
    right_sums: Vec<i16>,
    right_winners: Vec<i16>,
}

impl<'a> Selector<'a> {
    pub(super) fn new(search: Search<'a>, filter: DisparityFilter) -> Self {
        let len = match filter.left_right_max_px {
            Some(_) => search.width + search.num_cells,
            None => 0,
        };
        Self {
            search,
            filter,
            winners: vec![0; search.width],
            offsets: vec![0.0; search.width],
            right_sums: vec![0; len],
            right_winners: vec![0; len],
        }
    }

    /// * `sums`: width × `num_cells`; those beyond the last disparity are overwritten
    /// * `disparities`: disparities of the row, NaN if invalid
    pub(super) fn row(&mut self, sums: &mut [i16], disparities: &mut [f32]) {
        let (n, count) = (self.search.num_cells, self.search.num_disparities);
        if count < n {
            for cells in sums.chunks_exact_mut(n) {
                cells[count..].fill(i16::MAX);
            }
        }
        self.right_sums.fill(i16::MAX);
        find_winners(
            n,
            self.filter.uniqueness_percent as i32,
            sums,
            &mut self.winners,
            &mut self.offsets,
            &mut self.right_sums,
            &mut self.right_winners,
        );
        for (u, out) in disparities.iter_mut().enumerate() {
            let (winner, offset) = (self.winners[u] as usize, self.offsets[u]);
            let good = !offset.is_nan()
                && self.search.cells_inside(u).contains(&winner)
                && self.is_mutual(u, winner, offset);
            *out = if good {
                (self.search.min_disparity + winner as i32) as f32 + offset
            } else {
                f32::NAN
            };
        }
    }

    /// Returns whether a right pixel on either side of the sub-pixel match agrees.
    #[inline(always)]
    fn is_mutual(&self, u: usize, winner: usize, offset: f32) -> bool {
        let Some(max) = self.filter.left_right_max_px else {
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

dispatched! {
    /// Finds the winner of each pixel with its offset, and the winners from the right.
    fn find_winners(
        num_cells: usize,
        uniqueness_percent: i32,
        sums: &[i16],
        winners: &mut [i16],
        offsets: &mut [f32],
        right_sums: &mut [i16],
        right_winners: &mut [i16],
    ) {
        let width = winners.len();
        for (u, cells) in sums.chunks_exact(num_cells).enumerate() {
            if !right_sums.is_empty() {
                // The diagonal of this row's sums that ends in right pixel u.
                let at = width - 1 - u;
                keep_smaller(
                    cells,
                    &mut right_sums[at..][..num_cells],
                    &mut right_winners[at..][..num_cells],
                );
            }
            let (best, winner) = minimum(cells);
            winners[u] = winner as i16;
            offsets[u] = if is_unique(cells, best, winner, uniqueness_percent) {
                refine(cells, winner)
            } else {
                f32::NAN
            };
        }
    }
}

/// Returns whether no disparity, apart from the winner's neighbors, comes within this percentage.
#[inline(always)]
fn is_unique(cells: &[i16], best: i16, winner: usize, percent: i32) -> bool {
    if percent == 0 {
        return true;
    }
    let limit = (i32::from(best) * 100 / (100 - percent)).min(i32::from(i16::MAX) - 1) as i16;
    let mut below = 0i16;
    for &sum in cells {
        below += i16::from(sum <= limit);
    }
    let near = winner.saturating_sub(1)..(winner + 2).min(cells.len());
    let expected = cells[near].iter().filter(|&&s| s <= limit).count();
    below as usize <= expected
}

/// Replaces the best sums and their indices by smaller ones.
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

/// Returns the smallest sum and its first index.
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

/// Returns the offset of the true minimum from the winner, −½ to ½: the intersection of two lines
/// of opposite slope through the winner and its neighbors. Sums of absolute differences and Hamming
/// distances are V-shaped; a parabola would bias offsets towards integers.
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
