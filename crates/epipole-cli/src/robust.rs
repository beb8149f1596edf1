//! The options of robust estimation that commands share.

use crate::context::Context;
use crate::matrices::positive;
use clap::Args;
use epipole::robust::RansacOptions;

/// How to tell good data from bad.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct RobustArguments {
    /// The largest error of an inlier, pixels.
    #[arg(long, default_value_t = 1.0, value_name = "PX", value_parser = positive)]
    pub(crate) max_error_px: f64,
    /// The probability that one sample at least is free of outliers.
    #[arg(long, default_value_t = 0.999, value_name = "P", value_parser = confidence)]
    pub(crate) confidence: f64,
    /// Samples drawn at most.
    #[arg(long, default_value_t = 10_000, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_iterations: u32,
}

fn confidence(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value < 1.0 => Ok(value),
        _ => Err(format!("\"{text}\" is not a number between 0 and 1")),
    }
}

impl RobustArguments {
    pub(crate) fn options(&self, context: &Context) -> RansacOptions {
        RansacOptions {
            max_error_px: self.max_error_px,
            confidence: self.confidence,
            max_iterations: self.max_iterations as usize,
            seed: context.seed,
            ..RansacOptions::default()
        }
    }
}
