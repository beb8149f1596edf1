//! The end of a run: a look around the best model, the estimator's objections, the last refinement, the report.

use super::{Candidate, Ransac};
use crate::math::order::at_rank;
use crate::robust::chance::log10_false_alarms;
use crate::robust::{Estimator, RansacReport, ScoreKind, StopReason, Unique};
use crate::{Error, Result};

/// Starts around the best model that are tried at the end, at most.
const EXPLORATIONS: usize = 30;

/// Where errors fill the threshold and a wider look follows, so many starts in a row that find nothing better are enough:
/// they end wherever the edge of the threshold stops them, and hardly one leads back. On photographs and drawn planes ten
/// did as well as all, six did worse.
const IN_VAIN: usize = 10;

/// A start fits some of the data within so many thresholds of the best model: those outside of
/// one threshold are what another model would claim.
const START_REACH: f64 = 3.0;

/// So many starts, at least, that lead back to the best model show that there is hardly another one nearby.
const RETURNS: usize = 3;

/// More have to lead back where that costs next to nothing, so many inliers in all: few data leave room for several
/// optima.
const RETURNED_INLIERS: usize = 3000;

/// A start whose first fit costs more than the best model by this share of its cost is left off.
const FAR_OFF: f64 = 0.1;

/// A start whose first or second fit costs the same up to this share, or this much of one datum, leads back
/// to the best model.
const SAME: f64 = 2e-3;

/// At the end, models are compared within so many medians of the errors that inliers have: two
/// standard deviations, if errors of one dimension are Gaussian.
const SHARP_MEDIANS: f64 = 3.0;

/// They are compared within so many thresholds at most, look by look, for errors of one dimension and of two. Errors
/// that fill the threshold tell two homographies apart only by what lies behind it, as errors of two dimensions are
/// small by chance so seldom; but a wide look alone would leave a sharp optimum.
const SHARP_THRESHOLDS: [&[f64]; 2] = [&[1.0], &[1.0, 2.0]];

/// The width of the last loss, in the same medians, for errors of one dimension, of which it is three standard
/// deviations, and of two. Chosen on classes of pairs, of which nearly every one gains where it is left out of the choice.
const WIDTH_MEDIANS: [f64; 2] = [4.5, 4.0];

/// The width of the last loss, in thresholds, at most: errors that fill the threshold go on behind it.
const WIDTH_THRESHOLDS: f64 = 2.0;

/// How often data are weighed anew at the end. Where few data say what the many leave open, more of it would
/// do away with them.
const REWEIGHTINGS: usize = 8;

/// In so many of these the width is that of the errors that are left, not of those at the start: from there the path
/// of the search would show in the result. Then it stays, or weights and width would narrow each other.
const REWEIGHTINGS_OF_WIDTH: usize = 5;

impl<E: Estimator> Ransac<E> {
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

    /// Looks for a better optimum nearby, and judges by the errors that the inliers really have: where
    /// they are far smaller than the caller's threshold, that threshold lets in wrong matches by the
    /// dozen and cannot tell which model the right ones fit best.
    fn explore_sharply(&mut self, best: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        let mut explored = true;
        let mut errors_sq = Vec::with_capacity(self.estimator.num_data());
        let looks = SHARP_THRESHOLDS[self.codimension_index()];
        for (look, &most) in looks.iter().enumerate() {
            self.estimator
                .inliers(&best.model, max_error_px, &mut self.inliers);
            if self.inliers.is_empty() {
                break;
            }
            let mut patience = EXPLORATIONS;
            // A count of inliers is about the threshold that the caller gave.
            if self.options.score == ScoreKind::Msac {
                let most_px = most * max_error_px;
                self.estimator
                    .errors_sq(&best.model, &self.inliers, &mut errors_sq);
                self.judge_px = self.medians_px(&mut errors_sq, SHARP_MEDIANS, most_px);
                if self.judge_px == most_px && look + 1 < looks.len() {
                    patience = IN_VAIN;
                }
            }
            best.support = self.support(&best.model, f64::INFINITY);
            explored = self.explore(best, patience);
        }
        self.judge_px = max_error_px;
        best.support = self.support(&best.model, f64::INFINITY);
        if !explored {
            self.improve(best);
        }
    }

    /// Looks for a better optimum nearby: starts that fit a few of the nearest data by least squares
    /// lie around the model, and local optimization leads some of them elsewhere. Where several lead back, or `patience` of
    /// them in a row find nothing better, the search ends early. False where there are too few such data, or the estimator has no such fit.
    ///
    /// Source: Chum, Matas & Kittler 2003, "Locally optimized RANSAC" (inner sampling).
    fn explore(&mut self, best: &mut Candidate<E::Model>, patience: usize) -> bool {
        let max_error_px = self.judge_px;
        let size = 2 * self.estimator.sample_size();
        let mut subset = Vec::with_capacity(size);
        let alike = vec![1.0; size];
        let reach_px = START_REACH * max_error_px;
        let needed =
            (RETURNED_INLIERS / best.support.num_inliers.max(1)).clamp(RETURNS, EXPLORATIONS);
        let (mut returns, mut in_vain) = (0, 0);
        let mut around = Vec::with_capacity(self.estimator.num_data());
        let mut moved = true;
        for _ in 0..EXPLORATIONS {
            if returns == needed || in_vain == patience {
                break;
            }
            in_vain += 1;
            if moved {
                self.estimator.inliers(&best.model, reach_px, &mut around);
                moved = false;
            }
            if around.len() <= size {
                return false;
            }
            subset.clear();
            while subset.len() < size {
                let index = around[self.random.below(around.len())];
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
            let leads_back = |cost: f64| (cost - known).abs() < SAME * known.max(1.0);
            let cost = self.support(&first, (1.0 + FAR_OFF) * known).cost;
            if cost > (1.0 + FAR_OFF) * known {
                continue;
            }
            let mut back = leads_back(cost);
            if !back && let Some(model) = self.fitted(&first, max_error_px) {
                back = leads_back(self.support(&model, (1.0 + SAME) * known).cost);
                if !back && self.replace_if_better(best, model) {
                    self.improve(best);
                    moved = true;
                    in_vain = 0;
                }
            }
            returns += usize::from(back);
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
    /// have, with Welsch's weights, which leave next to nothing of what is far off. It weighs errors
    /// differently from the score, so its result is kept unless it loses inliers: one in twenty at most, and none where they are what
    /// counts.
    ///
    /// Source: Holland & Welsch 1977, "Robust regression using iteratively reweighted
    /// least-squares" (Welsch's weights).
    fn polish(&mut self, candidate: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&candidate.model, max_error_px, &mut self.inliers);
        if self.inliers.len() < self.estimator.sample_size() {
            return;
        }
        let mut model = candidate.model.clone();
        // Squared errors become weights where they stand.
        let mut weights = Vec::with_capacity(self.estimator.num_data());
        let mut width_px = 0.0;
        let medians = WIDTH_MEDIANS[self.codimension_index()];
        for round in 0..REWEIGHTINGS {
            if round < REWEIGHTINGS_OF_WIDTH {
                self.estimator
                    .inliers(&model, max_error_px, &mut self.inliers);
                if self.inliers.is_empty() {
                    break;
                }
                let most_px = WIDTH_THRESHOLDS * max_error_px;
                self.estimator
                    .errors_sq(&model, &self.inliers, &mut weights);
                width_px = self.medians_px(&mut weights, medians, most_px);
            }
            let reach_px = max_error_px.max(2.0 * width_px);
            self.estimator.inliers(&model, reach_px, &mut self.inliers);
            self.estimator
                .errors_sq(&model, &self.inliers, &mut weights);
            for weight in &mut weights {
                *weight = libm::exp(-*weight / (width_px * width_px));
            }
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
        let keeps = of * support.num_inliers >= kept * candidate.support.num_inliers;
        if keeps && !self.is_gathered(&model) {
            *candidate = Candidate { model, support };
            self.refinements += 1;
        }
    }

    /// Where constants stand that differ by the dimension of errors.
    fn codimension_index(&self) -> usize {
        self.estimator.codimension().clamp(1, 2) - 1
    }

    /// How large the errors of the inliers are: so many times their median, between a quarter of the
    /// threshold and `most_px`. The threshold is a guess of the caller's; errors a tenth as large
    /// deserve a sharper weight, and those that fill it a wider one.
    ///
    /// * `errors_sq`: the squared errors, one at least; comes back in another order
    fn medians_px(&self, errors_sq: &mut [f64], medians: f64, most_px: f64) -> f64 {
        let median_sq = at_rank(errors_sq, errors_sq.len() / 2);
        let least_px = 0.25 * self.options.max_error_px;
        (medians * median_sq.sqrt()).clamp(least_px, most_px)
    }
}
