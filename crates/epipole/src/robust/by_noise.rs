//! RANSAC with a threshold estimated from the data.

use super::noise::{Background, noise_scale_px};
use super::to_end::run_to_end;
use super::{Estimator, Ransac, RansacOptions, RansacReport, log10_false_alarms};
use crate::progress::{Monitor, Part};
use crate::{Error, Result};

/// Initial thresholds, pixels. Each leads to those nearby.
const STARTS_PX: [f64; 3] = [2.0, 8.0, 0.5];

/// Maximum number of runs from one initial threshold.
const ROUNDS: usize = 4;

/// Thresholds within this ratio of each other are the same.
const SAME: f64 = 1.15;

/// Minimum threshold, pixels: no image measurement is more accurate, and exact data would give 0.
const LEAST_PX: f64 = 0.05;

/// The threshold is bounded so that at most this fraction of wrong data is within it.
const MAX_PROBABILITY: f64 = 0.1;

/// Multiples of the standard deviation that contain 99 % of the errors, in one dimension and in
/// two.
const QUANTILES: [f64; 2] = [2.576, 3.035];

/// A model, and the threshold that follows from the errors of its inliers.
struct Suited<M> {
    report: RansacReport<M>,
    max_error_px: f64,
    /// Expected number of models with this support by chance, at that threshold.
    log10_false_alarms: f64,
}

/// Runs of the loop at several thresholds.
struct Search<'a> {
    options: &'a RansacOptions,
    background: Background,
    most_px: f64,
    monitor: &'a mut dyn Monitor,
    /// Number of runs so far.
    runs: usize,
    /// Number of samples drawn so far.
    iterations: usize,
}

/// Runs [`ransac`](super::ransac) for [`ThresholdKind::Noise`](super::ThresholdKind::Noise).
///
/// A run at some threshold gives a model, its errors give the noise, and the noise gives the next
/// threshold, until both agree. Of the models from several initial thresholds, the one that is
/// least likely by chance is kept.
pub(super) fn ransac_by_noise<M: Clone>(
    estimator: &mut dyn Estimator<Model = M>,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<M>> {
    options.check()?;
    let background = Background::new(estimator, LEAST_PX, options.max_error_px);
    let mut search = Search {
        options,
        background,
        most_px: background.reach_px(MAX_PROBABILITY).max(LEAST_PX),
        monitor,
        runs: 0,
        iterations: 0,
    };
    let mut best: Option<Suited<M>> = None;
    let mut failure = None;
    for start_px in STARTS_PX {
        let mut max_error_px = start_px.clamp(LEAST_PX, search.most_px);
        let mut model = None;
        for _ in 0..ROUNDS {
            let suited = match search.run(estimator, model, max_error_px)? {
                Ok(report) => search.suited(estimator, report),
                Err(error) => {
                    failure = Some(error);
                    break;
                }
            };
            let before_px = max_error_px;
            max_error_px = suited.max_error_px;
            model = Some(suited.report.model.clone());
            let known = best.as_ref();
            let has_converged = known.is_some_and(|known| same(known.max_error_px, max_error_px))
                || same(before_px, max_error_px);
            if known.is_none_or(|known| suited.log10_false_alarms < known.log10_false_alarms) {
                best = Some(suited);
            }
            if has_converged {
                break;
            }
        }
    }
    let Some(Suited {
        mut report,
        max_error_px,
        ..
    }) = best
    else {
        return Err(failure.unwrap_or(Error::Canceled));
    };
    let last = search.run(estimator, Some(report.model.clone()), max_error_px)?;
    report = last.unwrap_or(report);
    report.iterations = search.iterations;
    Ok(report)
}

fn same(first_px: f64, second_px: f64) -> bool {
    first_px < SAME * second_px && second_px < SAME * first_px
}

impl Search<'_> {
    /// Runs once. The inner error is that of a run without a result.
    ///
    /// # Errors
    /// As [`Ransac::new`]; [`Error::Canceled`] if the monitor cancels.
    fn run<M: Clone>(
        &mut self,
        estimator: &mut dyn Estimator<Model = M>,
        model: Option<M>,
        max_error_px: f64,
    ) -> Result<Result<RansacReport<M>>> {
        let mut run = Ransac::new(estimator, self.options.within(max_error_px))?;
        if let Some(model) = model {
            run.start_from(model);
        }
        // The runs from all initial thresholds, and a last one.
        let most = (STARTS_PX.len() * ROUNDS + 1) as f32;
        let fraction = self.runs as f32 / most;
        self.runs += 1;
        let mut part = Part::new(&mut *self.monitor, fraction, self.runs as f32 / most);
        match run_to_end(run, &mut part) {
            Err(Error::Canceled) => Err(Error::Canceled),
            Ok(report) => {
                self.iterations += report.iterations;
                Ok(Ok(report))
            }
            Err(error) => {
                if let Error::NoConsensus { iterations, .. } = error {
                    self.iterations += iterations;
                }
                Ok(Err(error))
            }
        }
    }

    /// Returns the threshold that suits the model of a run.
    fn suited<M: Clone>(
        &self,
        estimator: &dyn Estimator<Model = M>,
        report: RansacReport<M>,
    ) -> Suited<M> {
        let background = &self.background;
        let model = &report.model;
        let problem = estimator.problem();
        let mut near = Vec::new();
        estimator.inliers(model, self.most_px, &mut near);
        let errors_sq: Vec<f64> = (near.iter())
            .map(|&i| estimator.error_sq(model, i))
            .collect();
        let quantile = QUANTILES[background.codimension() - 1];
        let scale_px = noise_scale_px(
            &errors_sq,
            problem.data.len(),
            background,
            report.max_error_px / quantile,
            LEAST_PX / quantile,
            background.codimension() * problem.sample_size,
        );
        let max_error_px = scale_px.map_or(report.max_error_px, |scale_px| {
            (quantile * scale_px).clamp(LEAST_PX, self.most_px)
        });
        estimator.inliers(model, max_error_px, &mut near);
        let log10_false_alarms = log10_false_alarms(
            problem.data.num_distinct(&near),
            problem.data.len(),
            problem.sample_size,
            problem.max_models,
            background.random_inlier_probability(max_error_px),
        );
        Suited {
            report,
            max_error_px,
            log10_false_alarms,
        }
    }
}
