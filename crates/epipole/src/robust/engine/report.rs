//! Report of a run.

use super::Ransac;
use crate::robust::false_alarms::log10_false_alarms;
use crate::robust::{Estimator, RansacReport, StopReason, Unique};
use crate::{Error, Result};

impl<E: Estimator> Ransac<E> {
    /// Body of [`finish`](Ransac::finish).
    pub(super) fn conclude(&mut self) -> Result<RansacReport<E::Model>> {
        let problem = self.problem();
        let (size, num_data, max_models) =
            (problem.sample_size, problem.data.len(), problem.max_models);
        let no_consensus = Error::NoConsensus {
            needed: size,
            got: num_data,
            iterations: self.iterations,
        };
        let Some(mut best) = self.best.take() else {
            return Err(no_consensus);
        };
        if self.options.local_optimization {
            self.search_neighborhood(&mut best);
            self.resolve_degeneracy(&mut best);
            self.polish(&mut best);
        }
        let max_error_px = self.options.max_error_px;
        self.estimator
            .inliers(&best.model, max_error_px, &mut self.inliers);
        let num_distinct = self.problem().data.num_distinct(&self.inliers);
        if num_distinct < size {
            return Err(no_consensus);
        }
        if !self.sampler.is_ordered() {
            self.required = self.required_for(self.inliers.len(), num_data);
        }
        let log10_false_alarms = self
            .random_inlier_probability
            .map(|random_inlier_probability| {
                log10_false_alarms(
                    num_distinct,
                    num_data,
                    size,
                    max_models,
                    random_inlier_probability,
                )
            });
        let mut fits = vec![false; num_data];
        for &index in &self.inliers {
            fits[index] = true;
        }
        let unique = self.problem().data.unique();
        let inliers: Vec<bool> = match unique {
            Some(unique) => (unique.places().iter())
                .map(|place| place.is_some_and(|i| fits[i]))
                .collect(),
            None => fits,
        };
        Ok(RansacReport {
            num_inliers: inliers.iter().filter(|&&inlier| inlier).count(),
            num_unique_inliers: num_distinct,
            num_left_out: unique.map_or(0, Unique::num_left_out),
            inliers,
            iterations: self.iterations,
            required_iterations: self.required,
            max_error_px,
            score: self.score(&best.support),
            log10_false_alarms,
            refinements: self.refinements,
            stop: self.stop.unwrap_or(StopReason::Interrupted),
            model: best.model,
        })
    }
}
