//! The RANSAC loop on points near a hidden line, with the votes of every sample.

use crate::kit::line_points::Consensus;
use crate::kit::samples::{Rules, Samples};
use epipole::Error;
use epipole::math::Line2;
use epipole::robust::LineEstimator;
use nalgebra::Point2;

/// Outcome of one sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Vote {
    pub(crate) num_votes: usize,
    /// Whether its line became the best.
    pub(crate) is_best: bool,
}

/// Samples so far, and their outcomes.
pub(crate) struct Tally {
    pub(crate) samples: Samples<LineEstimator>,
    pub(crate) votes: Vec<Vote>,
    /// Line of the last sample, with its inliers.
    pub(crate) candidate: Option<Consensus>,
    /// Best line so far, refitted to its inliers.
    pub(crate) best: Option<Consensus>,
    /// Hidden line, with its inliers.
    pub(crate) truth: Consensus,
}

impl Tally {
    /// Draws `num_samples` samples, or fewer if they are sufficient.
    ///
    /// # Errors
    /// As [`Samples::new`].
    pub(crate) fn new(
        places: &[Point2<f64>],
        truth: Line2,
        rules: Rules,
        num_samples: usize,
    ) -> Result<Self, Error> {
        let consensus = |line: &Line2| Consensus::of(*line, places, rules.epsilon_px);
        let mut samples = Samples::new(LineEstimator::new(places)?, rules)?;
        let (mut votes, mut candidate) = (Vec::new(), None);
        for count in 1..=num_samples {
            if samples.is_finished() {
                break;
            }
            let is_best = samples.draw_to(count);
            let last = samples.last().and_then(|last| last.model.as_ref());
            candidate = last.map(consensus);
            votes.push(Vote {
                num_votes: candidate.as_ref().map_or(0, Consensus::num_votes),
                is_best,
            });
        }
        let best = samples.best().map(consensus);
        Ok(Self {
            best: best.map(|best| best.refitted(places)),
            truth: consensus(&truth),
            samples,
            votes,
            candidate,
        })
    }

    /// Returns the indices of the points of the last sample.
    pub(crate) fn sample(&self) -> &[usize] {
        self.samples.last().map_or(&[], |last| &last.sample)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::line_points::scatter;

    #[test]
    fn every_sample_has_its_votes() {
        let scattered = scatter(3, 60, 0.5);
        let places = &scattered.points;
        let rules = Rules {
            epsilon_px: 10.0,
            seed: 3,
            max_samples: 500,
            msac: false,
            local_optimization: false,
        };
        let tally = Tally::new(places, scattered.truth, rules, 500).unwrap();
        assert_eq!(tally.votes.len(), tally.samples.count());
        assert!(tally.samples.is_finished() && tally.votes[0].is_best);
        // The best is the first sample with the most votes, and each best has more than the
        // previous one.
        let most = tally.votes.iter().map(|vote| vote.num_votes).max().unwrap();
        assert_eq!(tally.best.unwrap().num_votes(), most);
        let kept = tally.votes.iter().filter(|vote| vote.is_best);
        let kept: Vec<usize> = kept.map(|vote| vote.num_votes).collect();
        assert!(kept.windows(2).all(|pair| pair[0] < pair[1]), "{kept:?}");
        let none = Tally::new(places, scattered.truth, rules, 0).unwrap();
        assert!(none.candidate.is_none() && none.best.is_none() && none.sample().is_empty());
        assert!(Tally::new(&places[..1], scattered.truth, rules, 5).is_err());
    }
}
