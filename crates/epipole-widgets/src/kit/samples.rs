//! The core's RANSAC loop, step by step, until enough samples are drawn.

use crate::contract::Readout;
use epipole::Error;
use epipole::robust::{Budget, Estimator, Ransac, RansacOptions, ScoreKind, Step, ransac};
use serde::{Deserialize, Serialize};

/// Confidence of having drawn an all-inlier sample at which the loop ends.
const CONFIDENCE: f64 = 0.99;
/// Maximum number of needed samples that is reported.
const LARGEST_BUDGET: u64 = 1_000_000;

/// Options of the loop.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Rules {
    /// Inlier threshold, pixels.
    pub(crate) epsilon_px: f64,
    pub(crate) seed: u64,
    /// Maximum number of samples.
    pub(crate) max_samples: usize,
    /// Whether inliers score by distance (MSAC) instead of 1 each.
    pub(crate) msac: bool,
    /// Whether each new best model is immediately refitted to its inliers.
    pub(crate) local_optimization: bool,
}

impl Rules {
    /// Converts to the core's options.
    fn options(&self) -> RansacOptions {
        RansacOptions::default()
            .with_max_error_px(self.epsilon_px)
            .with_confidence(CONFIDENCE)
            .with_min_iterations(1)
            .with_max_iterations(self.max_samples)
            .with_seed(self.seed)
            .with_score(match self.msac {
                true => ScoreKind::Msac,
                false => ScoreKind::InlierCount,
            })
            .with_budget(Budget::WithReplacement)
            .with_local_optimization(self.local_optimization)
    }

    /// Runs the whole loop; returns the model and the number of samples. Without local
    /// optimization, the model is finally refitted to all inliers.
    ///
    /// # Errors
    /// As [`ransac`].
    pub(crate) fn run<E: Estimator>(
        &self,
        estimator: E,
        refit: impl FnOnce(&[bool]) -> Result<E::Model, Error>,
    ) -> Result<(E::Model, usize), Error> {
        let report = ransac(estimator, &self.options(), &mut ())?;
        let model = match self.local_optimization {
            true => report.model,
            false => refit(&report.inliers).unwrap_or(report.model),
        };
        Ok((model, report.iterations))
    }
}

/// Returns the inliers among the data.
pub(crate) fn inliers_of<T: Copy>(data: &[T], is_inlier: &[bool]) -> Vec<T> {
    let inliers = data.iter().zip(is_inlier).filter(|(_, is)| **is);
    inliers.map(|(datum, _)| *datum).collect()
}

/// Last sample drawn.
#[derive(Debug, Clone)]
pub(crate) struct Last<M> {
    /// Indices into the data.
    pub(crate) sample: Vec<usize>,
    /// Model of the sample; of several, the one with the most votes.
    pub(crate) model: Option<M>,
}

/// A loop in progress.
pub(crate) struct Samples<E: Estimator> {
    engine: Ransac<E>,
    rules: Rules,
    last: Option<Last<E::Model>>,
}

impl<E: Estimator> Samples<E> {
    /// Creates a loop before its first sample.
    ///
    /// # Errors
    /// As [`Ransac::new`]: too few data, or options out of range.
    pub(crate) fn new(estimator: E, rules: Rules) -> Result<Self, Error> {
        Ok(Self {
            engine: Ransac::new(estimator, rules.options())?,
            rules,
            last: None,
        })
    }

    /// Draws until there are `count` samples or enough. Returns whether the best model has
    /// improved.
    pub(crate) fn draw_to(&mut self, count: usize) -> bool {
        let mut has_improved = false;
        while self.engine.iterations() < count {
            let Step::Trial(trial) = self.engine.step() else {
                break;
            };
            has_improved |= trial.is_best;
            self.last = Some(Last {
                sample: trial.sample.to_vec(),
                model: trial.model,
            });
        }
        has_improved
    }

    pub(crate) fn last(&self) -> Option<&Last<E::Model>> {
        self.last.as_ref()
    }

    /// Returns the model with the most votes so far.
    pub(crate) fn best(&self) -> Option<&E::Model> {
        self.engine.best().map(|(model, _)| model)
    }

    /// Returns the number of samples drawn so far.
    pub(crate) fn count(&self) -> usize {
        self.engine.iterations()
    }

    /// Returns the progress of the loop.
    pub(crate) fn drawn(&self) -> Drawn {
        let required = self.engine.required_iterations();
        Drawn {
            count: self.count(),
            budget: (required <= LARGEST_BUDGET).then_some(required),
            max_samples: self.rules.max_samples,
        }
    }

    /// Returns whether the loop has ended.
    pub(crate) fn is_finished(&self) -> bool {
        self.drawn().is_finished()
    }
}

/// Progress of a loop.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Drawn {
    /// Number of samples drawn so far.
    pub(crate) count: usize,
    /// Number of samples needed for the best model so far; `None` if above the reported maximum.
    pub(crate) budget: Option<u64>,
    /// Maximum number of samples.
    pub(crate) max_samples: usize,
}

impl Drawn {
    /// Returns the progress before the first sample.
    pub(crate) fn nothing(max_samples: usize) -> Self {
        Self {
            count: 0,
            budget: None,
            max_samples,
        }
    }

    /// Returns whether enough samples have been drawn.
    pub(crate) fn is_confident(&self) -> bool {
        (self.budget).is_some_and(|budget| budget <= self.count as u64)
    }

    /// Returns whether the loop has ended.
    pub(crate) fn is_finished(&self) -> bool {
        self.is_confident() || self.count >= self.max_samples
    }

    /// Returns the readouts of samples drawn and needed; without a loop, `none`.
    pub(crate) fn readouts(drawn: Option<Self>, none: &str) -> [Readout; 2] {
        let otherwise = if drawn.is_some() { "> 10⁶" } else { none };
        let count = drawn.map(|drawn| drawn.count as f64);
        let budget = drawn.and_then(|drawn| drawn.budget);
        let budget = budget.map(|budget| budget as f64);
        [
            Readout::number("iterations", "Samples drawn", count, 0, "").or(none),
            Readout::number("budget", "Samples needed", budget, 0, "").or(otherwise),
        ]
    }

    /// Describes the number of samples needed.
    pub(crate) fn outlook(&self) -> String {
        match self.budget {
            _ if self.is_confident() => "That is enough for 99% confidence.".to_owned(),
            _ if self.is_finished() => {
                "99% confidence takes more, but the figure stops here.".to_owned()
            }
            Some(1) => "99% confidence takes 1 sample.".to_owned(),
            Some(budget) => format!("99% confidence takes {budget} samples."),
            None => "99% confidence takes more than a million.".to_owned(),
        }
    }

    /// Formats the count, such as "1 sample" or "12 samples".
    pub(crate) fn count_words(&self) -> String {
        match self.count {
            1 => "1 sample".to_owned(),
            count => format!("{count} samples"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::robust::LineEstimator;
    use nalgebra::Point2;

    const RULES: Rules = Rules {
        epsilon_px: 1.0,
        seed: 3,
        max_samples: 40,
        msac: false,
        local_optimization: false,
    };

    /// Creates eight points on a line, and eight off it.
    fn points() -> LineEstimator {
        let on = (0..8).map(|k| Point2::new(f64::from(k) * 10.0, 50.0));
        let off = (0..8).map(|k| Point2::new(f64::from(k * k) * 3.0, f64::from(k * 37 % 100)));
        LineEstimator::new(&on.chain(off).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn one_by_one_is_the_same_as_all_at_once() {
        let mut at_once = Samples::new(points(), RULES).unwrap();
        at_once.draw_to(12);
        let mut by_steps = Samples::new(points(), RULES).unwrap();
        let improved = (1..=12).filter(|&count| by_steps.draw_to(count)).count();
        assert!(improved >= 1);
        assert_eq!(at_once.best(), by_steps.best());
        assert_eq!(at_once.drawn(), by_steps.drawn());
        assert_eq!(
            at_once.last().unwrap().sample,
            by_steps.last().unwrap().sample
        );
    }

    #[test]
    fn it_ends_when_enough_are_drawn_and_says_so() {
        let mut samples = Samples::new(points(), RULES).unwrap();
        assert_eq!(
            (samples.drawn().budget, samples.is_finished()),
            (None, false)
        );
        samples.draw_to(1000);
        assert!(samples.drawn().is_confident() && samples.count() <= 40);
        assert!(samples.best().unwrap().b.abs() > 0.999);
        assert!(samples.drawn().outlook().starts_with("That is enough"));
        let few = Rules {
            max_samples: 1,
            ..RULES
        };
        let mut samples = Samples::new(points(), few).unwrap();
        samples.draw_to(1000);
        assert!(samples.is_finished() && !samples.drawn().is_confident());
        assert_eq!(samples.drawn().count_words(), "1 sample");
        assert!(samples.drawn().outlook().ends_with("stops here."));
    }
}
