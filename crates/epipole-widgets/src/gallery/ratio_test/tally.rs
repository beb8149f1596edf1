//! Counts of matches that pass the tests, and of the correct ones among them.

use super::question::{Answer, Candidate};

/// Criteria for accepting matches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rules {
    /// Maximum ratio of the distances to the nearest and the second nearest; 1 disables the test.
    pub(super) max_ratio: f32,
    /// Whether to require mutual nearest neighbors.
    pub(super) is_mutual: bool,
}

impl Rules {
    pub(super) fn keep(&self, candidate: &Candidate) -> bool {
        (candidate.ratio < self.max_ratio || self.max_ratio == 1.0)
            && (candidate.is_mutual || !self.is_mutual)
    }
}

/// Counts of accepted matches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tally {
    pub(super) num_kept: usize,
    pub(super) num_right: usize,
    num_findable: usize,
}

impl Tally {
    pub(super) fn of(answer: &Answer, rules: Rules) -> Self {
        let kept = answer.candidates.iter().filter(|found| rules.keep(found));
        let (mut num_kept, mut num_right) = (0, 0);
        for found in kept {
            num_kept += 1;
            num_right += usize::from(found.is_right);
        }
        Self {
            num_kept,
            num_right,
            num_findable: answer.num_findable as usize,
        }
    }

    /// Returns the fraction of accepted matches that are correct; `None` if none are accepted.
    pub(super) fn precision(&self) -> Option<f64> {
        (self.num_kept > 0).then(|| self.num_right as f64 / self.num_kept as f64)
    }

    /// Returns the fraction of findable matches that are found.
    pub(super) fn recall(&self) -> f64 {
        self.num_right as f64 / self.num_findable.max(1) as f64
    }
}
