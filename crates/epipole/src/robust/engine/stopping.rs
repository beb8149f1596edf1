//! Required number of samples.

use super::{Candidate, Ransac};
use crate::robust::budget::{all_inlier_probability, ratio_to_the, trials};
use crate::robust::false_alarms::{UNKNOWN_PROBABILITY, log10_false_alarms};
use crate::robust::options::MAX_LOG10_FALSE_ALARMS;
use crate::robust::{Budget, Estimator, StopReason};

impl<E: Estimator> Ransac<E> {
    /// Updates the number of samples that the new best model requires.
    ///
    /// For data sorted by quality, the best data suffice as soon as an all-inlier sample from them
    /// is as likely as required. This holds for any prefix of the data in which the model has more
    /// inliers than expected by chance; samples are then drawn only from the prefix that needs the
    /// fewest.
    ///
    /// Source: Chum & Matas 2005, "Matching with PROSAC", §2.2 (maximality and non-randomness).
    pub(super) fn require(&mut self, best: &Candidate<E::Model>) {
        let problem = self.estimator.problem();
        let (num_data, size, max_models) =
            (problem.data.len(), problem.sample_size, problem.max_models);
        self.required = self.required_for(best.support.num_inliers, num_data);
        if !self.sampler.is_ordered() {
            return;
        }
        let max_error_px = self.options.max_error_px;
        let random_inlier_probability = self
            .random_inlier_probability
            .unwrap_or(UNKNOWN_PROBABILITY);
        self.estimator
            .inliers(&best.model, max_error_px, &mut self.inliers);
        let mut limit = num_data;
        for (place, index) in self.inliers.iter().enumerate() {
            let (num_inliers, front) = (place + 1, index + 1);
            let required = self.required_for(num_inliers, front);
            if required < self.required
                && log10_false_alarms(
                    num_inliers,
                    front,
                    size,
                    max_models,
                    random_inlier_probability,
                ) < MAX_LOG10_FALSE_ALARMS
            {
                self.required = required;
                limit = front;
            }
        }
        self.sampler.keep_to(limit);
    }

    pub(super) fn required_for(&self, num_inliers: usize, num_data: usize) -> u64 {
        let size = self.problem().sample_size;
        let probability = match self.options.budget {
            Budget::WithReplacement => ratio_to_the(num_inliers as f64 / num_data as f64, size),
            Budget::WithoutReplacement => all_inlier_probability(num_inliers, num_data, size),
        };
        trials(probability, self.log_miss)
    }

    pub(super) fn update_stop(&mut self) {
        let iterations = self.iterations as u64;
        let least = self.options.min_iterations.min(self.options.max_iterations);
        if self.iterations >= least && iterations >= self.required {
            self.stop = Some(StopReason::Confident);
        } else if self.iterations >= self.options.max_iterations {
            self.stop = Some(StopReason::Exhausted);
        }
    }
}
