//! Scale of the errors of inliers that are not known.

use super::Estimator;
use super::chance::UNKNOWN_CHANCE;

/// Distribution of the errors of data unrelated to a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Background {
    codimension: usize,
    /// Probability that an unrelated datum is within one pixel, extrapolated from small errors. It
    /// grows with the error to the power of `codimension`.
    chance_of_one_px: f64,
}

impl Background {
    /// Takes the chance of a fit from an estimator.
    ///
    /// * `little_px`: an error that hardly any unrelated data are within
    /// * `unknown_px`: the error that [`UNKNOWN_CHANCE`] of them are within, for an estimator that
    ///   does not know
    pub(super) fn new<E: Estimator + ?Sized>(
        estimator: &E,
        little_px: f64,
        unknown_px: f64,
    ) -> Self {
        let problem = estimator.problem();
        let codimension = problem.codimension.clamp(1, 2);
        let (chance, within_px) = (problem.data.chance(problem.codimension, little_px))
            .map_or((UNKNOWN_CHANCE, unknown_px), |chance| (chance, little_px));
        Self {
            codimension,
            chance_of_one_px: chance / to_the(codimension, within_px),
        }
    }

    /// In how many dimensions a datum can miss the model: 1 or 2.
    pub(super) fn codimension(&self) -> usize {
        self.codimension
    }

    /// The probability that an unrelated datum is within this error.
    pub(super) fn chance(&self, error_px: f64) -> f64 {
        (self.chance_of_one_px * to_the(self.codimension, error_px)).min(1.0)
    }

    /// The error that this share of unrelated data is within.
    pub(super) fn reach_px(&self, share: f64) -> f64 {
        let power = share / self.chance_of_one_px;
        if self.codimension == 1 {
            power
        } else {
            power.sqrt()
        }
    }

    /// Ratio of the densities of good and unrelated data at error 0.
    fn contrast(&self, scale_px: f64) -> f64 {
        // Half of a Gaussian over a constant, or Rayleigh's density over a straight line.
        let per_scale = match self.codimension {
            1 => (2.0 / core::f64::consts::PI).sqrt(),
            _ => 0.5,
        };
        per_scale / (self.chance_of_one_px * to_the(self.codimension, scale_px))
    }
}

fn to_the(codimension: usize, x: f64) -> f64 {
    if codimension == 1 { x } else { x * x }
}

/// Expectation and maximization end when the scale moves by less than this share, or after `ROUNDS`
/// rounds.
const STEADY: f64 = 1e-3;
const ROUNDS: usize = 100;

/// Initial values of the search for the scale, as multiples of the expected one.
const STARTS: [f64; 3] = [1.0, 4.0, 0.25];

/// The standard deviation of the errors that good data have in each dimension, pixels. `None` if no
/// data are distinct from the background.
///
/// Errors are a mixture: those of good data Gaussian, those of the others as in `background`. The
/// deviation of the data within a threshold would instead confirm the threshold: one too small cuts
/// off the larger errors, one too large lets in wrong data. A model is also closer to the data that
/// it was fitted to than the truth is: they have as many errors fewer as it has parameters.
///
/// * `errors_sq`: of the data nearest to the model, px², all others being wrong
/// * `num_data`: total number of data
/// * `expected_px`: initial value; others are tried, too
/// * `least_px`: no deviation is smaller
/// * `num_parameters`: of the model
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

/// Good data and others.
#[derive(Debug, Clone, Copy)]
struct Mixture {
    scale_px: f64,
    num_good: f64,
    log_likelihood: f64,
}

impl Mixture {
    /// By expectation and maximization.
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
            let share = (found.num_good / num_data).clamp(1e-9, 1.0 - 1e-9);
            let odds = share / (1.0 - share) * background.contrast(found.scale_px);
            let per_variance = 0.5 / (found.scale_px * found.scale_px);
            let (mut sum, mut sum_sq, mut log_likelihood) = (0.0, 0.0, 0.0);
            for error_sq in errors_sq {
                let odds = odds * libm::exp(-error_sq * per_variance);
                let good = odds / (1.0 + odds);
                sum += good;
                sum_sq += good * error_sq;
                log_likelihood += libm::log1p(odds);
            }
            found.log_likelihood = log_likelihood + num_data * libm::log1p(-share);
            found.num_good = sum;
            let before = found.scale_px;
            let variance = sum_sq / (background.codimension as f64 * sum);
            // Data that fit exactly have no scale, and none at all have NaN.
            found.scale_px = variance.sqrt().max(least_px);
            if (found.scale_px - before).abs() < STEADY * before {
                break;
            }
        }
        found
    }
}
