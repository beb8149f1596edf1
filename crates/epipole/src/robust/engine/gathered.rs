//! Models that say no more than one place would: many wrong matches may lead to nearly the same pixel, and a map that
//! takes the whole image there, or an F with its epipole there, fits all of them. Scale alone would not tell: a map from
//! pixels to meters has a small one, too.

use super::Ransac;
use crate::math::order::at_rank;
use crate::robust::Estimator;

/// Inliers must be so many times as far from their middle as they are from the model: both are medians, so a few
/// that are elsewhere do not matter. Matches at one place have about 1, and somewhat more for F, whose errors have one
/// dimension and are shared by both images; those of an honest model a hundred.
const FAR_APART: f64 = 3.0;

/// So many matches, evenly chosen, are looked at first.
const A_FEW: usize = 48;
/// More inliers than this among them tell what all would,
const FEWEST: usize = 10;
/// if they are so many thresholds from their middle: of gathered ones all are nearer than [`FAR_APART`].
const SURELY: f64 = 3.0 * FAR_APART;

impl<E: Estimator> Ransac<E> {
    /// Whether the inliers of a model are gathered at one place, which explains them as well as the model does.
    ///
    /// It is the spread in the image where errors are measured that is compared with them, in the same unit; so maps to
    /// meters are judged as those to pixels are. Errors of one dimension are measured in both images. Pixels that are
    /// exactly equal have few votes anyway.
    pub(super) fn is_gathered(&mut self, model: &E::Model) -> bool {
        let Some(matches) = self.estimator.matches() else {
            return false;
        };
        let coordinates = matches.coordinates();
        let in_both = self.estimator.codimension() == 1;
        let max_error_sq = self.judge_px * self.judge_px;

        // A few of them nearly always tell, at a fraction of the cost.
        let stride = coordinates[0].len().div_ceil(A_FEW);
        let few = (0..coordinates[0].len()).step_by(stride.max(1));
        self.inliers.clear();
        self.inliers
            .extend(few.filter(|&i| self.estimator.error_sq(model, i) < max_error_sq));
        if self.inliers.len() > FEWEST {
            let least_sq = spread_sq(&self.inliers, coordinates, in_both, &mut self.values);
            if least_sq > SURELY * SURELY * max_error_sq {
                return false;
            }
        }

        self.estimator
            .inliers(model, self.judge_px, &mut self.inliers);
        if self.inliers.len() <= self.estimator.sample_size() {
            return false;
        }
        let least_sq = spread_sq(&self.inliers, coordinates, in_both, &mut self.values);
        let most_sq = least_sq / (FAR_APART * FAR_APART);
        // Errors are at most the threshold.
        most_sq < max_error_sq
            && most_sq
                < median(&self.inliers, &mut self.values, |i| {
                    self.estimator.error_sq(model, i)
                })
    }
}

/// The median square of the inliers' distances from their middle: in image 2, or in the image where it is less.
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
