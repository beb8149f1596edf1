//! RANSAC from start to end.

use super::by_noise::ransac_by_noise;
use super::to_end::run_to_end;
use super::{Estimator, Ransac, RansacOptions, RansacReport, ThresholdKind};
#[cfg(doc)]
use crate::Error;
use crate::Result;
use crate::progress::Monitor;
#[cfg(doc)]
use crate::progress::Stage;

/// Runs [`Ransac`] to the end.
///
/// The stage is [`Stage::RobustEstimation`]. [`Ransac::step`] exposes every sample, and can end a
/// run early with the best model so far.
///
/// # Errors
/// As [`Ransac::new`] and [`Ransac::finish`]; [`Error::Canceled`] if the monitor cancels.
///
/// Source: as [`Ransac`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::robust::{LineEstimator, RansacOptions, ransac};
/// use nalgebra::Point2;
/// // Twenty points of the row v = 2, and four outliers.
/// let mut points: Vec<_> = (0..20).map(|i| Point2::new(f64::from(i) * 5.0, 2.0)).collect();
/// points.extend([(3.0, 40.0), (17.0, 90.0), (50.0, 33.0), (81.0, 70.0)].map(|(u, v)| Point2::new(u, v)));
/// let report = ransac(LineEstimator::new(&points)?, &RansacOptions::default(), &mut ())?;
/// assert_eq!(report.num_inliers, 20);
/// assert!(report.model.signed_distance(&Point2::new(-100.0, 2.0)).abs() < 1e-9);
/// # Ok(()) }
/// ```
pub fn ransac<E: Estimator>(
    mut estimator: E,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<E::Model>> {
    run(&mut estimator, options, monitor)
}

/// Body of [`ransac`], compiled once per kind of model: a copy of the loop for every estimator
/// would take 10 KB.
fn run<M: Clone>(
    estimator: &mut dyn Estimator<Model = M>,
    options: &RansacOptions,
    monitor: &mut dyn Monitor,
) -> Result<RansacReport<M>> {
    if options.threshold == ThresholdKind::Noise {
        return ransac_by_noise(estimator, options, monitor);
    }
    run_to_end(Ransac::new(estimator, *options)?, monitor)
}
