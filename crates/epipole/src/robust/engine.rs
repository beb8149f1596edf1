//! The one loop: draw, fit, judge, improve, until enough samples were drawn.

use super::budget::{all_inlier_probability, ratio_to_the, trials};
use super::chance::{UNKNOWN_CHANCE, log10_false_alarms};
use super::options::HARDLY_CHANCE;
use super::sampler::Sampler;
use super::step::{Step, Trial};
use super::{
    Budget, Estimator, RansacOptions, RansacReport, ScoreKind, StopReason, Support, Unique,
};
use crate::math::random::Random;
use crate::{Error, Result};

/// Starts around the best model that are tried at the end, at most.
const EXPLORATIONS: usize = 30;

/// A start fits some of the data within so many thresholds of the best model: those just outside of
/// one threshold are what another model would claim.
const START_REACH: f64 = 1.5;

/// So many starts that lead back to the best model show that there is hardly another one nearby.
const RETURNS: usize = 3;

/// A start whose first fit costs more than the best model by this share of its cost is left off.
const FAR_OFF: f64 = 0.02;

/// A start whose first fit costs the same up to this share, or this much of one datum, leads back
/// to the best model.
const SAME: f64 = 1e-3;

/// At the end, models are compared within so many medians of the errors that inliers have: two
/// standard deviations, if errors of one dimension are Gaussian.
const SHARP_MEDIANS: f64 = 3.0;

/// The width of the last loss, in the same medians.
const WIDTH_MEDIANS: f64 = 2.5;

/// How often data are weighed anew at the end.
const REWEIGHTINGS: usize = 6;

/// RANSAC, one sample at a time.
///
/// [`ransac`](super::ransac) runs it to the end. Call [`step`](Ransac::step) yourself to show what happens.
///
/// Each step draws a sample, fits up to a few models to it and scores them against all data. A
/// model that beats those of all samples before is improved from its inliers (local
/// optimization). The loop ends once enough samples were drawn for the share of inliers that the
/// best model has. Nothing is allocated between [`new`](Ransac::new) and
/// [`finish`](Ransac::finish).
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
    sample_as_given: Vec<usize>,
    models: Vec<E::Model>,
    inliers: Vec<usize>,
    best: Option<Candidate<E::Model>>,
    /// The lowest cost of a model straight from a sample; only a lower one is worth improving.
    best_sample_cost: f64,
    iterations: usize,
    refinements: usize,
    required: u64,
    log_miss: f64,
    stop: Option<StopReason>,
    /// The probability that a datum fits a model it has nothing to do with, if that is known.
    chance: Option<f64>,
    /// The threshold within which models are compared and improved: the caller's while samples are
    /// drawn, the inliers' own at the end.
    judge_px: f64,
}

#[derive(Debug, Clone)]
struct Candidate<M> {
    model: M,
    support: Support,
}

impl<E: Estimator> Ransac<E> {
    /// Prepares a run; all memory is taken here.
    ///
    /// # Errors
    /// [`Error::TooFew`] if there are fewer different data than one sample has,
    /// [`Error::OutOfRange`] for options outside their range.
    pub fn new(estimator: E, options: RansacOptions) -> Result<Self> {
        options.check()?;
        let (num_data, size) = (estimator.num_data(), estimator.sample_size());
        if num_data < size || size == 0 {
            return Err(Error::TooFew {
                what: estimator.name(),
                needed: size.max(1),
                got: num_data,
            });
        }
        Ok(Self {
            sampler: Sampler::new(options.sampler, num_data, size, options.max_iterations),
            random: Random::new(options.seed),
            sample: Vec::with_capacity(size),
            sample_as_given: Vec::with_capacity(size),
            models: Vec::with_capacity(estimator.max_models()),
            inliers: Vec::with_capacity(num_data),
            best: None,
            best_sample_cost: f64::INFINITY,
            iterations: 0,
            refinements: 0,
            required: u64::MAX,
            log_miss: libm::log1p(-options.confidence),
            stop: None,
            chance: estimator.chance(options.max_error_px),
            judge_px: options.max_error_px,
            estimator,
            options,
        })
    }

    /// Begins with a model that is known already; samples may still find a better one.
    pub(super) fn propose(&mut self, model: E::Model) {
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

        let mut trial_best: Option<(usize, Support)> = None;
        for (place, model) in self.models.iter().enumerate() {
            let limit = if self.options.score_every_trial {
                f64::INFINITY
            } else {
                trial_best.map_or(self.best_sample_cost, |(_, support)| {
                    support.cost.min(self.best_sample_cost)
                })
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
            if support.cost < self.best_sample_cost {
                self.best_sample_cost = support.cost;
                (is_best, refined) = self.consider(candidate);
            }
        }
        self.update_stop();
        self.sample_as_given.clear();
        match self.estimator.unique() {
            Some(unique) => self
                .sample_as_given
                .extend(self.sample.iter().map(|&i| unique.first_occurrences()[i])),
            None => self.sample_as_given.extend_from_slice(&self.sample),
        }
        Step::Trial(Trial {
            iteration: self.iterations,
            sample: &self.sample_as_given,
            num_models: self.models.len(),
            model,
            score,
            num_inliers,
            required_iterations: self.required,
            is_best,
            refined,
        })
    }

    /// The best model so far and its score.
    pub fn best(&self) -> Option<(&E::Model, f64)> {
        self.best
            .as_ref()
            .map(|best| (&best.model, self.score(&best.support)))
    }

    /// Samples drawn so far.
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// Samples that the best model's share of inliers asks for; `u64::MAX` before there is one.
    ///
    /// The run ends there, but not before [`RansacOptions::min_iterations`] and not after
    /// [`RansacOptions::max_iterations`].
    pub fn required_iterations(&self) -> u64 {
        self.required
    }

    /// The problem that is being solved.
    pub fn estimator(&self) -> &E {
        &self.estimator
    }

    /// Ends the run: [`step`](Ransac::step) will draw no more.
    pub fn cancel(&mut self) {
        self.stop.get_or_insert(StopReason::Canceled);
    }

    /// Improves the best model one last time and reports, also before the run has ended.
    ///
    /// # Errors
    /// [`Error::NoConsensus`] if no sample gave a model that the data of one sample, at least,
    /// support; [`Error::Canceled`] if the run was ended before one did.
    pub fn finish(mut self) -> Result<RansacReport<E::Model>> {
        self.conclude()
    }

    /// The problem, to be run again.
    pub(super) fn into_estimator(self) -> E {
        self.estimator
    }

    /// As [`finish`](Ransac::finish), once.
    pub(super) fn conclude(&mut self) -> Result<RansacReport<E::Model>> {
        let no_consensus = match self.stop {
            Some(StopReason::Canceled) => Error::Canceled,
            _ => Error::NoConsensus {
                needed: self.estimator.sample_size(),
                got: self.estimator.num_data(),
                iterations: self.iterations,
            },
        };
        let Some(mut best) = self.best.take() else {
            return Err(no_consensus);
        };
        if self.options.local_optimization {
            self.explore_sharply(&mut best);
            self.settle(&mut best);
            self.polish(&mut best);
        }
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&best.model, max_error_px, &mut self.inliers);
        let num_distinct = self.estimator.num_distinct(&self.inliers);
        if num_distinct < self.estimator.sample_size() {
            return Err(no_consensus);
        }
        let num_data = self.estimator.num_data();
        if !self.sampler.is_ordered() {
            self.required = self.required_for(self.inliers.len(), num_data);
        }
        let log10_false_alarms = self.chance.map(|chance| {
            log10_false_alarms(
                num_distinct,
                num_data,
                self.estimator.sample_size(),
                self.estimator.max_models(),
                chance,
            )
        });
        let mut fits = vec![false; self.estimator.num_data()];
        for &index in &self.inliers {
            fits[index] = true;
        }
        let inliers: Vec<bool> = match self.estimator.unique() {
            Some(unique) => (unique.places().iter())
                .map(|place| place.is_some_and(|i| fits[i]))
                .collect(),
            None => fits,
        };
        Ok(RansacReport {
            num_inliers: inliers.iter().filter(|&&inlier| inlier).count(),
            num_unique_inliers: num_distinct,
            num_left_out: (self.estimator.unique()).map_or(0, Unique::num_left_out),
            inliers,
            iterations: self.iterations,
            required_iterations: self.required,
            max_error_px,
            score: self.score(&best.support),
            log10_false_alarms,
            refinements: self.refinements,
            stop: self.stop.unwrap_or(StopReason::Canceled),
            model: best.model,
        })
    }

    /// Takes the best model of a sample through recovery and local optimization, and keeps the
    /// outcome if nothing better is known. Returns whether it is kept, and as what.
    fn consider(&mut self, mut candidate: Candidate<E::Model>) -> (bool, Option<E::Model>) {
        let mut changed = false;
        if self.options.local_optimization {
            let recovered = self.estimator.recover(
                &candidate.model,
                &self.sample,
                self.options.max_error_px,
                &mut self.random,
            );
            if let Some(model) = recovered {
                changed |= self.replace_if_better(&mut candidate, model);
            }
            changed |= self.improve(&mut candidate);
        }
        let known = self
            .best
            .as_ref()
            .is_some_and(|best| best.support.cost <= candidate.support.cost);
        if known {
            return (false, None);
        }
        self.require(&candidate);
        let refined = changed.then(|| candidate.model.clone());
        self.best = Some(candidate);
        (true, refined)
    }

    /// Alternates between finding the inliers and fitting to them while that helps.
    ///
    /// A model straight from a sample is rough: the first fit looks twice as far, and counts only
    /// together with a second one at the right distance.
    fn improve(&mut self, candidate: &mut Candidate<E::Model>) -> bool {
        let max_error_px = self.judge_px;
        let wide = self
            .fitted(&candidate.model.clone(), 2.0 * max_error_px)
            .and_then(|model| self.fitted(&model, max_error_px));
        let mut changed = wide.is_some_and(|model| self.replace_if_better(candidate, model));
        for _ in 1..self.options.inner_iterations {
            let Some(model) = self.fitted(&candidate.model.clone(), max_error_px) else {
                break;
            };
            let before = candidate.support.cost;
            if !self.replace_if_better(candidate, model) {
                break;
            }
            changed = true;
            // Less than a thousandth of one datum is not worth another round.
            if before - candidate.support.cost < 1e-3 {
                break;
            }
        }
        changed
    }

    /// A model refined from its inliers, if there are enough.
    fn fitted(&mut self, model: &E::Model, max_error_px: f64) -> Option<E::Model> {
        self.estimator
            .inliers(model, max_error_px, &mut self.inliers);
        if self.inliers.len() < self.estimator.sample_size() {
            return None;
        }
        self.estimator.refine(model, &self.inliers, max_error_px)
    }

    /// Looks for a better optimum nearby, and judges by the errors that the inliers really have: where
    /// they are far smaller than the caller's threshold, that threshold lets in wrong matches by the
    /// dozen and cannot tell which model the right ones fit best.
    fn explore_sharply(&mut self, best: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&best.model, max_error_px, &mut self.inliers);
        if self.inliers.is_empty() {
            return;
        }
        // A count of inliers is about the threshold that the caller gave.
        if self.options.score == ScoreKind::Msac {
            self.judge_px = self.medians_of_errors_px(&best.model, SHARP_MEDIANS);
        }
        best.support = self.support(&best.model, f64::INFINITY);
        let explored = self.explore(best);
        self.judge_px = max_error_px;
        best.support = self.support(&best.model, f64::INFINITY);
        if !explored {
            self.improve(best);
        }
    }

    /// Looks for a better optimum nearby: starts that fit a few of the nearest data by least squares
    /// lie around the model, and local optimization leads some of them elsewhere. Where several lead back,
    /// the search ends early. False where there are too few such data, or the estimator has no such fit.
    ///
    /// Source: Chum, Matas & Kittler 2003, "Locally optimized RANSAC" (inner sampling).
    fn explore(&mut self, best: &mut Candidate<E::Model>) -> bool {
        let max_error_px = self.judge_px;
        let size = 2 * self.estimator.sample_size();
        let mut subset = Vec::with_capacity(size);
        let alike = vec![1.0; size];
        let reach_px = START_REACH * max_error_px;
        let mut returns = 0;
        for _ in 0..EXPLORATIONS {
            self.estimator
                .inliers(&best.model, reach_px, &mut self.inliers);
            if self.inliers.len() <= size {
                return false;
            }
            subset.clear();
            while subset.len() < size {
                let index = self.inliers[self.random.below(self.inliers.len())];
                if !subset.contains(&index) {
                    subset.push(index);
                }
            }
            let Some(start) = self.estimator.polish(&best.model, &subset, &alike) else {
                return false;
            };
            let Some(first) = self.fitted(&start, max_error_px) else {
                continue;
            };
            let known = best.support.cost;
            let cost = self.support(&first, (1.0 + FAR_OFF) * known).cost;
            if (cost - known).abs() < SAME * known.max(1.0) {
                returns += 1;
                if returns == RETURNS {
                    break;
                }
                continue;
            }
            if cost > (1.0 + FAR_OFF) * known {
                continue;
            }
            if let Some(model) = self.fitted(&first, max_error_px)
                && self.replace_if_better(best, model)
            {
                self.improve(best);
            }
        }
        true
    }

    /// Hears the estimator's objections to the best model.
    fn settle(&mut self, best: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&best.model, max_error_px, &mut self.inliers);
        if self.inliers.len() < self.estimator.sample_size() {
            return;
        }
        let settled =
            self.estimator
                .settle(&best.model, &self.inliers, max_error_px, &mut self.random);
        if let Some(model) = settled {
            let support = self.support(&model, f64::INFINITY);
            *best = Candidate { model, support };
            self.refinements += 1;
        }
    }

    /// The last refinement: least squares over all data within a few times the errors that inliers
    /// have, with the weights that Cauchy's loss gives. It weighs errors differently from the score,
    /// so its result is kept unless it loses inliers: one in twenty at most, and none where they are what
    /// counts.
    ///
    /// Source: Holland & Welsch 1977, "Robust regression using iteratively reweighted
    /// least-squares" (Cauchy's weights).
    fn polish(&mut self, candidate: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&candidate.model, max_error_px, &mut self.inliers);
        if self.inliers.len() < self.estimator.sample_size() {
            return;
        }
        let width_px = self.medians_of_errors_px(&candidate.model, WIDTH_MEDIANS);
        let reach_px = max_error_px.max(2.0 * width_px);
        let mut model = candidate.model.clone();
        let mut weights = Vec::new();
        for _ in 0..REWEIGHTINGS {
            self.estimator.inliers(&model, reach_px, &mut self.inliers);
            let error_sq = |&index: &usize| self.estimator.error_sq(&model, index);
            weights.clear();
            weights.extend(
                (self.inliers.iter().map(error_sq))
                    .map(|sq| 1.0 / (1.0 + sq / (width_px * width_px))),
            );
            let Some(polished) = self.estimator.polish(&model, &self.inliers, &weights) else {
                break;
            };
            model = polished;
        }
        let support = self.support(&model, f64::INFINITY);
        let (kept, of) = match self.options.score {
            ScoreKind::Msac => (19, 20),
            ScoreKind::InlierCount => (1, 1),
        };
        if of * support.num_inliers >= kept * candidate.support.num_inliers {
            *candidate = Candidate { model, support };
            self.refinements += 1;
        }
    }

    /// How large the errors of the inliers are: so many times their median, between a quarter of the
    /// threshold and the whole. The threshold is a guess of the caller's; errors a tenth as large
    /// deserve a sharper weight, and those that fill it a wider one.
    fn medians_of_errors_px(&self, model: &E::Model, medians: f64) -> f64 {
        let error_sq = |&index: &usize| self.estimator.error_sq(model, index);
        let mut errors_sq: Vec<f64> = self.inliers.iter().map(error_sq).collect();
        let middle = errors_sq.len() / 2;
        let (_, median_sq, _) = errors_sq.select_nth_unstable_by(middle, f64::total_cmp);
        let max_error_px = self.options.max_error_px;
        (medians * median_sq.sqrt()).clamp(0.25 * max_error_px, max_error_px)
    }

    fn replace_if_better(&mut self, candidate: &mut Candidate<E::Model>, model: E::Model) -> bool {
        let support = self.support(&model, candidate.support.cost);
        let better = support.cost < candidate.support.cost;
        if better {
            *candidate = Candidate { model, support };
            self.refinements += 1;
        }
        better
    }

    /// What a support is worth, as [`ScoreKind`] defines it.
    fn score(&self, support: &Support) -> f64 {
        match self.options.score {
            ScoreKind::InlierCount => support.num_inliers as f64,
            ScoreKind::Msac => (self.estimator.num_votes() - support.cost).max(0.0),
        }
    }

    fn support(&self, model: &E::Model, cost_limit: f64) -> Support {
        let by_count = self.options.score == ScoreKind::InlierCount;
        // The limit is about squared errors, which say nothing about a count of inliers.
        let limit = if by_count { f64::INFINITY } else { cost_limit };
        let max_error_px = self.judge_px;
        let mut support = self.estimator.support(model, max_error_px, limit);
        if by_count {
            support.cost = (self.estimator.num_data() - support.num_inliers) as f64;
        }
        if support.cost.is_nan() {
            support.cost = f64::INFINITY;
        }
        support
    }

    /// How many samples the new best model asks for.
    ///
    /// Where the data come in order of quality, the samples of the best of them are enough as soon as
    /// all-inlier samples of these are as likely as asked. Any first part of the data will do in which
    /// the model has more inliers than chance would give it; samples need not come from beyond the part
    /// that needs the fewest.
    ///
    /// Source: Chum & Matas 2005, "Matching with PROSAC", §2.2 (maximality and non-randomness).
    fn require(&mut self, best: &Candidate<E::Model>) {
        let num_data = self.estimator.num_data();
        self.required = self.required_for(best.support.num_inliers, num_data);
        if !self.sampler.is_ordered() {
            return;
        }
        let max_error_px = self.options.max_error_px;
        let size = self.estimator.sample_size();
        let chance = self.chance.unwrap_or(UNKNOWN_CHANCE);
        self.estimator
            .inliers(&best.model, max_error_px, &mut self.inliers);
        let mut limit = num_data;
        for (place, index) in self.inliers.iter().enumerate() {
            let (num_inliers, front) = (place + 1, index + 1);
            let required = self.required_for(num_inliers, front);
            if required < self.required
                && log10_false_alarms(
                    num_inliers,
                    front,
                    size,
                    self.estimator.max_models(),
                    chance,
                ) < HARDLY_CHANCE
            {
                self.required = required;
                limit = front;
            }
        }
        self.sampler.keep_to(limit);
    }

    fn required_for(&self, num_inliers: usize, num_data: usize) -> u64 {
        let size = self.estimator.sample_size();
        let probability = match self.options.budget {
            Budget::WithReplacement => ratio_to_the(num_inliers as f64 / num_data as f64, size),
            Budget::WithoutReplacement => all_inlier_probability(num_inliers, num_data, size),
        };
        trials(probability, self.log_miss)
    }

    fn update_stop(&mut self) {
        let iterations = self.iterations as u64;
        let least = self.options.min_iterations.min(self.options.max_iterations);
        if self.iterations >= least && iterations >= self.required {
            self.stop = Some(StopReason::Confident);
        } else if self.iterations >= self.options.max_iterations {
            self.stop = Some(StopReason::Exhausted);
        }
    }
}
