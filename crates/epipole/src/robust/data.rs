//! The data of a robust problem.

use super::{MatchSet, Unique, probability_near_line, probability_near_point};
use crate::{Error, Result};
use nalgebra::Point2;

/// Support of a model among the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// `Σ min(1, e²/T²)` over the data: 0 if all fit exactly. Incomplete, but above the limit, if
    /// the scoring stopped early.
    pub cost: f64,
    /// Number of inliers among the data points scored.
    pub num_inliers: usize,
}

/// The data of a robust problem, addressed by index `0..len()`.
///
/// The kind determines additional knowledge: repeated data, weights, and the probability of a fit
/// by chance.
#[derive(Debug, Clone, Copy)]
pub enum Data<'a> {
    /// Matches between two images.
    Matches(&'a MatchSet),
    /// Pixels of one image, without repetitions.
    Pixels {
        /// The unique pixels, in the order of `unique`.
        pixels: &'a [Point2<f64>],
        /// Their indices in the data from the caller.
        unique: &'a Unique,
    },
    /// Number of data of any other kind.
    Other(usize),
}

impl<'a> Data<'a> {
    /// Returns the number of unique data points.
    pub fn len(&self) -> usize {
        match self {
            Self::Matches(matches) => matches.len(),
            Self::Pixels { unique, .. } => unique.len(),
            Self::Other(len) => *len,
        }
    }

    /// Returns whether there are no data.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the matches, if the data are matches.
    pub fn matches(&self) -> Option<&'a MatchSet> {
        match *self {
            Self::Matches(matches) => Some(matches),
            _ => None,
        }
    }

    /// Checks that there are enough unique data to estimate `what`; see [`Unique::at_least`].
    pub(super) fn at_least(&self, needed: usize, what: &'static str) -> Result<()> {
        match (self.unique(), self.len()) {
            (Some(unique), _) => unique.at_least(needed, what),
            (None, got) if got < needed => Err(Error::TooFew { what, needed, got }),
            _ => Ok(()),
        }
    }

    /// Returns the map between unique and given data, if repetitions were removed.
    pub fn unique(&self) -> Option<&'a Unique> {
        match *self {
            Self::Matches(matches) => Some(matches.unique()),
            Self::Pixels { unique, .. } => Some(unique),
            Self::Other(_) => None,
        }
    }

    /// Returns the weight of each data point; `None` if all are equal.
    fn votes(&self) -> Option<&'a [f64]> {
        self.matches().and_then(MatchSet::votes)
    }

    /// Returns the cost of a model without inliers: the weights of all data.
    pub(crate) fn num_votes(&self) -> f64 {
        let count = || self.len() as f64;
        self.votes().map_or_else(count, |votes| votes.iter().sum())
    }

    /// Returns the maximum number of these data points that can be correct at the same time.
    pub(crate) fn num_distinct(&self, indices: &[usize]) -> usize {
        self.matches()
            .map_or(indices.len(), |matches| matches.num_distinct(indices))
    }

    /// Returns the probability that an unrelated data point is within the threshold, if known.
    ///
    /// * `codimension`: 1 for distances from lines, 2 for distances from points
    pub(crate) fn random_inlier_probability(
        &self,
        codimension: usize,
        max_error_px: f64,
    ) -> Option<f64> {
        Some(match (*self, codimension) {
            (Self::Matches(matches), 1) => matches.probability_near_lines(max_error_px),
            (Self::Matches(matches), _) => matches.probability_near_point2(max_error_px),
            (Self::Pixels { pixels, .. }, codimension) => {
                let coordinates = [0, 1].map(|axis| pixels.iter().map(|p| p[axis]).collect());
                match codimension {
                    1 => probability_near_line(coordinates, max_error_px),
                    _ => probability_near_point(coordinates, max_error_px),
                }
            }
            (Self::Other(_), _) => return None,
        })
    }

    /// Computes the support of a model from its squared errors in px². Stops once the cost exceeds
    /// `cost_limit`.
    pub(crate) fn support(
        &self,
        error_sq: impl Fn(usize) -> f64,
        max_error_px: f64,
        cost_limit: f64,
    ) -> Support {
        let per_threshold_sq = 1.0 / (max_error_px * max_error_px);
        let mut support = Support {
            cost: 0.0,
            num_inliers: 0,
        };
        let votes = self.votes();
        for i in 0..self.len() {
            let relative = error_sq(i) * per_threshold_sq;
            let vote = votes.map_or(1.0, |votes| votes[i]);
            if relative < 1.0 {
                support.cost += vote * relative;
                support.num_inliers += 1;
            } else {
                support.cost += vote;
                if support.cost > cost_limit {
                    break;
                }
            }
        }
        support
    }
}
