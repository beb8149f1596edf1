//! The core's loop on a list of matches, and what a reader sees of it.

use super::answer::Match;
use epipole::Error;
use epipole::epipolar::{FundamentalEstimator, refine_fundamental, sampson_px};
use epipole::optim::RobustLoss;
use epipole::robust::{Budget, MatchSet, Ransac, RansacOptions, ScoreKind, Step};
use nalgebra::{Matrix3, Point2};

pub(super) const MAX_SAMPLES: usize = 1000;
const CONFIDENCE: f64 = 0.99;

/// What the loop is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Question {
    pub(super) epsilon_px: f64,
    pub(super) seed: u64,
    pub(super) local_optimization: bool,
}

/// A loop that was begun.
pub(super) struct Run {
    question: Question,
    engine: Ransac<FundamentalEstimator>,
    pixels1: Vec<Point2<f64>>,
    pixels2: Vec<Point2<f64>>,
    candidate: Option<Candidate>,
    best: Option<Best>,
}

/// The last sample.
pub(super) struct Candidate {
    /// Indices into the matches.
    pub(super) sample: Vec<usize>,
    /// Matches that vote for the best F of the sample; none if it gave no F.
    pub(super) num_inliers: usize,
}

/// The largest consensus so far.
pub(super) struct Best {
    pub(super) is_inlier: Vec<bool>,
    pub(super) num_inliers: usize,
    /// Fitted once more, to all of the consensus.
    pub(super) fundamental: Matrix3<f64>,
    /// Mean Sampson distance of the consensus from it, pixels.
    pub(super) mean_px: f64,
}

impl Run {
    /// A loop that has drawn nothing yet.
    ///
    /// # Errors
    /// As [`FundamentalEstimator::new`]: too few matches, or all on a line.
    pub(super) fn new(matches: &[&Match], question: Question) -> Result<Self, Error> {
        let pixels1: Vec<_> = matches.iter().map(|found| found.pixel1).collect();
        let pixels2: Vec<_> = matches.iter().map(|found| found.pixel2).collect();
        let options = RansacOptions {
            max_error_px: question.epsilon_px,
            confidence: CONFIDENCE,
            min_iterations: 1,
            max_iterations: MAX_SAMPLES,
            seed: question.seed,
            score: ScoreKind::InlierCount,
            budget: Budget::WithReplacement,
            local_optimization: question.local_optimization,
            ..RansacOptions::default()
        };
        let estimator = FundamentalEstimator::new(MatchSet::new(&pixels1, &pixels2)?)?;
        Ok(Self {
            question,
            engine: Ransac::new(estimator, options)?,
            pixels1,
            pixels2,
            candidate: None,
            best: None,
        })
    }

    /// Draws until there are so many samples in all, or enough.
    pub(super) fn draw_to(&mut self, iterations: usize) {
        let mut improved = None;
        let mut last = None;
        while self.engine.iterations() < iterations {
            let Step::Trial(trial) = self.engine.step() else {
                break;
            };
            if trial.is_best {
                improved = trial.refined.or(trial.model);
            }
            last = Some((trial.sample.to_vec(), trial.model));
        }
        if let Some((sample, model)) = last {
            let num_inliers = model.map_or(0, |model| {
                self.votes(&model).iter().filter(|votes| **votes).count()
            });
            self.candidate = Some(Candidate {
                sample,
                num_inliers,
            });
        }
        if let Some(model) = improved {
            self.best = Some(self.refitted(model));
        }
    }

    /// Which matches vote for a fundamental matrix.
    fn votes(&self, model: &Matrix3<f64>) -> Vec<bool> {
        let pairs = self.pixels1.iter().zip(&self.pixels2);
        pairs
            .map(|(p, q)| sampson_px(model, p, q) < self.question.epsilon_px)
            .collect()
    }

    /// The consensus of a model, and F fitted to all of it.
    fn refitted(&self, model: Matrix3<f64>) -> Best {
        let is_inlier = self.votes(&model);
        let chosen = |pixels: &[Point2<f64>]| -> Vec<Point2<f64>> {
            let marked = pixels.iter().zip(&is_inlier);
            marked.filter(|(_, is)| **is).map(|(p, _)| *p).collect()
        };
        let (pixels1, pixels2) = (chosen(&self.pixels1), chosen(&self.pixels2));
        // A consensus that does not determine F keeps the one of its sample.
        let fundamental =
            refine_fundamental(&model, &pixels1, &pixels2, RobustLoss::Trivial).unwrap_or(model);
        let sum: f64 = pixels1
            .iter()
            .zip(&pixels2)
            .map(|(p, q)| sampson_px(&fundamental, p, q))
            .sum();
        Best {
            num_inliers: pixels1.len(),
            mean_px: sum / pixels1.len().max(1) as f64,
            is_inlier,
            fundamental,
        }
    }

    pub(super) fn question(&self) -> Question {
        self.question
    }

    pub(super) fn candidate(&self) -> Option<&Candidate> {
        self.candidate.as_ref()
    }

    pub(super) fn best(&self) -> Option<&Best> {
        self.best.as_ref()
    }

    /// Samples drawn so far.
    pub(super) fn iterations(&self) -> usize {
        self.engine.iterations()
    }

    /// Samples needed for the confidence, going by the best so far; `None` while out of reach.
    pub(super) fn budget(&self) -> Option<u64> {
        let required = self.engine.required_iterations();
        (required <= 1_000_000).then_some(required)
    }

    /// Whether the samples drawn suffice for the confidence.
    pub(super) fn is_confident(&self) -> bool {
        self.budget()
            .is_some_and(|budget| budget <= self.iterations() as u64)
    }

    /// Whether there is nothing more to draw.
    pub(super) fn is_finished(&self) -> bool {
        self.is_confident() || self.iterations() >= MAX_SAMPLES
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::still_life_pair;
    use epipole::math::random::Random;
    use nalgebra::Point3;

    const NUM_RIGHT: usize = 60;
    const QUESTION: Question = Question {
        epsilon_px: 1.0,
        seed: 3,
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
            pixel1: first.project(&p).unwrap(),
            pixel2: second.project(&q).unwrap(),
            ratio: 0.5,
            is_right: Some(p == q),
        });
        seen.collect()
    }

    #[test]
    fn the_right_matches_win() {
        let matches = matches();
        let mut run = Run::new(&matches.iter().collect::<Vec<_>>(), QUESTION).unwrap();
        run.draw_to(MAX_SAMPLES);
        assert!(run.is_confident() && run.is_finished());
        let best = run.best().unwrap();
        assert!(best.is_inlier[..NUM_RIGHT].iter().all(|is| *is));
        assert!(best.num_inliers <= NUM_RIGHT + 3, "{}", best.num_inliers);
        assert!(best.mean_px < 0.1, "{}", best.mean_px);
    }

    #[test]
    fn sample_by_sample_is_the_same_as_all_at_once() {
        let matches = matches();
        let matches: Vec<&Match> = matches.iter().collect();
        let mut at_once = Run::new(&matches, QUESTION).unwrap();
        at_once.draw_to(25);
        let mut by_steps = Run::new(&matches, QUESTION).unwrap();
        for iterations in 1..=25 {
            by_steps.draw_to(iterations);
        }
        let [one, other] = [&at_once, &by_steps];
        assert_eq!(one.iterations(), other.iterations());
        assert_eq!(
            one.candidate().unwrap().sample,
            other.candidate().unwrap().sample
        );
        assert_eq!(
            one.best().unwrap().fundamental,
            other.best().unwrap().fundamental
        );
        assert_eq!(one.budget(), other.budget());
    }

    #[test]
    fn too_few_matches_are_a_sentence() {
        let matches = matches();
        let few: Vec<&Match> = matches[..6].iter().collect();
        assert!(Run::new(&few, QUESTION).is_err());
    }
}
