//! The options of robust estimation that commands share, and runs that can be watched and ended.

use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;
use clap::{Args, ValueEnum};
use epipole::robust::{
    Estimator, RansacOptions, RansacReport, SamplerKind, StopReason, Trial, ransac_with,
};
use std::ops::ControlFlow;

/// The bar moves once in so many samples: looking more often would cost more than small samples do.
const SAMPLES_A_LOOK: usize = 64;

/// How samples are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Sampler {
    /// All data alike.
    Uniform,
    /// The best data first, as matches from photographs are ordered and rows of a file should be.
    Prosac,
}

/// How to tell good data from bad.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct RobustArguments {
    /// The largest error of an inlier, pixels.
    #[arg(long, default_value_t = 1.0, value_name = "PX", value_parser = threshold)]
    pub(crate) max_error_px: f64,
    /// The probability that one sample at least is free of outliers.
    #[arg(long, default_value_t = 0.999, value_name = "P", value_parser = confidence)]
    pub(crate) confidence: f64,
    /// Samples drawn at most.
    #[arg(long, default_value_t = 10_000, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_iterations: u32,
    /// How samples are drawn.
    #[arg(long, value_enum, default_value = "uniform")]
    pub(crate) sampler: Sampler,
}

fn confidence(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value < 1.0 => Ok(value),
        _ => Err(format!("\"{text}\" is not a number between 0 and 1")),
    }
}

/// Errors are compared with the threshold squared, so the square must be a number above zero, too.
fn threshold(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value * value > 0.0 && (value * value).is_finite() => Ok(value),
        Ok(value) if value > 0.0 && value.is_finite() => {
            Err(format!("\"{text}\" is beyond what can be squared"))
        }
        _ => Err(format!("\"{text}\" is not a number above 0")),
    }
}

impl RobustArguments {
    pub(crate) fn options(&self, context: &Context) -> RansacOptions {
        RansacOptions {
            max_error_px: self.max_error_px,
            confidence: self.confidence,
            max_iterations: self.max_iterations as usize,
            seed: context.seed,
            sampler: match self.sampler {
                Sampler::Uniform => SamplerKind::Uniform,
                Sampler::Prosac => SamplerKind::Prosac,
            },
            ..RansacOptions::default()
        }
    }

    /// Runs RANSAC to its end, or until Ctrl-C asks for the best model so far.
    ///
    /// # Errors
    /// As [`ransac_with`].
    pub(crate) fn run<E: Estimator>(
        &self,
        estimator: E,
        context: &Context,
    ) -> Result<RansacReport<E::Model>, Failure> {
        self.watched(context, |options, watch| {
            ransac_with(estimator, options, watch)
        })
    }

    /// The same for a function that runs RANSAC itself and shows its trials.
    pub(crate) fn watched<M>(
        &self,
        context: &Context,
        run: impl FnOnce(
            &RansacOptions,
            &mut dyn FnMut(&Trial<'_, M>) -> ControlFlow<()>,
        ) -> epipole::Result<RansacReport<M>>,
    ) -> Result<RansacReport<M>, Failure> {
        let mut look = self.look(context);
        let report = run(&self.options(context), &mut |trial| {
            look(trial.iteration, trial.required_iterations)
        })?;
        drop(look);
        self.warn(&report, context);
        Ok(report)
    }

    /// What watches samples: a bar moves with their number, counted from 1, towards the number
    /// required, and Ctrl-C breaks.
    pub(crate) fn look(
        &self,
        context: &Context,
    ) -> impl FnMut(usize, u64) -> ControlFlow<()> + use<> {
        let options = self.options(context);
        let progress = Progress::new(context, "drawing samples");
        move |iteration, required_iterations| {
            if iteration.is_multiple_of(SAMPLES_A_LOOK) {
                let most = options.max_iterations;
                let required = usize::try_from(required_iterations).unwrap_or(most);
                let expected = required.max(options.min_iterations).min(most);
                progress.set(iteration as f64 / expected as f64);
            }
            if interrupt::requested() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        }
    }

    /// Tells of a run that ended before it could be confident.
    pub(crate) fn warn<M>(&self, report: &RansacReport<M>, context: &Context) {
        let (drawn, required) = (report.iterations, report.required_iterations);
        self.warn_of_stop(report.stop, drawn, required, context);
        if report.could_be_chance() {
            context.warn(&format!(
                "the model means nothing: {} inliers are no more than wrong data would show by chance",
                report.num_unique_inliers
            ));
        }
    }

    /// The same of its numbers alone: samples drawn, and samples that the best model asks for.
    pub(crate) fn warn_of_stop(
        &self,
        stop: StopReason,
        drawn: usize,
        required: u64,
        context: &Context,
    ) {
        match stop {
            StopReason::Canceled => context.warn(interrupt::ENDED_EARLY),
            // The last refinement may find enough inliers after all.
            StopReason::Exhausted if required > drawn as u64 => {
                let needed = match required {
                    u64::MAX => "no number of samples is enough".to_owned(),
                    required => format!("{required} samples are needed"),
                };
                context.warn(&format!(
                    "ended by --max-iterations {drawn}: with so few inliers {needed} for a \
                     confidence of {}",
                    self.confidence
                ));
            }
            StopReason::Exhausted | StopReason::Confident => {}
        }
    }
}

/// Why a run ended, as a word for scripts.
pub(crate) fn stop_word(stop: StopReason) -> &'static str {
    match stop {
        StopReason::Confident => "confident",
        StopReason::Exhausted => "exhausted",
        StopReason::Canceled => "canceled",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_numbers_that_can_be_squared() {
        for (text, expected) in [("1", 1.0), ("0.25", 0.25), ("1e100", 1e100)] {
            assert_eq!(threshold(text), Ok(expected));
        }
        for text in ["0", "-1", "nan", "inf", "", "1e300", "1e-300"] {
            let sentence = threshold(text).expect_err(text);
            assert!(sentence.len() < 60, "{sentence}");
        }
    }
}
