//! The loop from start to end.

use std::ops::ControlFlow;

use super::{Estimator, Ransac, RansacOptions, RansacReport, Step, Trial};
#[cfg(doc)]
use crate::Error;
use crate::Result;

/// Runs [`Ransac`] to its end.
///
/// # Errors
/// As [`Ransac::new`] and [`Ransac::finish`].
///
/// The example of [`LineEstimator`](super::LineEstimator) calls it.
pub fn ransac<E: Estimator>(
    estimator: E,
    options: &RansacOptions,
) -> Result<RansacReport<E::Model>> {
    ransac_with(estimator, options, |_| ControlFlow::Continue(()))
}

/// Runs [`Ransac`] and shows every trial to `watch`, which may end the run by
/// [`ControlFlow::Break`]; the report is then about the best model so far, and [`Error::Canceled`] says
/// that there is none yet.
///
/// # Errors
/// As [`Ransac::new`] and [`Ransac::finish`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use std::ops::ControlFlow;
/// use epipole::robust::{LineEstimator, RansacOptions, StopReason, ransac_with};
/// use nalgebra::Point2;
/// let points: Vec<_> = (0..10).map(|i| Point2::new(f64::from(i), 2.0)).collect();
/// let report = ransac_with(LineEstimator::new(&points)?, &RansacOptions::default(), |trial| {
///     if trial.iteration == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
/// })?;
/// assert_eq!((report.iterations, report.stop), (3, StopReason::Cancelled));
/// # Ok(()) }
/// ```
pub fn ransac_with<E: Estimator>(
    estimator: E,
    options: &RansacOptions,
    mut watch: impl FnMut(&Trial<'_, E::Model>) -> ControlFlow<()>,
) -> Result<RansacReport<E::Model>> {
    let mut run = Ransac::new(estimator, *options)?;
    while let Step::Trial(trial) = run.step() {
        if watch(&trial).is_break() {
            run.cancel();
        }
    }
    run.finish()
}
