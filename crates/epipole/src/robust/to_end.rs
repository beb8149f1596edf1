//! Run to the end, with progress reports.

use super::{Estimator, Ransac, RansacReport, Step};
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::progress::{Monitor, Stage, report};

/// Number of samples between two reports.
const SAMPLES_PER_REPORT: usize = 32;

/// Draws samples until the run has finished.
///
/// # Errors
/// [`Error::Canceled`] if the monitor cancels, and as [`Ransac::finish`].
pub(super) fn run_to_end<E: Estimator>(
    mut run: Ransac<E>,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<E::Model>> {
    let mut fraction = 0.0_f32;
    while let Step::Trial(trial) = run.step() {
        if trial.iteration % SAMPLES_PER_REPORT == 1 {
            // A better model can require more samples than the previous one: progress never
            // decreases.
            fraction = fraction.max(run.iterations() as f32 / run.expected_iterations() as f32);
            report(monitor, Stage::RobustEstimation, fraction)?;
        }
    }
    run.finish()
}
