//! Description of a step of the loop.

use super::StopReason;

/// A step of the loop.
#[derive(Debug, Clone, PartialEq)]
pub enum Step<'a, M> {
    /// A sample was drawn.
    Trial(Trial<'a, M>),
    /// Enough samples were drawn; nothing more will happen.
    Finished(StopReason),
}

/// One sample and its outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial<'a, M> {
    /// Counts from 1.
    pub iteration: usize,
    /// The data drawn, as indices into the data given.
    pub sample: &'a [usize],
    /// Number of models of the sample.
    pub num_models: usize,
    /// The best of them, if any.
    pub model: Option<M>,
    /// Its score. An upper bound if the model could not win, unless
    /// [`RansacOptions::score_every_trial`](super::RansacOptions::score_every_trial) is set.
    pub score: f64,
    /// Its inliers. A lower bound in the same case.
    pub num_inliers: usize,
    /// Number of samples required by the best model so far; `u64::MAX` before there is one.
    pub required_iterations: u64,
    /// Whether the best model so far came out of this step.
    pub is_best: bool,
    /// The best model so far after local optimization, if that improved it further.
    pub refined: Option<M>,
}
