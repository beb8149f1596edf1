//! The searches for the models of two views, watched together.

use std::ops::ControlFlow;

use crate::robust::{Estimator, RansacOptions, RansacReport, Trial, ransac_with};
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
