//! Scoring of a model by its errors over many matches, eight at a time.
//!
//! The loops do not depend on the error function; they are inlined into kernels compiled for
//! several processors, next to each [`LaneErrors`].

use super::coordinates::{Coordinates, LANES, Lanes, sum};
use crate::optim::RobustLoss;
use crate::robust::Support;

/// A model that computes its errors for eight matches at once.
pub(crate) trait LaneErrors {
    /// Computes `e²/T²` of eight matches for a given `1/T²`; NaN counts as an outlier.
    fn relative_errors(&self, lanes: &[Lanes; 4], per_threshold_sq: f64) -> Lanes;
}

/// Returns the support of a model among the matches; stops once the cost exceeds the limit.
#[inline(always)]
pub(crate) fn support(
    model: &impl LaneErrors,
    coordinates: &Coordinates,
    max_error: f64,
    cost_limit: f64,
) -> Support {
    let per_threshold_sq = 1.0 / (max_error * max_error);
    let (mut cost, mut inliers) = ([0.0; LANES], [0.0; LANES]);
    let mut start = 0;
    while start < coordinates.len() {
        // The limit is checked every 32 matches.
        for _ in 0..4 {
            if start >= coordinates.len() {
                break;
            }
            let (lanes, count) = coordinates.lanes(start);
            let errors = model.relative_errors(lanes, per_threshold_sq);
            if let Some(votes) = coordinates.weights(start) {
                for l in 0..count {
                    let fits = errors[l] < 1.0;
                    cost[l] += votes[l] * if fits { errors[l] } else { 1.0 };
                    inliers[l] += if fits { 1.0 } else { 0.0 };
                }
            } else if count == LANES {
                for l in 0..LANES {
                    // NaN counts as an outlier.
                    let fits = errors[l] < 1.0;
                    cost[l] += if fits { errors[l] } else { 1.0 };
                    inliers[l] += if fits { 1.0 } else { 0.0 };
                }
            } else {
                for l in 0..count {
                    let fits = errors[l] < 1.0;
                    cost[l] += if fits { errors[l] } else { 1.0 };
                    inliers[l] += if fits { 1.0 } else { 0.0 };
                }
            }
            start += LANES;
        }
        if sum(&cost) > cost_limit {
            break;
        }
    }
    Support {
        cost: sum(&cost),
        num_inliers: sum(&inliers) as usize,
    }
}

/// Fills `inliers` with the matches within the threshold.
#[inline(always)]
pub(crate) fn inliers(
    model: &impl LaneErrors,
    coordinates: &Coordinates,
    max_error: f64,
    inliers: &mut Vec<usize>,
) {
    let per_threshold_sq = 1.0 / (max_error * max_error);
    // Branch-free: every index is written, and overwritten by the next unless it fits.
    let mut num_inliers = 0;
    inliers.resize(coordinates.len(), 0);
    for start in (0..coordinates.len()).step_by(LANES) {
        let (lanes, count) = coordinates.lanes(start);
        let errors = model.relative_errors(lanes, per_threshold_sq);
        for (l, error) in errors[..count].iter().enumerate() {
            inliers[num_inliers] = start + l;
            num_inliers += usize::from(*error < 1.0);
        }
    }
    inliers.truncate(num_inliers);
}

/// Returns `½ Σ w ρ(e²)` over all matches.
#[inline(always)]
pub(crate) fn cost(model: &impl LaneErrors, coordinates: &Coordinates, loss: &RobustLoss) -> f64 {
    let mut total = [0.0; LANES];
    for start in (0..coordinates.len()).step_by(LANES) {
        let (lanes, count) = coordinates.lanes(start);
        let errors = model.relative_errors(lanes, 1.0);
        weigh(coordinates, start, count, loss, &errors, &mut total);
    }
    0.5 * sum(&total)
}

/// Adds `w ρ(e²)` of eight matches to the totals and returns `w ρ'(e²)`; zeros beyond `count`.
#[inline(always)]
pub(crate) fn weigh(
    coordinates: &Coordinates,
    start: usize,
    count: usize,
    loss: &RobustLoss,
    errors_sq: &Lanes,
    total: &mut Lanes,
) -> Lanes {
    let mut weight = [0.0; LANES];
    match (*loss, coordinates.weights(start)) {
        // The loss of RANSAC, without a branch per match.
        (RobustLoss::Truncated { width }, None) if count == LANES => {
            let width_sq = width * width;
            for l in 0..LANES {
                let far = errors_sq[l] > width_sq;
                total[l] += if far { width_sq } else { errors_sq[l] };
                weight[l] = if far { 0.0 } else { 1.0 };
            }
        }
        (loss, None) => {
            for l in 0..count {
                total[l] += loss.rho(errors_sq[l]);
                weight[l] = loss.weight(errors_sq[l]);
            }
        }
        (loss, Some(weights)) => {
            for l in 0..count {
                total[l] += weights[l] * loss.rho(errors_sq[l]);
                weight[l] = weights[l] * loss.weight(errors_sq[l]);
            }
        }
    }
    weight
}
