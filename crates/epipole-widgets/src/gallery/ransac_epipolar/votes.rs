//! The votes of matches for a fundamental matrix, sample by sample.

use super::question::Match;
use crate::kit::samples::{Rules, Samples};
use epipole::Error;
use epipole::epipolar::{FundamentalEstimator, refine_fundamental, sampson_px};
use epipole::optim::RobustLoss;
use epipole::robust::MatchSet;
use nalgebra::{Matrix3, Point2};

/// An election that was begun.
pub(super) struct Votes {
    samples: Samples<FundamentalEstimator>,
    pixels1: Vec<Point2<f64>>,
    pixels2: Vec<Point2<f64>>,
    best: Option<Best>,
}

/// The F with the most votes so far.
pub(super) struct Best {
    /// Which matches vote for it.
    pub(super) is_inlier: Vec<bool>,
    pub(super) num_votes: usize,
    /// Fitted once more, to all that vote for it.
    pub(super) fundamental: Matrix3<f64>,
    /// Mean Sampson distance of its voters, pixels.
    pub(super) mean_px: f64,
}

impl Votes {
    /// No sample has been drawn yet.
    ///
    /// # Errors
    /// As [`FundamentalEstimator::new`]: too few matches, or all on a line.
    pub(super) fn new(matches: &[&Match], rules: Rules) -> Result<Self, Error> {
        let pixels1: Vec<_> = matches.iter().map(|found| found.pixel1()).collect();
        let pixels2: Vec<_> = matches.iter().map(|found| found.pixel2()).collect();
        let estimator = FundamentalEstimator::new(MatchSet::new(&pixels1, &pixels2)?)?;
        Ok(Self {
            samples: Samples::new(estimator, rules)?,
            pixels1,
            pixels2,
            best: None,
        })
    }

    /// Draws until there are so many samples in all, or enough.
    pub(super) fn draw_to(&mut self, count: usize) {
        if self.samples.draw_to(count) {
            let best = self.samples.best();
            self.best = best.map(|fundamental| self.refitted(fundamental));
        }
    }

    /// Which matches vote for a fundamental matrix.
    fn votes(&self, fundamental: &Matrix3<f64>) -> Vec<bool> {
        let most_px = self.samples.rules().epsilon_px;
        let pairs = self.pixels1.iter().zip(&self.pixels2);
        pairs
            .map(|(p, q)| sampson_px(fundamental, p, q) < most_px)
            .collect()
    }

    /// The voters of an F, and F fitted to all of them.
    fn refitted(&self, fundamental: &Matrix3<f64>) -> Best {
        let is_inlier = self.votes(fundamental);
        let chosen = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
            let marked = pixels.iter().zip(&is_inlier);
            marked.filter(|(_, is)| **is).map(|(p, _)| *p).collect()
        };
        let (pixels1, pixels2) = (chosen(&self.pixels1), chosen(&self.pixels2));
        // Voters that do not determine F keep the one of its sample.
        let fundamental = refine_fundamental(fundamental, &pixels1, &pixels2, RobustLoss::Trivial)
            .unwrap_or(*fundamental);
        let pairs = pixels1.iter().zip(&pixels2);
        let sum: f64 = pairs.map(|(p, q)| sampson_px(&fundamental, p, q)).sum();
        Best {
            num_votes: pixels1.len(),
            mean_px: sum / pixels1.len().max(1) as f64,
            is_inlier,
            fundamental,
        }
    }

    /// The loop that draws.
    pub(super) fn samples(&self) -> &Samples<FundamentalEstimator> {
        &self.samples
    }

    pub(super) fn best(&self) -> Option<&Best> {
        self.best.as_ref()
    }

    /// How many matches vote for the F of the last sample; none if it gave no F.
    pub(super) fn num_votes_of_last(&self) -> Option<usize> {
        let last = self.samples.last()?;
        let votes = last.model.as_ref().map(|model| self.votes(model));
        Some(votes.map_or(0, |votes| votes.iter().filter(|is| **is).count()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::scenes::still_life_pair;
    use epipole::math::random::Random;
    use nalgebra::Point3;

    const NUM_RIGHT: usize = 60;
    const RULES: Rules = Rules {
        epsilon_px: 1.0,
        seed: 3,
        max_samples: 1000,
        msac: false,
        local_optimization: false,
    };

    /// Matches of random points before two cameras, the last 40 of them wrong.
    fn matches() -> Vec<Match> {
        let mut random = Random::new(9);
        let [first, second] = still_life_pair((640, 480), 0.4, -0.3, 12.0);
        let mut point = || {
            let (x, y) = (random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.3));
            Point3::new(x, y, random.uniform(-0.4, 0.9))
        };
        let right = (0..NUM_RIGHT).map(|_| point()).collect::<Vec<_>>();
        let wrong = (0..40).map(|_| (point(), point())).collect::<Vec<_>>();
        let pairs = right.iter().map(|p| (*p, *p)).chain(wrong);
        let seen = pairs.map(|(p, q)| Match {
            places: [first.project(&p).unwrap(), second.project(&q).unwrap()]
                .map(|pixel| pixel.coords.into()),
            ratio: 0.5,
            is_right: Some(p == q),
        });
        seen.collect()
    }

    #[test]
    fn the_right_matches_win() {
        let matches = matches();
        let mut votes = Votes::new(&matches.iter().collect::<Vec<_>>(), RULES).unwrap();
        votes.draw_to(1000);
        assert!(votes.samples().is_confident() && votes.samples().is_finished());
        let best = votes.best().unwrap();
        assert!(best.is_inlier[..NUM_RIGHT].iter().all(|is| *is));
        assert!(best.num_votes <= NUM_RIGHT + 3, "{}", best.num_votes);
        assert!(best.mean_px < 0.1, "{}", best.mean_px);
        assert!(votes.num_votes_of_last().unwrap() <= best.num_votes);
    }

    #[test]
    fn too_few_matches_are_a_sentence() {
        let matches = matches();
        let few: Vec<&Match> = matches[..6].iter().collect();
        assert!(Votes::new(&few, RULES).is_err());
    }
}
