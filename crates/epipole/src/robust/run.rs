//! The loop from start to end.

use std::ops::ControlFlow;

use super::by_noise::ransac_by_noise;
use super::{Estimator, Ransac, RansacOptions, RansacReport, Step, ThresholdKind, Trial};
#[cfg(doc)]
use crate::Error;
use crate::Result;

/// Hears of every trial and may end the run.
pub(super) type Watch<'a, M> = &'a mut dyn FnMut(&Trial<'_, M>) -> ControlFlow<()>;

/// Runs [`Ransac`] to its end.
///
/// # Errors
/// As [`Ransac::new`] and [`Ransac::finish`].
///
/// The example of [`LineEstimator`](super::LineEstimator) calls it.
///
/// Source: as [`Ransac`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::{LineEstimator, RansacOptions, ransac};
/// use nalgebra::Point2;
/// // Twenty points of the row v = 2, and four that are elsewhere.
/// let mut points: Vec<_> = (0..20).map(|i| Point2::new(f64::from(i) * 5.0, 2.0)).collect();
/// points.extend([(3.0, 40.0), (17.0, 90.0), (50.0, 33.0), (81.0, 70.0)].map(|(u, v)| Point2::new(u, v)));
/// let report = ransac(LineEstimator::new(&points)?, &RansacOptions::default())?;
/// assert_eq!(report.num_inliers, 20);
/// assert!(report.model.signed_distance(&Point2::new(-100.0, 2.0)).abs() < 1e-9);
/// # Ok(()) }
/// ```
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
/// assert_eq!((report.iterations, report.stop), (3, StopReason::Canceled));
/// # Ok(()) }
/// ```
pub fn ransac_with<E: Estimator>(
    mut estimator: E,
    options: &RansacOptions,
    mut watch: impl FnMut(&Trial<'_, E::Model>) -> ControlFlow<()>,
) -> Result<RansacReport<E::Model>> {
    run(&mut estimator, options, &mut watch)
}

/// Compiled once for all estimators of one kind of model: the loop asks them little, and what it asks takes long, so
/// a pointer on the way costs nothing, but a copy of the loop for each is 10 KB.
fn run<M: Clone>(
    estimator: &mut dyn Estimator<Model = M>,
    options: &RansacOptions,
    watch: Watch<'_, M>,
) -> Result<RansacReport<M>> {
    if options.threshold == ThresholdKind::Noise {
        return ransac_by_noise(estimator, options, watch);
    }
    let mut run = Ransac::new(estimator, *options)?;
    while let Step::Trial(trial) = run.step() {
        if watch(&trial).is_break() {
            run.cancel();
        }
    }
    run.finish()
}
