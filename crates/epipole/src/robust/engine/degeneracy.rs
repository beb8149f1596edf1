//! Degenerate models: the estimator's alternative to the final model.

use super::{Candidate, Ransac};
use crate::robust::{Estimator, Evidence};

impl<E: Estimator> Ransac<E> {
    /// Replaces the best model by the estimator's alternative, if it has one.
    pub(super) fn resolve_degeneracy(&mut self, best: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&best.model, max_error_px, &mut self.inliers);
        if self.inliers.len() < self.problem().sample_size {
            return;
        }
        let alternative = self.estimator.alternative(
            &best.model,
            Evidence::Inliers(&self.inliers),
            max_error_px,
            &mut self.random,
        );
        if let Some(model) = alternative {
            let support = self.support(&model, f64::INFINITY);
            *best = Candidate { model, support };
            self.refinements += 1;
        }
    }
}
