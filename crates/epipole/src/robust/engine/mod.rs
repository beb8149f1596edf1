//! The RANSAC loop: draw, fit, score and improve until enough samples are drawn.
//!
//! Its stages are files: `local_optimization` improves a sample's model, `concentration` rejects
//! models of one image region, `stopping` computes the required number of samples; at the end
//! `neighborhood` searches for a better optimum nearby, `degeneracy` requests an alternative,
//! `polish` refits all inliers, `report` builds the report. Each keeps its constants in a `Tuning`.

mod concentration;
mod degeneracy;
mod local_optimization;
mod neighborhood;
mod polish;
mod report;
mod stopping;

use super::sampler::Sampler;
use super::step::{Step, Trial};
use super::{Estimator, Problem, RansacOptions, RansacReport, ScoreKind, StopReason, Support};
use crate::Result;
use crate::math::random::Random;

/// Block size. A sample's model is improved if it beats those of the current block and the previous
/// one: the best sample may lead to a worse optimum than a later one.
const BLOCK: usize = 100;

/// RANSAC, one sample at a time.
///
/// [`ransac`](super::ransac) runs it to the end. Call [`step`](Ransac::step) directly to visualize
/// each sample.
///
/// Each step draws a sample, fits up to a few models and scores them against all data. A model that
/// beats those of the last hundred samples or more is improved from its inliers (local
/// optimization). For matches, a model is rejected if its inliers are concentrated in one image
/// region, which explains them as well as the model: wrong matches often cluster. The loop ends
/// once enough samples are drawn for the inlier ratio of the best model. Nothing is allocated
/// between [`new`](Ransac::new) and [`finish`](Ransac::finish).
///
/// Source: Fischler & Bolles 1981; Chum, Matas & Kittler 2003, "Locally optimized RANSAC".
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::{LineEstimator, Ransac, RansacOptions, Step};
/// use nalgebra::Point2;
/// let points: Vec<_> = (0..10).map(|i| Point2::new(f64::from(i), 2.0)).collect();
/// let mut run = Ransac::new(LineEstimator::new(&points)?, RansacOptions::default())?;
/// while let Step::Trial(trial) = run.step() {
///     assert_eq!(trial.sample.len(), 2);
///     assert_eq!(trial.num_inliers, 10);
/// }
/// assert_eq!(run.required_iterations(), 1); // but at least 200 are drawn
/// assert_eq!(run.finish()?.iterations, 200);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone)]
pub struct Ransac<E: Estimator> {
    estimator: E,
    options: RansacOptions,
    random: Random,
    sampler: Sampler,
    sample: Vec<usize>,
    sample_in_input_order: Vec<usize>,
    models: Vec<E::Model>,
    inliers: Vec<usize>,
    /// Buffer for one number per data point.
    values: Vec<f64>,
    best: Option<Candidate<E::Model>>,
    /// Lowest cost of a model straight from a sample, in the current block and the previous one.
    block_costs: [f64; 2],
    iterations: usize,
    refinements: usize,
    required: u64,
    log_miss: f64,
    stop: Option<StopReason>,
    /// Probability that an unrelated data point fits a model, if known.
    random_inlier_probability: Option<f64>,
    /// Threshold for comparing and improving models: the caller's during sampling, the inliers' own
    /// at the end.
    judge_px: f64,
}

#[derive(Debug, Clone)]
struct Candidate<M> {
    model: M,
    support: Support,
}

impl<E: Estimator> Ransac<E> {
    /// Prepares a run and allocates all memory.
    ///
    /// # Errors
    /// [`Error::TooFew`](crate::Error::TooFew) or
    /// [`Error::TooFewDistinct`](crate::Error::TooFewDistinct) for fewer data points than a sample
    /// has, [`Error::OutOfRange`](crate::Error::OutOfRange) for options outside their range.
    pub fn new(estimator: E, options: RansacOptions) -> Result<Self> {
        options.check()?;
        let problem = estimator.problem();
        let (num_data, size) = (problem.data.len(), problem.sample_size);
        problem.data.at_least(size.max(1), problem.name)?;
        let random_inlier_probability =
            (problem.data).random_inlier_probability(problem.codimension, options.max_error_px);
        Ok(Self {
            sampler: Sampler::new(options.sampler, num_data, size, options.max_iterations),
            random: Random::new(options.seed),
            sample: Vec::with_capacity(size),
            sample_in_input_order: Vec::with_capacity(size),
            models: Vec::with_capacity(problem.max_models),
            inliers: Vec::with_capacity(num_data),
            values: Vec::with_capacity(num_data),
            best: None,
            block_costs: [f64::INFINITY; 2],
            iterations: 0,
            refinements: 0,
            required: u64::MAX,
            log_miss: libm::log1p(-options.confidence),
            stop: None,
            random_inlier_probability,
            judge_px: options.max_error_px,
            estimator,
            options,
        })
    }

    /// Starts from an initial model, improved from its inliers; samples can still find a better
    /// one.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::math::Line2;
    /// use epipole::robust::{LineEstimator, Ransac, RansacOptions, Step};
    /// use nalgebra::Point2;
    /// let points: Vec<_> = (0..10).map(|i| Point2::new(f64::from(i), 2.0)).collect();
    /// let mut run = Ransac::new(LineEstimator::new(&points)?, RansacOptions::default())?;
    /// // From the previous frame, say: half a pixel off.
    /// run.start_from(Line2 { a: 0.0, b: 1.0, c: -1.5 });
    /// assert_eq!(run.required_iterations(), 1);
    /// assert!((run.finish()?.model.c.abs() - 2.0).abs() < 1e-12);
    /// # Ok(()) }
    /// ```
    pub fn start_from(&mut self, model: E::Model) {
        let support = self.support(&model, f64::INFINITY);
        let mut candidate = Candidate { model, support };
        if self.options.local_optimization {
            self.improve(&mut candidate);
        }
        self.require(&candidate);
        self.best = Some(candidate);
    }

    /// Draws one sample, unless the run has finished.
    pub fn step(&mut self) -> Step<'_, E::Model> {
        if let Some(stop) = self.stop {
            return Step::Finished(stop);
        }
        self.iterations += 1;
        self.sampler.draw(&mut self.random, &mut self.sample);
        self.models.clear();
        self.estimator.fit_sample(&self.sample, &mut self.models);

        if self.iterations.is_multiple_of(BLOCK) {
            self.block_costs = [f64::INFINITY, self.block_costs[0]];
        }
        let least_cost = self.block_costs[0].min(self.block_costs[1]);
        let mut trial_best: Option<(usize, Support)> = None;
        for (place, model) in self.models.iter().enumerate() {
            let limit = if self.options.score_every_trial {
                f64::INFINITY
            } else {
                trial_best.map_or(least_cost, |(_, support)| support.cost.min(least_cost))
            };
            let support = self.support(model, limit);
            if trial_best.is_none_or(|(_, best)| support.cost < best.cost) {
                trial_best = Some((place, support));
            }
        }
        let (mut model, mut score, mut num_inliers) = (None, 0.0, 0);
        let (mut is_best, mut refined) = (false, None);
        if let Some((place, support)) = trial_best {
            let candidate = Candidate {
                model: self.models[place].clone(),
                support,
            };
            model = Some(candidate.model.clone());
            score = self.score(&support);
            num_inliers = support.num_inliers;
            if support.cost < least_cost && !self.is_concentrated(&candidate.model) {
                self.block_costs[0] = support.cost;
                (is_best, refined) = self.consider(candidate);
            }
        }
        self.update_stop();
        self.sample_in_input_order.clear();
        match self.estimator.problem().data.unique() {
            Some(unique) => self
                .sample_in_input_order
                .extend(self.sample.iter().map(|&i| unique.first_occurrences()[i])),
            None => self.sample_in_input_order.extend_from_slice(&self.sample),
        }
        Step::Trial(Trial {
            iteration: self.iterations,
            sample: &self.sample_in_input_order,
            num_models: self.models.len(),
            model,
            score,
            num_inliers,
            required_iterations: self.required,
            is_best,
            refined,
        })
    }

    /// Returns the best model so far and its score.
    pub fn best(&self) -> Option<(&E::Model, f64)> {
        self.best
            .as_ref()
            .map(|best| (&best.model, self.score(&best.support)))
    }

    /// Returns the number of samples drawn so far.
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// Returns the number of samples required by the best model's inlier ratio; `u64::MAX` without
    /// a model.
    ///
    /// The run ends there, but not before [`RansacOptions::min_iterations`] and not after
    /// [`RansacOptions::max_iterations`].
    pub fn required_iterations(&self) -> u64 {
        self.required
    }

    /// Returns the number of samples after which the run ends if no better model is found.
    pub fn expected_iterations(&self) -> usize {
        let (least, most) = (self.options.min_iterations, self.options.max_iterations);
        let required = usize::try_from(self.required).unwrap_or(most);
        required.max(least).min(most)
    }

    /// Returns the problem to solve.
    pub fn estimator(&self) -> &E {
        &self.estimator
    }

    /// Improves the best model a last time and returns the report.
    ///
    /// Before the run has ended, this is the report of the best model so far, with
    /// [`StopReason::Interrupted`].
    ///
    /// # Errors
    /// [`Error::NoConsensus`](crate::Error::NoConsensus) if no model is supported by at least as
    /// many data points as a sample has.
    pub fn finish(mut self) -> Result<RansacReport<E::Model>> {
        self.conclude()
    }

    fn problem(&self) -> Problem<'_> {
        self.estimator.problem()
    }

    /// Returns the score of a support, as defined by [`ScoreKind`].
    fn score(&self, support: &Support) -> f64 {
        match self.options.score {
            ScoreKind::InlierCount => support.num_inliers as f64,
            ScoreKind::Msac => (self.problem().data.num_votes() - support.cost).max(0.0),
        }
    }

    fn support(&self, model: &E::Model, cost_limit: f64) -> Support {
        let by_count = self.options.score == ScoreKind::InlierCount;
        // The limit applies to squared errors, not to inlier counts.
        let limit = if by_count { f64::INFINITY } else { cost_limit };
        let max_error_px = self.judge_px;
        let mut support = self.estimator.support(model, max_error_px, limit);
        if by_count {
            support.cost = (self.problem().data.len() - support.num_inliers) as f64;
        }
        if support.cost.is_nan() {
            support.cost = f64::INFINITY;
        }
        support
    }
}
