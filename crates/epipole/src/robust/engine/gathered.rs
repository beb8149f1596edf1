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
        let max_error_px = self.judge_px;
        self.estimator
            .inliers(model, max_error_px, &mut self.inliers);
        if self.inliers.len() <= self.estimator.sample_size() {
            return false;
        }
        let middle = self.inliers.len() / 2;
        let values = &mut self.values;
        let mut median = |value: &dyn Fn(usize) -> f64| {
            values.clear();
            values.extend(self.inliers.iter().map(|&i| value(i)));
            at_rank(values, middle)
        };
        let [u1, v1, u2, v2] = matches.coordinates();
        let mut spread_sq = |u: &[f64], v: &[f64]| {
            let (at_u, at_v) = (median(&|i| u[i]), median(&|i| v[i]));
            median(&|i| (u[i] - at_u) * (u[i] - at_u) + (v[i] - at_v) * (v[i] - at_v))
        };
        let mut least_sq = spread_sq(u2, v2);
        if self.estimator.codimension() == 1 {
            least_sq = least_sq.min(spread_sq(u1, v1));
        }
        let most_sq = least_sq / (FAR_APART * FAR_APART);
        // Errors are at most the threshold: nearly always that is all there is to ask.
        most_sq < max_error_px * max_error_px
            && most_sq < median(&|i| self.estimator.error_sq(model, i))
    }
}
