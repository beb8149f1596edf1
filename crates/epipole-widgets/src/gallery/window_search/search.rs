//! The costs of one window along its row, and their minimum.

use crate::kit::picture::{Picture, gray_levels};
use crate::kit::rectified::SIZE;
use epipole::imaging::GrayImage32;

/// Maximum candidate disparity, pixels.
pub(super) const REACH: usize = 48;
/// Half size of the largest window, pixels.
pub(super) const LARGEST_HALF: u32 = 10;
/// Disparities closer than this to the best one belong to the same minimum, pixels.
const APART: usize = 3;

/// Curve through the lowest cost and its neighbors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refinement {
    Parabola,
    /// Two lines of opposite slope.
    TwoLines,
}

/// Cost of each candidate disparity from 0 up: the mean absolute difference of both windows, gray
/// levels.
#[derive(Debug, Clone)]
pub(super) struct Curve(Vec<f64>);

/// The lowest cost and its neighbors, at disparities `at − 1`, `at` and `at + 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Three {
    /// Disparity of the lowest cost, pixels.
    pub(super) at: usize,
    pub(super) costs: [f64; 3],
}

impl Curve {
    /// Compares the window centered at column u and row v of the left photograph with those of the
    /// right one in the same rows. Candidates that leave the right photograph are omitted.
    pub(super) fn new([left, right]: &[Picture; 2], (u, v): (u32, u32), half: u32) -> Self {
        let side = 2 * half + 1;
        let rows = |picture: &Picture| -> GrayImage32 {
            let rows = image::imageops::crop_imm(picture.image(), 0, v - half, SIZE.0, side);
            gray_levels(&rows.to_image())
        };
        let (left, right) = (rows(left), rows(right));
        let most = REACH.min((u - half) as usize);
        let columns = (u - half) as usize..=(u + half) as usize;
        let width = SIZE.0 as usize;
        let cost = |disparity: usize| {
            let pairs = (left.as_raw().chunks_exact(width)).zip(right.as_raw().chunks_exact(width));
            let sum: f64 = pairs
                .flat_map(|(left, right)| {
                    (columns.clone()).map(|u| f64::from((left[u] - right[u - disparity]).abs()))
                })
                .sum();
            sum / f64::from(side * side)
        };
        Self((0..=most).map(cost).collect())
    }

    /// Returns the costs, from disparity 0 up.
    pub(super) fn costs(&self) -> &[f64] {
        &self.0
    }

    /// Returns the disparity of the lowest cost, the first of equal ones.
    pub(super) fn winner(&self) -> usize {
        let order = |a: &usize, b: &usize| self.0[*a].total_cmp(&self.0[*b]);
        (0..self.0.len()).min_by(order).unwrap_or(0)
    }

    /// Returns the lowest cost with its neighbors; `None` at the end of the range.
    pub(super) fn three(&self) -> Option<Three> {
        let at = self.winner();
        let costs = self.0.get(at.checked_sub(1)?..at + 2)?;
        Some(Three {
            at,
            costs: costs.try_into().ok()?,
        })
    }

    /// Returns the subpixel minimum, pixels.
    pub(super) fn minimum(&self, refinement: Refinement) -> f64 {
        let offset = self.three().map_or(0.0, |three| three.offset(refinement));
        self.winner() as f64 + offset
    }

    /// Returns the disparity of the lowest other local minimum, if any.
    pub(super) fn runner_up(&self) -> Option<usize> {
        let winner = self.winner();
        let is_minimum = |d: &usize| {
            let at = |d: usize| self.0.get(d).copied().unwrap_or(f64::INFINITY);
            d.abs_diff(winner) >= APART && at(*d) <= at(d.wrapping_sub(1)).min(at(d + 1))
        };
        let order = |a: &usize, b: &usize| self.0[*a].total_cmp(&self.0[*b]);
        (0..self.0.len()).filter(is_minimum).min_by(order)
    }

    /// Returns the highest cost, gray levels.
    pub(super) fn highest(&self) -> f64 {
        self.0.iter().copied().fold(0.0, f64::max)
    }
}

impl Three {
    /// Returns the lowest point of the curve relative to the lowest cost, −½ to ½ pixels.
    pub(super) fn offset(&self, refinement: Refinement) -> f64 {
        let [below, best, above] = self.costs;
        let steepness = match refinement {
            Refinement::Parabola => below + above - 2.0 * best,
            Refinement::TwoLines => 2.0 * (below.max(above) - best),
        };
        match refinement {
            _ if steepness <= 0.0 => 0.0,
            Refinement::Parabola => 0.5 * (below - above) / steepness,
            Refinement::TwoLines => (below - above) / steepness,
        }
    }

    /// Returns disparity and height of the lowest point of the curve.
    pub(super) fn lowest(&self, refinement: Refinement) -> (f64, f64) {
        let disparity = self.at as f64 + self.offset(refinement);
        (disparity, self.height(refinement, disparity))
    }

    /// Returns the height of the curve at a disparity, pixels.
    pub(super) fn height(&self, refinement: Refinement, disparity: f64) -> f64 {
        let [below, best, above] = self.costs;
        let x = disparity - self.at as f64;
        match refinement {
            Refinement::Parabola => {
                best + 0.5 * (above - below) * x + 0.5 * (below + above - 2.0 * best) * x * x
            }
            Refinement::TwoLines => {
                let slope = below.max(above) - best;
                (below - slope * (x + 1.0)).max(above + slope * (x - 1.0))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: [Refinement; 2] = [Refinement::Parabola, Refinement::TwoLines];

    fn three(cost: impl Fn(f64) -> f64) -> Three {
        Three {
            at: 7,
            costs: [6.0, 7.0, 8.0].map(cost),
        }
    }

    #[test]
    fn each_curve_recovers_its_own_minimum_and_passes_through_the_costs() {
        let bowl = three(|d| 3.0 + 2.0 * (d - 7.2) * (d - 7.2));
        let wedge = three(|d| 3.0 + 2.0 * (d - 6.7).abs());
        assert!((bowl.offset(Refinement::Parabola) - 0.2).abs() < 1e-12);
        assert!((wedge.offset(Refinement::TwoLines) + 0.3).abs() < 1e-12);
        for three in [bowl, wedge] {
            for refinement in BOTH {
                let (_, lowest) = three.lowest(refinement);
                for (cost, d) in three.costs.into_iter().zip([6.0, 7.0, 8.0]) {
                    assert!((three.height(refinement, d) - cost).abs() < 1e-12);
                    assert!(lowest <= cost);
                }
            }
        }
        // A parabola through a V-shaped minimum is biased towards the integer.
        assert!(wedge.offset(Refinement::Parabola).abs() < 0.29);
        for refinement in BOTH {
            assert_eq!(three(|_| 1.0).offset(refinement), 0.0);
        }
    }

    #[test]
    fn other_minima_are_apart_from_the_best_one() {
        let curve = Curve(vec![9.0, 2.0, 6.0, 5.0, 7.0, 3.0, 8.0]);
        assert_eq!((curve.winner(), curve.runner_up()), (1, Some(5)));
        assert_eq!(Curve(vec![1.0, 2.0, 3.0, 4.0]).runner_up(), None);
        let rising = Curve(vec![1.0, 2.0, 3.0]);
        assert_eq!((rising.three(), rising.minimum(BOTH[1])), (None, 0.0));
    }
}
