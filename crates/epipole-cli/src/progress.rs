//! Progress bars on standard error.

use crate::context::Context;
use crate::interrupt;
use epipole::progress::Status;
use indicatif::{ProgressBar, ProgressStyle};
use std::ops::ControlFlow;

const STEPS: u64 = 1000;

/// Progress bar; hidden under `--quiet` and if standard error is not a terminal.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    pub(crate) fn new(context: &Context, label: &str) -> Self {
        if context.quiet {
            return Self(ProgressBar::hidden());
        }
        let style = ProgressStyle::with_template("{msg} {wide_bar} {percent}%");
        let bar = ProgressBar::new(STEPS).with_message(label.to_owned());
        // The template is a constant, so the error cannot occur.
        if let Ok(style) = style {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Shows the completed fraction, 0 to 1.
    pub(crate) fn set(&self, fraction: f64) {
        self.0
            .set_position((fraction.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }

    /// Shows the progress and the stage of a function of the core, and lets Ctrl-C end it.
    pub(crate) fn show(&self, status: Status) -> ControlFlow<()> {
        self.0.set_message(status.stage.words());
        self.set(f64::from(status.fraction));
        interrupt::watch(status)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
