//! Options and report of the loop.

use crate::{Error, Result};
use derive_setters::Setters;

/// Sampling strategy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum SamplerKind {
    /// Every subset of the data is equally likely.
    Uniform,
    /// Good data first: the data are ordered by quality, best first, and samples come from a
    /// growing share of the front. The run ends once a front of the data has more inliers than
    /// chance would give and was sampled often enough.
    ///
    /// Source: Chum & Matas 2005, "Matching with PROSAC".
    Prosac,
}

/// Scoring function. Scores count from 0 (nothing fits) to the number of data.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum ScoreKind {
    /// `Σ max(0, 1 − e²/T²)`: a datum on the model counts 1, one at the threshold 0.
    ///
    /// Source: Torr & Zisserman 2000, MSAC.
    Msac,
    /// The number of data within the threshold.
    ///
    /// Source: Fischler & Bolles 1981.
    InlierCount,
}

/// Formula for the sufficient number of samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum Budget {
    /// [`num_trials_with_replacement`](super::num_trials_with_replacement): the textbook's `wˢ`.
    WithReplacement,
    /// [`num_trials_without_replacement`](super::num_trials_without_replacement): exact.
    WithoutReplacement,
}

/// Source of the threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum ThresholdKind {
    /// It is [`RansacOptions::max_error_px`].
    Given,
    /// Estimated along with the model from the noise of the inliers: 99 of 100 of them are within
    /// it. [`RansacOptions::max_error_px`] is ignored, and the outcome does not depend on any
    /// guess; [`RansacReport::max_error_px`] is the estimated threshold, at least a twentieth of a
    /// pixel. The loop runs some five times, with [`RansacOptions::max_iterations`] for each run.
    ///
    /// This is for [`ransac`](super::ransac) and all that call it; [`Ransac`](super::Ransac) by
    /// itself is one run, with the threshold given.
    ///
    /// Source: Edstedt 2025, "Less biased noise scale estimation for threshold-robust RANSAC".
    Noise,
}

/// Options of [`Ransac`](super::Ransac).
///
/// ```
/// use epipole::robust::RansacOptions;
/// let options = RansacOptions::default().with_max_error_px(2.0).with_seed(7);
/// assert_eq!(options.confidence, 0.999);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Setters)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[setters(prefix = "with_")]
#[non_exhaustive]
pub struct RansacOptions {
    /// The threshold T: a datum nearer than this to a model is an inlier. Pixels, > 0; of an
    /// estimator of one's own, the unit of its errors. 1.
    pub max_error_px: f64,
    /// Source of the threshold. Given.
    pub threshold: ThresholdKind,
    /// The probability that at least one sample is free of outliers, in (0, 1). 0.999.
    pub confidence: f64,
    /// Minimum number of samples, unless [`max_iterations`](Self::max_iterations) is lower. 200:
    /// the number required by the inlier ratio takes every sample without outliers for a good
    /// start, but with noise only some of them lead to the best model.
    pub min_iterations: usize,
    /// Maximum number of samples, ≥ 1. 10 000.
    pub max_iterations: usize,
    /// Equal seeds give equal results. 0.
    pub seed: u64,
    /// Sampling strategy. Uniform.
    pub sampler: SamplerKind,
    /// Scoring function. MSAC.
    pub score: ScoreKind,
    /// Whether a promising model is improved from its inliers at once, and the best one at the
    /// end. True.
    pub local_optimization: bool,
    /// Rounds of "find the inliers, fit to them" in one local optimization, 0 as good as 1. 4.
    pub inner_iterations: usize,
    /// Formula for the sufficient number of samples. Without replacement.
    pub budget: Budget,
    /// Whether every model is compared with every datum, so that a figure can show its score.
    /// Otherwise a model is dropped as soon as it cannot win. False.
    pub score_every_trial: bool,
}

impl Default for RansacOptions {
    fn default() -> Self {
        Self {
            max_error_px: 1.0,
            threshold: ThresholdKind::Given,
            confidence: 0.999,
            min_iterations: 200,
            max_iterations: 10_000,
            seed: 0,
            sampler: SamplerKind::Uniform,
            score: ScoreKind::Msac,
            local_optimization: true,
            inner_iterations: 4,
            budget: Budget::WithoutReplacement,
            score_every_trial: false,
        }
    }
}

impl RansacOptions {
    /// The same with a given threshold, such as that of a report, for steps that build on its
    /// inliers.
    ///
    /// ```
    /// use epipole::robust::{RansacOptions, ThresholdKind};
    /// let searching = RansacOptions::default().with_threshold(ThresholdKind::Noise);
    /// let given = searching.within(1.5);
    /// assert_eq!((given.threshold, given.max_error_px), (ThresholdKind::Given, 1.5));
    /// ```
    pub fn within(&self, max_error_px: f64) -> Self {
        Self {
            max_error_px,
            threshold: ThresholdKind::Given,
            ..*self
        }
    }

    /// Whether every field is in its range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] naming the first field that is not.
    pub fn check(&self) -> Result<()> {
        let refuse = |what, requirement, value| {
            Err(Error::OutOfRange {
                what,
                requirement,
                value,
            })
        };
        let threshold_sq = self.max_error_px * self.max_error_px;
        if !(self.max_error_px > 0.0 && threshold_sq > 0.0 && threshold_sq.is_finite()) {
            return refuse(
                "the largest error of an inlier",
                "greater than 0 pixels and finite",
                self.max_error_px,
            );
        }
        if !(self.confidence > 0.0 && self.confidence < 1.0) {
            return refuse(
                "the confidence",
                "greater than 0 and less than 1",
                self.confidence,
            );
        }
        if self.max_iterations == 0 {
            return refuse("the largest number of iterations", "at least 1", 0.0);
        }
        Ok(())
    }
}

/// Why the loop ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// Enough samples for the required confidence.
    Confident,
    /// [`RansacOptions::max_iterations`] were drawn; the confidence was not reached.
    Exhausted,
    /// The caller finished the run early.
    Interrupted,
}

/// Result of [`Ransac`](super::Ransac).
#[derive(Debug, Clone, PartialEq)]
pub struct RansacReport<M> {
    /// The best model. With [`ScoreKind::Msac`] its last refinement weighs errors by how large
    /// those of the inliers are, so that it may have up to one in twenty inliers fewer than the
    /// best one seen.
    pub model: M,
    /// For each datum given, whether it is within the threshold of `model`.
    pub inliers: Vec<bool>,
    /// Number of `inliers` that are true.
    pub num_inliers: usize,
    /// The same, with equal data counted once, and for F, E and H also matches that meet in a pixel
    /// of an image. This number, not `num_inliers`, measures the support of the model.
    pub num_unique_inliers: usize,
    /// Data that were left out, and so are no inliers: an infinite coordinate, or one beyond 10⁹
    /// pixels.
    pub num_left_out: usize,
    /// Samples drawn.
    pub iterations: usize,
    /// Number of samples required by the final inlier ratio, with [`SamplerKind::Prosac`] that
    /// among the best data; `u64::MAX` if no number is enough.
    pub required_iterations: u64,
    /// The threshold T within which a datum is an inlier, pixels.
    pub max_error_px: f64,
    /// The model's score over different data, as [`ScoreKind`] defines it.
    pub score: f64,
    /// Expected number of models with this support in data without any structure, as a decimal
    /// logarithm ([`log10_false_alarms`](super::log10_false_alarms)): the support is significant
    /// only below 0. `None` if the estimator does not know the chance of a datum.
    pub log10_false_alarms: Option<f64>,
    /// Number of times a model was improved from its inliers.
    pub refinements: usize,
    /// Why the loop ended.
    pub stop: StopReason,
}

/// Support that unrelated data would show less often than this, as a decimal logarithm, is no
/// chance.
pub(super) const HARDLY_CHANCE: f64 = -2.0;

impl<M> RansacReport<M> {
    /// Whether data that have nothing to do with one another might have shown as much support: then
    /// the model means nothing. False if the estimator does not know the chance of a datum.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::estimate_fundamental;
    /// use epipole::math::random::Random;
    /// use epipole::robust::RansacOptions;
    /// use nalgebra::Point2;
    /// let mut random = Random::new(1);
    /// let mut anywhere = || -> Vec<_> {
    ///     (0..100).map(|_| Point2::new(random.uniform(0.0, 640.0), random.uniform(0.0, 480.0))).collect()
    /// };
    /// // Matches without any rhyme or reason; some of them agree nevertheless.
    /// let report = estimate_fundamental(&anywhere(), &anywhere(), &RansacOptions::default(), &mut ())?;
    /// assert!(report.num_inliers > 7 && report.could_be_chance());
    /// # Ok(()) }
    /// ```
    pub fn could_be_chance(&self) -> bool {
        self.log10_false_alarms
            .is_some_and(|log| log > HARDLY_CHANCE)
    }

    /// The same report with another form of the model.
    pub fn map<N>(self, into: impl FnOnce(M) -> N) -> RansacReport<N> {
        RansacReport {
            model: into(self.model),
            inliers: self.inliers,
            num_inliers: self.num_inliers,
            num_unique_inliers: self.num_unique_inliers,
            num_left_out: self.num_left_out,
            iterations: self.iterations,
            required_iterations: self.required_iterations,
            max_error_px: self.max_error_px,
            score: self.score,
            log10_false_alarms: self.log10_false_alarms,
            refinements: self.refinements,
            stop: self.stop,
        }
    }
}
