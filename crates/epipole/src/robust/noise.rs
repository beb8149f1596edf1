//! Noise scale of unknown inliers.

use super::Estimator;
use super::false_alarms::UNKNOWN_PROBABILITY;

/// Distribution of the errors of unrelated data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Background {
    codimension: usize,
    /// Probability that an unrelated data point is within one pixel, extrapolated from small
    /// errors. It grows with the error to the power of `codimension`.
    probability_within_1px: f64,
}

impl Background {
    /// Takes the probability of a chance fit from an estimator.
    ///
    /// * `little_px`: an error that few unrelated data points are within
    /// * `unknown_px`: the error that [`UNKNOWN_PROBABILITY`] of them are within, for an estimator
    ///   that does not provide a probability
    pub(super) fn new<E: Estimator + ?Sized>(
        estimator: &E,
        little_px: f64,
        unknown_px: f64,
    ) -> Self {
        let problem = estimator.problem();
        let codimension = problem.codimension.clamp(1, 2);
        let (random_inlier_probability, within_px) = (problem
            .data
            .random_inlier_probability(problem.codimension, little_px))
        .map_or(
            (UNKNOWN_PROBABILITY, unknown_px),
            |random_inlier_probability| (random_inlier_probability, little_px),
        );
        Self {
            codimension,
            probability_within_1px: random_inlier_probability / to_the(codimension, within_px),
        }
    }

    /// Returns the dimension of an error: 1 or 2.
    pub(super) fn codimension(&self) -> usize {
        self.codimension
    }

    /// Returns the probability that an unrelated data point is within this error.
    pub(super) fn random_inlier_probability(&self, error_px: f64) -> f64 {
        (self.probability_within_1px * to_the(self.codimension, error_px)).min(1.0)
    }

    /// Returns the error that this fraction of unrelated data points is within.
    pub(super) fn reach_px(&self, fraction: f64) -> f64 {
        let power = fraction / self.probability_within_1px;
        if self.codimension == 1 {
            power
        } else {
            power.sqrt()
        }
    }

    /// Returns the ratio of the densities of good and unrelated data at error 0.
    fn contrast(&self, scale_px: f64) -> f64 {
        // Half-Gaussian over a constant, or Rayleigh density over a linear one.
        let per_scale = match self.codimension {
            1 => (2.0 / core::f64::consts::PI).sqrt(),
            _ => 0.5,
        };
        per_scale / (self.probability_within_1px * to_the(self.codimension, scale_px))
    }
}

fn to_the(codimension: usize, x: f64) -> f64 {
    if codimension == 1 { x } else { x * x }
}

/// Relative change of the scale at which expectation–maximization ends, unless `ROUNDS` are over.
const STEADY: f64 = 1e-3;
const ROUNDS: usize = 100;

/// Initial values of the search for the scale, as multiples of the expected one.
const STARTS: [f64; 3] = [1.0, 4.0, 0.25];

/// Estimates the standard deviation of the errors of good data in each dimension, pixels. `None` if
/// no data stand out from the background.
///
/// Errors are a mixture: Gaussian for good data, and as in `background` for the others. The plain
/// deviation of the data within a threshold would confirm the threshold: too small a threshold cuts
/// off the larger errors, too large a one admits outliers. Also, a model is closer to the data it
/// was fitted to than the truth is; dividing by the degrees of freedom corrects this.
///
/// * `errors_sq`: squared errors of the data nearest to the model, px²; all others are outliers
/// * `num_data`: total number of data
/// * `expected_px`: initial value; others are tried in addition
/// * `least_px`: lower bound of the deviation
/// * `num_parameters`: number of parameters of the model
///
/// Source: Torr & Zisserman 2000, "MLESAC" (the mixture); Edstedt 2025, "Less biased noise scale
/// estimation for threshold-robust RANSAC" (the two biases).
pub(super) fn noise_scale_px(
    errors_sq: &[f64],
    num_data: usize,
    background: &Background,
    expected_px: f64,
    least_px: f64,
    num_parameters: usize,
) -> Option<f64> {
    let fits = STARTS.map(|times| {
        Mixture::fit(
            errors_sq,
            num_data,
            background,
            (times * expected_px).max(least_px),
            least_px,
        )
    });
    let best = (fits.iter()).max_by(|a, b| a.log_likelihood.total_cmp(&b.log_likelihood))?;
    if best.scale_px <= least_px {
        return Some(least_px);
    }
    let num_errors = background.codimension as f64 * best.num_good;
    let left = num_errors - num_parameters as f64;
    // With less redundancy than one sample the estimate is meaningless.
    (left >= 1.0).then(|| best.scale_px * (num_errors / left).sqrt())
}

/// Mixture of good and unrelated data.
#[derive(Debug, Clone, Copy)]
struct Mixture {
    scale_px: f64,
    num_good: f64,
    log_likelihood: f64,
}

impl Mixture {
    /// Fits the mixture by expectation–maximization.
    fn fit(
        errors_sq: &[f64],
        num_data: usize,
        background: &Background,
        start_px: f64,
        least_px: f64,
    ) -> Self {
        let num_data = num_data.max(1) as f64;
        let mut found = Self {
            scale_px: start_px,
            num_good: 0.5 * errors_sq.len() as f64,
            log_likelihood: f64::NEG_INFINITY,
        };
        for _ in 0..ROUNDS {
            let ratio = (found.num_good / num_data).clamp(1e-9, 1.0 - 1e-9);
            let odds = ratio / (1.0 - ratio) * background.contrast(found.scale_px);
            let per_variance = 0.5 / (found.scale_px * found.scale_px);
            let (mut sum, mut sum_sq, mut log_likelihood) = (0.0, 0.0, 0.0);
            for error_sq in errors_sq {
                let odds = odds * libm::exp(-error_sq * per_variance);
                let good = odds / (1.0 + odds);
                sum += good;
                sum_sq += good * error_sq;
                log_likelihood += libm::log1p(odds);
            }
            found.log_likelihood = log_likelihood + num_data * libm::log1p(-ratio);
            found.num_good = sum;
            let before = found.scale_px;
            let variance = sum_sq / (background.codimension as f64 * sum);
            // Exact data have no scale, and no data give NaN.
            found.scale_px = variance.sqrt().max(least_px);
            if (found.scale_px - before).abs() < STEADY * before {
                break;
            }
        }
        found
    }
}
