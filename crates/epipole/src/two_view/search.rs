//! Consecutive searches for the models of two views.

use super::TwoViewOptions;
use crate::epipolar::FundamentalEstimator;
use crate::homography::HomographyEstimator;
use crate::progress::{Monitor, Part};
use crate::robust::{Estimator, MatchSet, RansacOptions, RansacReport, ThresholdKind, ransac};
use crate::{Error, Result};

/// Maximum number of searches in one run: two for the threshold, then E, F, H and the rotation.
const MOST: usize = 6;

/// Runner of consecutive searches.
pub(super) struct Searches<'a> {
    monitor: &'a mut dyn Monitor,
    /// Number of searches so far.
    count: usize,
    /// Number of samples drawn so far, over all searches.
    pub(super) iterations: usize,
    canceled: bool,
}

impl<'a> Searches<'a> {
    pub(super) fn new(monitor: &'a mut dyn Monitor) -> Self {
        Self {
            monitor,
            count: 0,
            iterations: 0,
            canceled: false,
        }
    }

    /// Returns the options with a fixed threshold. If it is to be estimated, it is that of F, which
    /// all pairs have, whatever the scene and the intrinsics; else that of H. If neither is found,
    /// it is that of the options.
    pub(super) fn with_threshold(
        &mut self,
        options: &TwoViewOptions,
        set: &MatchSet,
    ) -> TwoViewOptions {
        let input_px = options.ransac.max_error_px;
        if options.ransac.threshold == ThresholdKind::Given {
            return *options;
        }
        let f = FundamentalEstimator::new(set.clone());
        let found = self.ransac(f, &options.ransac);
        if let Ok(report) = found
            && !report.could_be_random()
        {
            return options.within(report.max_error_px);
        }
        let h = HomographyEstimator::new(set.clone());
        let found = self.ransac(h, &options.ransac);
        let of_f = |h_px: f64| h_px / options.within(1.0).in_two_dimensions().max_error_px;
        options.within(found.map_or(input_px, |report| of_f(report.max_error_px)))
    }

    /// Searches by RANSAC.
    pub(super) fn ransac<E: Estimator>(
        &mut self,
        estimator: Result<E>,
        options: &RansacOptions,
    ) -> Result<RansacReport<E::Model>> {
        let estimator = estimator?;
        self.run(|monitor| ransac(estimator, options, monitor))
    }

    /// Searches by a function that runs RANSAC.
    pub(super) fn run<M>(
        &mut self,
        run: impl FnOnce(&mut dyn Monitor) -> Result<RansacReport<M>>,
    ) -> Result<RansacReport<M>> {
        if self.canceled {
            return Err(Error::Canceled);
        }
        let fraction = |count: usize| count as f32 / MOST as f32;
        let from = fraction(self.count);
        self.count += 1;
        let report = run(&mut Part::new(
            &mut *self.monitor,
            from,
            fraction(self.count),
        ));
        match &report {
            Ok(report) => self.iterations += report.iterations,
            Err(Error::NoConsensus { iterations, .. }) => self.iterations += iterations,
            Err(error) => self.canceled = *error == Error::Canceled,
        }
        report
    }

    /// # Errors
    /// [`Error::Canceled`] if the monitor canceled a search.
    pub(super) fn check(&self) -> Result<()> {
        match self.canceled {
            true => Err(Error::Canceled),
            false => Ok(()),
        }
    }
}
