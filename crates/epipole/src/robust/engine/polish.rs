//! Final refinement: weighted least squares over all inliers.

use super::{Candidate, Ransac};
use crate::math::order::at_rank;
use crate::robust::{Estimator, ScoreKind};

/// Constants of the refinement.
struct Tuning {
    /// Width of Welsch's loss in medians of the errors, for one dimension (three standard
    /// deviations) and two. Tuned by cross-validation over classes of image pairs; nearly every
    /// class gains when it is held out.
    width_medians: [f64; 2],
    /// Maximum width in thresholds, for errors that fill the threshold.
    width_thresholds: f64,
    /// Number of reweightings. More would discard the few data points that determine otherwise weak
    /// parameters.
    reweightings: usize,
    /// Number of reweightings that update the width. Afterwards it is fixed, since weights and
    /// width would narrow each other.
    width_updates: usize,
    /// Minimum fraction of inliers to keep, as numerator and denominator, under the MSAC score.
    confirmed: [usize; 2],
}

const TUNING: Tuning = Tuning {
    width_medians: [4.5, 4.0],
    width_thresholds: 2.0,
    reweightings: 8,
    width_updates: 5,
    confirmed: [19, 20],
};

impl<E: Estimator> Ransac<E> {
    /// Refines the best model by least squares over all data within a few times the errors of the
    /// inliers, with Welsch's weights. They differ from the score, so the result is rejected if it
    /// loses inliers: more than one in twenty, or any if the score counts inliers.
    ///
    /// Source: Holland & Welsch 1977, "Robust regression using iteratively reweighted
    /// least-squares" (Welsch's weights).
    pub(super) fn polish(&mut self, candidate: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&candidate.model, max_error_px, &mut self.inliers);
        if self.inliers.len() < self.problem().sample_size {
            return;
        }
        let mut model = candidate.model.clone();
        // Squared errors are replaced by weights in place.
        let mut weights = Vec::with_capacity(self.problem().data.len());
        let mut width_px = 0.0;
        let medians = TUNING.width_medians[self.codimension_index()];
        for round in 0..TUNING.reweightings {
            if round < TUNING.width_updates {
                self.estimator
                    .inliers(&model, max_error_px, &mut self.inliers);
                if self.inliers.is_empty() {
                    break;
                }
                let most_px = TUNING.width_thresholds * max_error_px;
                self.errors_sq(&model, &mut weights);
                width_px = self.medians_px(&mut weights, medians, most_px);
            }
            let reach_px = max_error_px.max(2.0 * width_px);
            self.estimator.inliers(&model, reach_px, &mut self.inliers);
            self.errors_sq(&model, &mut weights);
            for weight in &mut weights {
                *weight = libm::exp(-*weight / (width_px * width_px));
            }
            let Some(polished) = self.estimator.polish(&model, &self.inliers, &weights) else {
                break;
            };
            model = polished;
        }
        let support = self.support(&model, f64::INFINITY);
        let [confirmed, of] = match self.options.score {
            ScoreKind::Msac => TUNING.confirmed,
            ScoreKind::InlierCount => [1, 1],
        };
        let keeps = of * support.num_inliers >= confirmed * candidate.support.num_inliers;
        if keeps && !self.is_concentrated(&model) {
            *candidate = Candidate { model, support };
            self.refinements += 1;
        }
    }

    /// Returns the index for constants by dimension of the errors.
    pub(super) fn codimension_index(&self) -> usize {
        self.problem().codimension.clamp(1, 2) - 1
    }

    /// Fills `errors_sq` with the squared errors of the data in `inliers`.
    pub(super) fn errors_sq(&self, model: &E::Model, errors_sq: &mut Vec<f64>) {
        errors_sq.clear();
        let error_sq = |&index: &usize| self.estimator.error_sq(model, index);
        errors_sq.extend(self.inliers.iter().map(error_sq));
    }

    /// Returns the scale of the inliers' errors: a multiple of their median, between a quarter of
    /// the threshold and `most_px`. The threshold is a guess; errors a tenth as large need a
    /// sharper weight, and errors that fill it a wider one.
    ///
    /// * `errors_sq`: squared errors, at least one; reordered
    pub(super) fn medians_px(&self, errors_sq: &mut [f64], medians: f64, most_px: f64) -> f64 {
        let median_sq = at_rank(errors_sq, errors_sq.len() / 2);
        let least_px = 0.25 * self.options.max_error_px;
        (medians * median_sq.sqrt()).clamp(least_px, most_px)
    }
}
