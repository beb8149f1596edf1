//! Command-line options of robust estimation, and runs with progress that Ctrl-C ends.

use crate::context::Context;
use crate::failure::Failure;
use crate::interrupt;
use crate::progress::Progress;
use clap::{ArgAction, Args, ValueEnum};
use epipole::Error;
use epipole::progress::{Monitor, Stage};
use epipole::robust::{
    Budget, Estimator, Ransac, RansacOptions, RansacReport, SamplerKind, ScoreKind, Step,
    StopReason, ThresholdKind, ransac,
};
use std::fmt;

/// Number of samples between updates of the progress bar.
const SAMPLES_PER_LOOK: usize = 64;

/// Sampling strategy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Sampler {
    /// All data with equal probability.
    Uniform,
    /// The best data first: matches of images are sorted, and rows of a file should be.
    Prosac,
}

/// Maximum error of an inlier (pixels; "auto" finds it from the noise of the matches).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum MaxError {
    Pixels(f64),
    /// Estimated from the noise of the data.
    Auto,
}

impl fmt::Display for MaxError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pixels(pixels) => write!(f, "{pixels}"),
            Self::Auto => f.write_str(AUTO),
        }
    }
}

/// Command-line value of an estimated threshold.
const AUTO: &str = "auto";

/// Scoring function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Score {
    /// Squared errors of the inliers.
    Msac,
    /// Number of inliers.
    Inliers,
}

/// Formula for the required number of samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum BudgetFormula {
    /// Sampling without replacement, as samples are drawn.
    WithoutReplacement,
    /// The textbook formula: sampling with replacement.
    WithReplacement,
}

/// Options of robust estimation, shared by all commands.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Inliers")]
pub(crate) struct RobustArguments {
    /// Maximum error of an inlier (pixels; "auto" finds it from the noise of the matches).
    #[arg(long, default_value_t = MaxError::Pixels(RansacOptions::default().max_error_px), value_name = "PX|auto", value_parser = max_error)]
    max_error_px: MaxError,
    /// Probability that at least one sample is free of outliers.
    #[arg(long, default_value_t = RansacOptions::default().confidence, value_name = "P", value_parser = confidence)]
    confidence: f64,
    /// Maximum number of samples.
    #[arg(long, default_value_t = RansacOptions::default().max_iterations as u32, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    max_iterations: u32,
    /// Minimum number of samples.
    #[arg(long, default_value_t = RansacOptions::default().min_iterations as u32, value_name = "N")]
    min_iterations: u32,
    /// Sampling strategy.
    #[arg(long, value_enum, default_value = "uniform")]
    sampler: Sampler,
    /// Scoring function.
    #[arg(long, value_enum, default_value = "msac")]
    score: Score,
    /// Formula for the required number of samples.
    #[arg(long, value_enum, default_value = "without-replacement")]
    budget: BudgetFormula,
    /// Improve promising models from their inliers; --local-optimization=false for plain RANSAC.
    #[arg(long, action = ArgAction::Set, num_args = 0..=1, require_equals = true, default_value_t = true, default_missing_value = "true")]
    local_optimization: bool,
    /// Number of rounds of local optimization.
    #[arg(long, default_value_t = RansacOptions::default().inner_iterations as u32, value_name = "N")]
    inner_iterations: u32,
}

fn confidence(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value < 1.0 => Ok(value),
        _ => Err(format!("\"{text}\" is not a number between 0 and 1")),
    }
}

/// Default threshold of commands on photos: `epipole::two_view::PHOTO_MAX_ERROR_PX` as text, for
/// clap.
pub(crate) const PHOTO_MAX_ERROR: &str = "2";

fn max_error(text: &str) -> Result<MaxError, String> {
    if text == AUTO {
        return Ok(MaxError::Auto);
    }
    threshold(text).map(MaxError::Pixels)
}

/// Reads a threshold. Errors are compared with its square, which must be above zero too.
fn threshold(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value * value > 0.0 && (value * value).is_finite() => Ok(value),
        Ok(value) if value > 0.0 && value.is_finite() => {
            Err(format!("\"{text}\" is beyond what can be squared"))
        }
        _ => Err(format!("\"{text}\" is neither a number above 0 nor {AUTO}")),
    }
}

/// Describes a threshold in words.
pub(crate) fn threshold_words(options: &RansacOptions, max_error_px: f64) -> String {
    match options.threshold {
        ThresholdKind::Given => format!("{max_error_px} px"),
        ThresholdKind::Noise => format!("{max_error_px:.3} px, found from the noise"),
    }
}

impl RobustArguments {
    /// Returns the options of the core.
    pub(crate) fn options(&self, context: &Context) -> RansacOptions {
        let default = RansacOptions::default();
        let (max_error_px, threshold) = match self.max_error_px {
            MaxError::Pixels(pixels) => (pixels, ThresholdKind::Given),
            MaxError::Auto => (default.max_error_px, ThresholdKind::Noise),
        };
        default
            .with_max_error_px(max_error_px)
            .with_threshold(threshold)
            .with_confidence(self.confidence)
            .with_min_iterations(self.min_iterations as usize)
            .with_max_iterations(self.max_iterations as usize)
            .with_seed(context.seed)
            .with_sampler(match self.sampler {
                Sampler::Uniform => SamplerKind::Uniform,
                Sampler::Prosac => SamplerKind::Prosac,
            })
            .with_score(match self.score {
                Score::Msac => ScoreKind::Msac,
                Score::Inliers => ScoreKind::InlierCount,
            })
            .with_budget(match self.budget {
                BudgetFormula::WithoutReplacement => Budget::WithoutReplacement,
                BudgetFormula::WithReplacement => Budget::WithReplacement,
            })
            .with_local_optimization(self.local_optimization)
            .with_inner_iterations(self.inner_iterations as usize)
    }

    /// Runs RANSAC. After Ctrl-C returns the best model so far, if the threshold is given. Warns of
    /// a model that is not significant or not verified.
    ///
    /// # Errors
    /// As [`ransac`].
    pub(crate) fn run<E: Estimator>(
        &self,
        estimator: E,
        context: &Context,
    ) -> Result<RansacReport<E::Model>, Failure> {
        let options = self.options(context);
        if options.threshold == ThresholdKind::Noise {
            return self.watched(context, |options, monitor| {
                ransac(estimator, options, monitor)
            });
        }
        let (name, sample_size) = (estimator.problem().name, estimator.problem().sample_size);
        let mut run = Ransac::new(estimator, options)?;
        let progress = Progress::new(context, Stage::RobustEstimation.words());
        let mut is_interrupted = false;
        while let Step::Trial(trial) = run.step() {
            if trial.iteration.is_multiple_of(SAMPLES_PER_LOOK) {
                progress.set(trial.iteration as f64 / run.expected_iterations() as f64);
            }
            if interrupt::requested() {
                is_interrupted = true;
                break;
            }
        }
        drop(progress);
        let report = match run.finish() {
            // No sample has yielded a model yet.
            Err(Error::NoConsensus { .. }) if is_interrupted => Err(Error::Canceled),
            finished => finished,
        }?;
        // A minimal set picked by hand needs no test of significance.
        let is_minimal = report.num_unique_inliers == sample_size;
        if is_minimal && report.num_inliers == report.inliers.len() {
            context.warn(&format!(
                "{name} fits any {sample_size} data exactly, and these are all: nothing verifies it"
            ));
        } else {
            self.warn(&report, context);
        }
        Ok(report)
    }

    /// Runs a function that calls RANSAC itself; Ctrl-C cancels it.
    pub(crate) fn watched<M>(
        &self,
        context: &Context,
        run: impl FnOnce(&RansacOptions, &mut dyn Monitor) -> epipole::Result<RansacReport<M>>,
    ) -> Result<RansacReport<M>, Failure> {
        let progress = Progress::new(context, Stage::RobustEstimation.words());
        let report = run(&self.options(context), &mut |status| progress.show(status))?;
        drop(progress);
        self.warn(&report, context);
        Ok(report)
    }

    /// Warns of a run that stopped below the confidence, and of a model that is not significant.
    pub(crate) fn warn<M>(&self, report: &RansacReport<M>, context: &Context) {
        let (drawn, required) = (report.iterations, report.required_iterations);
        self.warn_of_stop(report.stop, drawn, required, context);
        if report.could_be_random() {
            context.warn(&format!(
                "the model is not significant: {} inliers are no more than random data would have",
                report.num_unique_inliers
            ));
        }
    }

    /// Warns of a run that stopped early, from the numbers of samples drawn and required.
    pub(crate) fn warn_of_stop(
        &self,
        stop: StopReason,
        drawn: usize,
        required: u64,
        context: &Context,
    ) {
        match stop {
            StopReason::Interrupted => context.warn(interrupt::ENDED_EARLY),
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

/// Returns the reason for the end of a run, as a word for scripts.
pub(crate) fn stop_word(stop: StopReason) -> &'static str {
    match stop {
        StopReason::Confident => "confident",
        StopReason::Exhausted => "exhausted",
        StopReason::Interrupted => "canceled",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_threshold_of_photos_is_that_of_the_core() {
        let parsed: f64 = PHOTO_MAX_ERROR.parse().expect("a number");
        assert_eq!(parsed, epipole::two_view::PHOTO_MAX_ERROR_PX);
    }

    #[test]
    fn thresholds_are_numbers_that_can_be_squared() {
        for (text, expected) in [("1", 1.0), ("0.25", 0.25), ("1e100", 1e100)] {
            assert_eq!(max_error(text), Ok(MaxError::Pixels(expected)));
        }
        assert_eq!(max_error("auto"), Ok(MaxError::Auto));
        assert_eq!(MaxError::Auto.to_string(), "auto");
        for text in ["0", "-1", "nan", "inf", "", "1e300", "1e-300"] {
            let sentence = max_error(text).expect_err(text);
            assert!(sentence.len() < 60, "{sentence}");
        }
    }
}
