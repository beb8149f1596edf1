//! Search for a better optimum near the best model.

use super::{Candidate, Ransac};
use crate::robust::{Estimator, ScoreKind};

/// Constants of the search.
struct Tuning {
    /// Maximum number of restarts around the best model.
    restarts: usize,
    /// Number of consecutive unsuccessful restarts that ends the search, if errors fill the
    /// threshold and a wider search follows. On photos and synthetic planes 10 do as well as all, 6
    /// do worse.
    patience: usize,
    /// Restarts fit data within this many thresholds of the best model, as data outside one
    /// threshold could be inliers of another model.
    reach: f64,
    /// Minimum number of restarts that return to the model before the search ends early.
    returns: usize,
    /// Minimum number of inliers in all of them: few data points leave room for several optima.
    returned_inliers: usize,
    /// Restarts whose first fit costs this much more than the best model (relative) are abandoned.
    far_off: f64,
    /// Costs within this relative difference, or this fraction of one data point, mean the same
    /// optimum.
    same: f64,
    /// Models are compared within this many medians of the inliers' errors: two standard
    /// deviations, for Gaussian errors of one dimension.
    sharp_medians: f64,
    /// Upper bounds of `sharp_medians`, in thresholds, for each search in turn, for errors of one
    /// dimension and of two. Two homographies whose errors fill the threshold differ only beyond
    /// it, but a wide search alone would leave a sharp optimum.
    sharp_thresholds: [&'static [f64]; 2],
}

const TUNING: Tuning = Tuning {
    restarts: 30,
    patience: 10,
    reach: 3.0,
    returns: 3,
    returned_inliers: 3000,
    far_off: 0.1,
    same: 2e-3,
    sharp_medians: 3.0,
    sharp_thresholds: [&[1.0], &[1.0, 2.0]],
};

impl<E: Estimator> Ransac<E> {
    /// Searches for a better optimum nearby, within the actual errors of the inliers: a threshold
    /// far above them admits outliers and cannot separate models by their fit to the correct data.
    pub(super) fn search_neighborhood(&mut self, best: &mut Candidate<E::Model>) {
        let max_error_px = self.options.max_error_px;
        let mut explored = true;
        let mut errors_sq = Vec::with_capacity(self.problem().data.len());
        let looks = TUNING.sharp_thresholds[self.codimension_index()];
        for (look, &most) in looks.iter().enumerate() {
            self.estimator
                .inliers(&best.model, max_error_px, &mut self.inliers);
            if self.inliers.is_empty() {
                break;
            }
            let mut patience = TUNING.restarts;
            // An inlier count refers to the threshold of the caller.
            if self.options.score == ScoreKind::Msac {
                let most_px = most * max_error_px;
                self.errors_sq(&best.model, &mut errors_sq);
                self.judge_px = self.medians_px(&mut errors_sq, TUNING.sharp_medians, most_px);
                if self.judge_px == most_px && look + 1 < looks.len() {
                    patience = TUNING.patience;
                }
            }
            best.support = self.support(&best.model, f64::INFINITY);
            explored = self.explore(best, patience);
        }
        self.judge_px = max_error_px;
        best.support = self.support(&best.model, f64::INFINITY);
        if !explored {
            self.improve(best);
        }
    }

    /// Restarts from least-squares fits to a few of the nearest data; local optimization leads back
    /// or elsewhere. Ends early if several lead back, or `patience` in a row find nothing better.
    /// Returns false if there are too few data nearby, or the estimator has no least-squares fit.
    ///
    /// Source: Chum, Matas & Kittler 2003, "Locally optimized RANSAC" (inner sampling).
    fn explore(&mut self, best: &mut Candidate<E::Model>, patience: usize) -> bool {
        let max_error_px = self.judge_px;
        let size = 2 * self.problem().sample_size;
        let mut subset = Vec::with_capacity(size);
        let alike = vec![1.0; size];
        let reach_px = TUNING.reach * max_error_px;
        let needed = (TUNING.returned_inliers / best.support.num_inliers.max(1))
            .clamp(TUNING.returns, TUNING.restarts);
        let (mut returns, mut in_vain) = (0, 0);
        let mut around = Vec::with_capacity(self.problem().data.len());
        let mut moved = true;
        for _ in 0..TUNING.restarts {
            if returns == needed || in_vain == patience {
                break;
            }
            in_vain += 1;
            if moved {
                self.estimator.inliers(&best.model, reach_px, &mut around);
                moved = false;
            }
            if around.len() <= size {
                return false;
            }
            subset.clear();
            while subset.len() < size {
                let index = around[self.random.below(around.len())];
                if !subset.contains(&index) {
                    subset.push(index);
                }
            }
            let Some(start) = self.estimator.polish(&best.model, &subset, &alike) else {
                return false;
            };
            let Some(first) = self.fitted(&start, max_error_px) else {
                continue;
            };
            let known = best.support.cost;
            let leads_back = |cost: f64| (cost - known).abs() < TUNING.same * known.max(1.0);
            let cost = self.support(&first, (1.0 + TUNING.far_off) * known).cost;
            if cost > (1.0 + TUNING.far_off) * known {
                continue;
            }
            let mut back = leads_back(cost);
            if !back && let Some(model) = self.fitted(&first, max_error_px) {
                back = leads_back(self.support(&model, (1.0 + TUNING.same) * known).cost);
                if !back && self.replace_if_better(best, model) {
                    self.improve(best);
                    moved = true;
                    in_vain = 0;
                }
            }
            returns += usize::from(back);
        }
        true
    }
}
