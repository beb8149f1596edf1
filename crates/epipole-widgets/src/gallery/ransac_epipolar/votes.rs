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

/// Matches and options of the loop.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Voters {
    /// Column and row in photograph 1, then in photograph 2, of each match.
    pub(super) places: Vec<[[f64; 2]; 2]>,
    /// Maximum descriptor ratio of the matches.
    pub(super) most_ratio: f32,
    pub(super) rules: Rules,
    /// Whether the truth is unknown, in which case degeneracies are checked.
    pub(super) is_own: bool,
}

/// A complete run of the loop.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Votes {
    trials: Vec<Trial>,
    /// Best models in order, each with more votes than the previous one.
    bests: Vec<Best>,
    /// Message why there is no F.
    pub(super) refusal: Option<String>,
    /// Degeneracy of the last best model.
    pub(super) left_open: Option<LeftOpen>,
}

/// Degeneracy of an F, with the number of inliers that cause it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum LeftOpen {
    /// The matches have the same position in both photographs.
    Unmoved(usize),
    /// One homography explains them.
    Homography(usize),
}

/// A sample and its outcome.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Trial {
    /// Indices of its seven matches.
    pub(super) sample: Vec<usize>,
    /// Number of inliers of its F; 0 if it gave no F.
    pub(super) num_votes: usize,
    /// Progress of the loop after this sample.
    pub(super) drawn: Drawn,
    /// Number of best models found so far.
    num_bests: usize,
}

/// The F with the most votes so far.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Best {
    /// Inlier mask over the matches.
    pub(super) is_inlier: Vec<bool>,
    pub(super) num_votes: usize,
    /// F refitted to all its inliers.
    pub(super) fundamental: Matrix3<f64>,
    /// Mean Sampson distance of its inliers, pixels.
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

    /// Runs the loop. Too few or collinear matches give a refusal.
    ///
    /// # Errors
    /// [`Error::Canceled`] if `progress` cancels.
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
            // The loop has ended if it draws no more samples.
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

    /// Returns the degeneracy of an F, if any.
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

    /// Returns the positions in one of the photographs, pixels.
    fn pixels(&self, side: usize) -> impl Iterator<Item = Point2<f64>> {
        self.places.iter().map(move |places| places[side].into())
    }

    /// Returns the inlier mask of a fundamental matrix.
    fn inliers(&self, fundamental: &Matrix3<f64>) -> impl Iterator<Item = bool> {
        let pairs = self.pixels(0).zip(self.pixels(1));
        pairs.map(move |(p, q)| sampson_px(fundamental, &p, &q) < self.rules.epsilon_px)
    }

    /// Returns the inliers of an F, and F refitted to them.
    fn refitted(&self, fundamental: &Matrix3<f64>) -> Best {
        let is_inlier: Vec<bool> = self.inliers(fundamental).collect();
        let [pixels1, pixels2] = [0, 1].map(|side| -> Vec<Point2<f64>> {
            let marked = self.pixels(side).zip(&is_inlier);
            marked.filter(|(_, is)| **is).map(|(p, _)| p).collect()
        });
        // Keeps the sample's F if its inliers do not determine one.
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
    /// Returns the number of samples until the loop ends.
    pub(super) fn len(&self) -> usize {
        self.trials.len()
    }

    /// Returns the state after `count` samples.
    pub(super) fn after(&self, count: usize) -> Moment<'_> {
        let last = self.trials[..count.min(self.len())].last();
        let num_bests = last.map_or(0, |trial| trial.num_bests);
        Moment {
            last,
            best: self.bests[..num_bests].last(),
        }
    }

    /// Returns whether they are consistent with `num_matches` matches.
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

/// State of the loop after some samples.
#[derive(Clone, Copy)]
pub(super) struct Moment<'a> {
    /// The last sample.
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

    /// Projects random points into two cameras; the last 40 matches are wrong.
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
        // The best model never loses votes.
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
