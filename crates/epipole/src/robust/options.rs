//! Options and report of RANSAC.

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
    /// Good data first: the data are sorted by quality, best first, and samples come from a growing
    /// prefix. The run ends once a prefix has more inliers than expected by chance and was sampled
    /// often enough.
    ///
    /// Source: Chum & Matas 2005, "Matching with PROSAC".
    Prosac,
}

/// Scoring function. Scores range from 0 (nothing fits) to the number of data points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case")
)]
pub enum ScoreKind {
    /// `Σ max(0, 1 − e²/T²)`: a data point on the model counts 1, one at the threshold 0.
    ///
    /// Source: Torr & Zisserman 2000, MSAC.
    Msac,
    /// Number of data points within the threshold.
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
    /// [`num_trials_with_replacement`](super::num_trials_with_replacement): the textbook formula,
    /// `wˢ`.
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
    /// Given by [`RansacOptions::max_error_px`].
    Given,
    /// Estimated along with the model from the noise of the inliers: it contains 99 % of them.
    /// [`RansacOptions::max_error_px`] is ignored, so the result does not depend on a guess;
    /// [`RansacReport::max_error_px`] is the estimated threshold, at least a twentieth of a pixel.
    /// The loop runs about five times, each with up to [`RansacOptions::max_iterations`].
    ///
    /// Applies to [`ransac`](super::ransac) and its callers; [`Ransac`](super::Ransac) itself is a
    /// single run with the given threshold.
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
    /// Threshold T: a data point closer to a model is an inlier. Pixels, > 0; for a custom
    /// estimator, the unit of its errors. 1.
    pub max_error_px: f64,
    /// Source of the threshold. Given.
    pub threshold: ThresholdKind,
    /// Probability that at least one sample is free of outliers, in (0, 1). 0.999.
    pub confidence: f64,
    /// Minimum number of samples, unless [`max_iterations`](Self::max_iterations) is lower. 200,
    /// since the number required by the inlier ratio assumes that any outlier-free sample leads to
    /// the best model, but with noise only some do.
    pub min_iterations: usize,
    /// Maximum number of samples, ≥ 1. 10 000.
    pub max_iterations: usize,
    /// Equal seeds give equal results. 0.
    pub seed: u64,
    /// Sampling strategy. Uniform.
    pub sampler: SamplerKind,
    /// Scoring function. MSAC.
    pub score: ScoreKind,
    /// Whether promising models are improved from their inliers at once, and the best one at the
    /// end. True.
    pub local_optimization: bool,
    /// Number of rounds of finding and fitting inliers per local optimization; 0 acts like 1. 4.
    pub inner_iterations: usize,
    /// Formula for the sufficient number of samples. Without replacement.
    pub budget: Budget,
    /// Whether every model is scored on all data, so that a figure can show its score. Otherwise
    /// scoring stops as soon as a model cannot win. False.
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
    /// Returns the same options with a given threshold, such as that of a report, for steps that
    /// use its inliers.
    ///
    /// ```
    /// use epipole::robust::{RansacOptions, ThresholdKind};
    /// let searching = RansacOptions::default().with_threshold(ThresholdKind::Noise);
    /// let fixed = searching.within(1.5);
    /// assert_eq!((fixed.threshold, fixed.max_error_px), (ThresholdKind::Given, 1.5));
    /// ```
    pub fn within(&self, max_error_px: f64) -> Self {
        Self {
            max_error_px,
            threshold: ThresholdKind::Given,
            ..*self
        }
    }

    /// Checks that every field is in its range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the name of the first invalid field.
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

/// Reason why the loop ended.
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
    /// The best model. With [`ScoreKind::Msac`] its final refinement weights errors relative to
    /// those of the inliers, so it may have up to 5 % fewer inliers than the best model found.
    pub model: M,
    /// For each input data point, whether it is within the threshold of `model`.
    pub inliers: Vec<bool>,
    /// Number of `inliers` that are true.
    pub num_inliers: usize,
    /// Number of inliers that counts equal data once, and for F, E and H also matches that share a
    /// pixel. This number, not `num_inliers`, measures the support of the model.
    pub num_unique_inliers: usize,
    /// Number of data points left out, which are no inliers: with an infinite coordinate, or one
    /// beyond 10⁹ pixels.
    pub num_left_out: usize,
    /// Number of samples drawn.
    pub iterations: usize,
    /// Number of samples required by the final inlier ratio, for [`SamplerKind::Prosac`] by that
    /// among the best data; `u64::MAX` if no number is enough.
    pub required_iterations: u64,
    /// Inlier threshold T, pixels.
    pub max_error_px: f64,
    /// Score of the model over unique data, as defined by [`ScoreKind`].
    pub score: f64,
    /// Expected number of models with this support in data without structure, as a decimal
    /// logarithm ([`log10_false_alarms`](super::log10_false_alarms)): the support is significant
    /// only below 0. `None` if the estimator does not know the probability of a chance fit.
    pub log10_false_alarms: Option<f64>,
    /// Number of times a model was improved from its inliers.
    pub refinements: usize,
    /// Reason why the loop ended.
    pub stop: StopReason,
}

/// Decimal logarithm of the expected number of chance models below which support is significant.
pub(super) const MAX_LOG10_FALSE_ALARMS: f64 = -2.0;

impl<M> RansacReport<M> {
    /// Returns whether unrelated data might show as much support by chance, so that the model is
    /// meaningless. False if the estimator does not know the probability of a chance fit.
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
    /// // Random matches; some of them agree nevertheless.
    /// let report = estimate_fundamental(&anywhere(), &anywhere(), &RansacOptions::default(), &mut ())?;
    /// assert!(report.num_inliers > 7 && report.could_be_random());
    /// # Ok(()) }
    /// ```
    pub fn could_be_random(&self) -> bool {
        self.log10_false_alarms
            .is_some_and(|log| log > MAX_LOG10_FALSE_ALARMS)
    }

    /// Converts the model of the report.
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
