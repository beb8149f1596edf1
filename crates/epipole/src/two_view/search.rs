//! The searches for the models of two views, watched together.

use std::ops::ControlFlow;

use super::TwoViewOptions;
use crate::epipolar::FundamentalEstimator;
use crate::homography::HomographyEstimator;
use crate::robust::{
    Estimator, MatchSet, RansacOptions, RansacReport, ThresholdKind, Trial, ransac_with,
};
use crate::{Error, Result};

/// A model that two views are tried with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TwoViewSearch {
    /// E and its motion.
    Essential,
    /// F.
    Fundamental,
    /// H.
    Homography,
    /// The turn of a camera that stays where it is.
    Rotation,
}

/// A sample drawn in the search for one of the models.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TwoViewTrial {
    /// Which model is searched for.
    pub search: TwoViewSearch,
    /// Counts from 1 in each search.
    pub iteration: usize,
    /// Samples that the best model of this search so far asks for; `u64::MAX` before there is one.
    pub required_iterations: u64,
}

/// Hears of every sample; answers [`ControlFlow::Break`] to end with what is there.
pub type TwoViewObserver<'a> = &'a mut dyn FnMut(&TwoViewTrial) -> ControlFlow<()>;

/// Runs one search after the other, and none after the observer wanted to end.
pub(super) struct Searches<'a> {
    observer: TwoViewObserver<'a>,
    /// Samples drawn so far, over all searches.
    pub(super) iterations: usize,
    canceled: bool,
}

impl<'a> Searches<'a> {
    pub(super) fn new(observer: TwoViewObserver<'a>) -> Self {
        Self {
            observer,
            iterations: 0,
            canceled: false,
        }
    }

    /// The options with a threshold that is given: where it is to be found, that of F, which all pairs
    /// have, whatever the scene and the intrinsics; else that of H. Where neither is found, that of the
    /// options.
    pub(super) fn with_threshold(
        &mut self,
        options: &TwoViewOptions,
        set: &MatchSet,
    ) -> TwoViewOptions {
        let given_px = options.ransac.max_error_px;
        if options.ransac.threshold == ThresholdKind::Given {
            return *options;
        }
        let f = FundamentalEstimator::new(set.clone());
        let found = self.ransac(TwoViewSearch::Fundamental, f, &options.ransac);
        if let Ok(report) = found
            && !report.could_be_chance()
        {
            return options.within(report.max_error_px);
        }
        let h = HomographyEstimator::new(set.clone());
        let found = self.ransac(TwoViewSearch::Homography, h, &options.ransac);
        let of_f = |h_px: f64| h_px / options.within(1.0).in_two_dimensions().max_error_px;
        options.within(found.map_or(given_px, |report| of_f(report.max_error_px)))
    }

    /// Searches by the one loop.
    pub(super) fn ransac<E: Estimator>(
        &mut self,
        search: TwoViewSearch,
        estimator: Result<E>,
        options: &RansacOptions,
    ) -> Result<RansacReport<E::Model>> {
        let estimator = estimator?;
        self.run(search, |watch| ransac_with(estimator, options, watch))
    }

    /// Searches by a function that shows the loop's trials.
    pub(super) fn run<M>(
        &mut self,
        search: TwoViewSearch,
        run: impl FnOnce(&mut dyn FnMut(&Trial<'_, M>) -> ControlFlow<()>) -> Result<RansacReport<M>>,
    ) -> Result<RansacReport<M>> {
        if self.canceled {
            return Err(Error::Canceled);
        }
        run(&mut |trial| {
            self.iterations += 1;
            let answer = (self.observer)(&TwoViewTrial {
                search,
                iteration: trial.iteration,
                required_iterations: trial.required_iterations,
            });
            self.canceled |= answer.is_break();
            answer
        })
    }

    /// Whether the observer ended them.
    pub(super) fn canceled(&self) -> bool {
        self.canceled
    }
}
