//! Rejection of models supported by a single image region.
//!
//! Many wrong matches may share nearly one pixel. A map that sends the whole image there, or an F
//! with its epipole there, fits all of them. A small scale is no sufficient criterion, since a map
//! from pixels to meters has one as well.

use super::Ransac;
use crate::math::order::at_rank;
use crate::robust::Estimator;

/// Constants of the rejection test.
struct Tuning {
    /// Minimum distance of the inliers from their center, in units of their errors (medians).
    /// Concentrated matches have about 1, and somewhat more for F, whose errors have one dimension;
    /// correct models about 100.
    min_spread: f64,
    /// Number of evenly chosen matches in a first, cheap test.
    subset_size: usize,
    /// A subset with more inliers than this is representative if it passes `subset_spread`.
    subset_inliers: usize,
    /// Minimum distance of a subset's inliers from their center, in thresholds.
    subset_spread: f64,
}

const TUNING: Tuning = Tuning {
    min_spread: 3.0,
    subset_size: 48,
    subset_inliers: 10,
    subset_spread: 9.0,
};

impl<E: Estimator> Ransac<E> {
    /// Returns whether the inliers of a model lie in one region, which explains them as well as the
    /// model does.
    ///
    /// The spread is measured in the image of the errors and in the same unit, so maps to meters
    /// are judged like maps to pixels. Errors of one dimension are measured in both images.
    pub(super) fn is_concentrated(&mut self, model: &E::Model) -> bool {
        let problem = self.estimator.problem();
        let Some(matches) = problem.data.matches() else {
            return false;
        };
        let coordinates = matches.coordinates();
        let (in_both, size) = (problem.codimension == 1, problem.sample_size);
        let max_error_sq = self.judge_px * self.judge_px;

        let stride = coordinates[0].len().div_ceil(TUNING.subset_size);
        let few = (0..coordinates[0].len()).step_by(stride.max(1));
        self.inliers.clear();
        self.inliers
            .extend(few.filter(|&i| self.estimator.error_sq(model, i) < max_error_sq));
        if self.inliers.len() > TUNING.subset_inliers {
            let least_sq = spread_sq(&self.inliers, coordinates, in_both, &mut self.values);
            if least_sq > TUNING.subset_spread * TUNING.subset_spread * max_error_sq {
                return false;
            }
        }

        self.estimator
            .inliers(model, self.judge_px, &mut self.inliers);
        if self.inliers.len() <= size {
            return false;
        }
        let least_sq = spread_sq(&self.inliers, coordinates, in_both, &mut self.values);
        let most_sq = least_sq / (TUNING.min_spread * TUNING.min_spread);
        // Errors are at most the threshold.
        most_sq < max_error_sq
            && most_sq
                < median(&self.inliers, &mut self.values, |i| {
                    self.estimator.error_sq(model, i)
                })
    }
}

/// Returns the median squared distance of the inliers from their center: in image 2, or in the
/// image where it is smaller.
fn spread_sq(
    inliers: &[usize],
    [u1, v1, u2, v2]: [&[f64]; 4],
    in_both: bool,
    values: &mut Vec<f64>,
) -> f64 {
    let mut within = |u: &[f64], v: &[f64]| {
        let at_u = median(inliers, values, |i| u[i]);
        let at_v = median(inliers, values, |i| v[i]);
        median(inliers, values, |i| {
            (u[i] - at_u) * (u[i] - at_u) + (v[i] - at_v) * (v[i] - at_v)
        })
    };
    let second = within(u2, v2);
    if in_both {
        second.min(within(u1, v1))
    } else {
        second
    }
}

fn median(inliers: &[usize], values: &mut Vec<f64>, value: impl Fn(usize) -> f64) -> f64 {
    values.clear();
    values.extend(inliers.iter().map(|&i| value(i)));
    at_rank(values, inliers.len() / 2)
}
