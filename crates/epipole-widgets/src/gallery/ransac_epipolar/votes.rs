//! The votes of matches for a fundamental matrix, sample by sample.

use super::matches::Match;
use crate::contract::Progress;
use crate::kit::question::tell;
use crate::kit::samples::{Drawn, Rules, Samples};
use epipole::Error;
use epipole::epipolar::{FundamentalEstimator, refine_fundamental, sampson_px};
use epipole::optim::RobustLoss;
use epipole::robust::MatchSet;
use epipole::two_view::{Degeneracy, TwoViewOptions, find_degeneracy};
use nalgebra::{Matrix3, Point2};
use serde::{Deserialize, Serialize};

/// Who votes, and by which rules.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Voters {
    /// Column and row in photograph 1, then in photograph 2, of each match.
    pub(super) places: Vec<[[f64; 2]; 2]>,
    /// No match has a larger ratio.
    pub(super) most_ratio: f32,
    pub(super) rules: Rules,
    /// Whether nobody knows the truth: then it is asked what the votes leave open.
    pub(super) is_own: bool,
}

/// An election from its first sample to its last.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Votes {
    trials: Vec<Trial>,
    /// Each has more votes than the one before.
    bests: Vec<Best>,
    /// Why there is none, as a sentence.
    pub(super) refusal: Option<String>,
    /// What the voters of the last of them do not determine.
    pub(super) left_open: Option<LeftOpen>,
}

/// Why an F is one of many, and how many of its voters say so.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum LeftOpen {
    /// They are at one place in both photographs.
    Unmoved(usize),
    /// One homography explains them.
    Homography(usize),
}

/// One sample and what came of it.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Trial {
    /// Indices of its seven matches.
    pub(super) sample: Vec<usize>,
    /// How many matches vote for its F; none if it gave no F.
    pub(super) num_votes: usize,
    /// How far the loop has come with it.
    pub(super) drawn: Drawn,
    /// How many of the best ones have been found by now.
    num_bests: usize,
}

/// The F with the most votes so far.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Best {
    /// Which matches vote for it.
    pub(super) is_inlier: Vec<bool>,
    pub(super) num_votes: usize,
    /// Fitted once more, to all that vote for it.
    pub(super) fundamental: Matrix3<f64>,
    /// Mean Sampson distance of its voters, pixels.
    pub(super) mean_px: f64,
}

impl Voters {
    pub(super) fn new(matches: &[&Match], most_ratio: f32, rules: Rules) -> Self {
        Self {
            is_own: matches.iter().all(|found| found.is_right.is_none()),
            places: matches.iter().map(|found| found.places).collect(),
            most_ratio,
            rules,
        }
    }

    /// Holds the election. Too few matches, or all on a line, are a refusal.
    ///
    /// # Errors
    /// [`Error::Canceled`] if `progress` ended it.
    pub(super) fn vote(&self, progress: Progress<'_>) -> Result<Votes, Error> {
        let mut votes = Votes::default();
        let mut samples = match self.begin() {
            Ok(samples) => samples,
            Err(error) => {
                votes.refusal = Some(format!("There is no F: {error}."));
                return Ok(votes);
            }
        };
        while !samples.is_finished() {
            let count = samples.count() + 1;
            if samples.draw_to(count) {
                let best = samples.best().map(|fundamental| self.refitted(fundamental));
                votes.bests.extend(best);
            }
            // A loop that draws nothing more is at its end.
            let Some(last) = samples.last().filter(|_| samples.count() == count) else {
                break;
            };
            let model = last.model.as_ref();
            votes.trials.push(Trial {
                sample: last.sample.clone(),
                num_votes: model.map_or(0, |model| self.inliers(model).filter(|is| *is).count()),
                drawn: samples.drawn(),
                num_bests: votes.bests.len(),
            });
            if count % 50 == 0 {
                tell(progress, count as f64 / self.rules.max_samples as f64)?;
            }
        }
        if let (Some(best), true) = (votes.bests.last(), self.is_own) {
            votes.left_open = self.left_open(best)?;
        }
        Ok(votes)
    }

    /// What the voters of an F do not determine.
    fn left_open(&self, best: &Best) -> Result<Option<LeftOpen>, Error> {
        let [pixels1, pixels2] = [0, 1].map(|side| self.pixels(side).collect::<Vec<_>>());
        let options = TwoViewOptions::default().within(self.rules.epsilon_px);
        let found = find_degeneracy(&pixels1, &pixels2, &best.is_inlier, &options)?;
        Ok(found.map(|found| match found {
            Degeneracy::Unmoved { num_unmoved, .. } => LeftOpen::Unmoved(num_unmoved),
            Degeneracy::Homography { num_explained, .. } => LeftOpen::Homography(num_explained),
        }))
    }

    fn begin(&self) -> Result<Samples<FundamentalEstimator>, Error> {
        let [pixels1, pixels2] = [0, 1].map(|side| self.pixels(side).collect::<Vec<_>>());
        let estimator = FundamentalEstimator::new(MatchSet::new(&pixels1, &pixels2)?)?;
        Samples::new(estimator, self.rules)
    }

    /// The places in one of the photographs.
    fn pixels(&self, side: usize) -> impl Iterator<Item = Point2<f64>> {
        self.places.iter().map(move |places| places[side].into())
    }

    /// Which matches vote for a fundamental matrix.
    fn inliers(&self, fundamental: &Matrix3<f64>) -> impl Iterator<Item = bool> {
        let pairs = self.pixels(0).zip(self.pixels(1));
        pairs.map(move |(p, q)| sampson_px(fundamental, &p, &q) < self.rules.epsilon_px)
    }

    /// The voters of an F, and F fitted to all of them.
    fn refitted(&self, fundamental: &Matrix3<f64>) -> Best {
        let is_inlier: Vec<bool> = self.inliers(fundamental).collect();
        let [pixels1, pixels2] = [0, 1].map(|side| -> Vec<Point2<f64>> {
            let marked = self.pixels(side).zip(&is_inlier);
            marked.filter(|(_, is)| **is).map(|(p, _)| p).collect()
        });
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
}

impl Votes {
    /// Samples until there is nothing more to draw.
    pub(super) fn len(&self) -> usize {
        self.trials.len()
    }

    /// What had happened after so many samples.
    pub(super) fn after(&self, count: usize) -> Moment<'_> {
        let last = self.trials[..count.min(self.len())].last();
        let num_bests = last.map_or(0, |trial| trial.num_bests);
        Moment {
            last,
            best: self.bests[..num_bests].last(),
        }
    }

    /// Whether these can be the votes of so many matches.
    pub(super) fn fit(&self, num_matches: usize) -> bool {
        let trial_fits = |trial: &Trial| {
            trial.num_bests <= self.bests.len() && trial.sample.iter().all(|&k| k < num_matches)
        };
        let best_fits = |best: &Best| {
            best.is_inlier.len() == num_matches
                && best.mean_px.is_finite()
                && best.fundamental.iter().all(|x| x.is_finite())
        };
        self.trials.iter().all(trial_fits) && self.bests.iter().all(best_fits)
    }
}

/// An election at some time.
#[derive(Clone, Copy)]
pub(super) struct Moment<'a> {
    /// The last sample that was drawn.
    pub(super) last: Option<&'a Trial>,
    pub(super) best: Option<&'a Best>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::scenes::still_life_pair;
    use epipole::math::random::Random;
    use nalgebra::Point3;
    use std::ops::ControlFlow;

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

    fn vote(matches: &[&Match]) -> Votes {
        let voters = Voters::new(matches, 1.0, RULES);
        voters.vote(&mut |_| ControlFlow::Continue(())).unwrap()
    }

    #[test]
    fn the_right_matches_win() {
        let matches = matches();
        let votes = vote(&matches.iter().collect::<Vec<_>>());
        assert!(votes.refusal.is_none() && votes.fit(matches.len()));
        let moment = votes.after(votes.len());
        let (last, best) = (moment.last.unwrap(), moment.best.unwrap());
        assert!(last.drawn.is_confident() && last.drawn.is_finished());
        assert!(best.is_inlier[..NUM_RIGHT].iter().all(|is| *is));
        assert!(best.num_votes <= NUM_RIGHT + 3, "{}", best.num_votes);
        assert!(best.mean_px < 0.1, "{}", best.mean_px);
        assert!(last.num_votes <= best.num_votes);
        // Sample by sample, the best only grows.
        assert!(votes.after(0).best.is_none() && votes.after(0).last.is_none());
        let growth: Vec<usize> = (1..=votes.len())
            .map(|count| votes.after(count))
            .filter_map(|moment| moment.best.map(|best| best.num_votes))
            .collect();
        assert!(growth.len() > 1 && growth[0] < best.num_votes);
        assert_eq!(
            votes.after(votes.len() + 5).best.unwrap().num_votes,
            best.num_votes
        );
    }

    #[test]
    fn too_few_matches_are_a_sentence() {
        let matches = matches();
        let few: Vec<&Match> = matches[..6].iter().collect();
        let votes = vote(&few);
        assert!(votes.len() == 0 && votes.refusal.unwrap().starts_with("There is no F"));
    }
}
