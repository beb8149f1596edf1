//! The data of a robust problem.

use super::{MatchSet, Unique, chance_near_line, chance_near_point};
use crate::{Error, Result};
use nalgebra::Point2;

/// Support of a model among the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// `Σ min(1, e²/T²)` over the data: 0 if all fit exactly. An incomplete sum, larger than the
    /// limit, if the scoring was broken off.
    pub cost: f64,
    /// Number of data within the threshold, among those looked at.
    pub num_inliers: usize,
}

/// The data of a robust problem, addressed by index `0..len()`.
///
/// The kind determines the loop's knowledge beyond the errors: repeated data, their weights, and
/// the probability of a fit by chance.
#[derive(Debug, Clone, Copy)]
pub enum Data<'a> {
    /// Matches between two images.
    Matches(&'a MatchSet),
    /// Pixels of one image, each different datum once.
    Pixels {
        /// The different ones, as many as `unique` has.
        pixels: &'a [Point2<f64>],
        /// Their places among the data that the caller gave.
        unique: &'a Unique,
    },
    /// Data of any other kind, given by their number.
    Other(usize),
}

impl<'a> Data<'a> {
    /// Number of different data.
    pub fn len(&self) -> usize {
        match self {
            Self::Matches(matches) => matches.len(),
            Self::Pixels { unique, .. } => unique.len(),
            Self::Other(len) => *len,
        }
    }

    /// Whether there are no data.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The matches, if the data are matches.
    pub fn matches(&self) -> Option<&'a MatchSet> {
        match *self {
            Self::Matches(matches) => Some(matches),
            _ => None,
        }
    }

    /// Checks that there are enough different data to find `what` in; see [`Unique::at_least`].
    pub(super) fn at_least(&self, needed: usize, what: &'static str) -> Result<()> {
        match (self.unique(), self.len()) {
            (Some(unique), _) => unique.at_least(needed, what),
            (None, got) if got < needed => Err(Error::TooFew { what, needed, got }),
            _ => Ok(()),
        }
    }

    /// The map from different data to given ones, if repetitions were left out.
    pub fn unique(&self) -> Option<&'a Unique> {
        match *self {
            Self::Matches(matches) => Some(matches.unique()),
            Self::Pixels { unique, .. } => Some(unique),
            Self::Other(_) => None,
        }
    }

    /// The votes of each datum; `None` if all count alike.
    fn votes(&self) -> Option<&'a [f64]> {
        self.matches().and_then(MatchSet::votes)
    }

    /// Cost of a model that nothing fits: the votes of all data.
    pub(crate) fn num_votes(&self) -> f64 {
        let count = || self.len() as f64;
        self.votes().map_or_else(count, |votes| votes.iter().sum())
    }

    /// Maximum number of these data that can be right at the same time.
    pub(crate) fn num_distinct(&self, indices: &[usize]) -> usize {
        self.matches()
            .map_or(indices.len(), |matches| matches.num_distinct(indices))
    }

    /// Probability that a datum unrelated to the model is within the threshold, if known.
    ///
    /// * `codimension`: 1 for distances from lines, 2 for distances from points
    pub(crate) fn chance(&self, codimension: usize, max_error_px: f64) -> Option<f64> {
        Some(match (*self, codimension) {
            (Self::Matches(matches), 1) => matches.chance_near_lines(max_error_px),
            (Self::Matches(matches), _) => matches.chance_near_point2(max_error_px),
            (Self::Pixels { pixels, .. }, codimension) => {
                let coordinates = [0, 1].map(|axis| pixels.iter().map(|p| p[axis]).collect());
                match codimension {
                    1 => chance_near_line(coordinates, max_error_px),
                    _ => chance_near_point(coordinates, max_error_px),
                }
            }
            (Self::Other(_), _) => return None,
        })
    }

    /// Support of a model, given its squared errors in px². Stops once the cost exceeds
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
