//! A step of the RANSAC loop.

use super::StopReason;

/// Result of a step.
#[derive(Debug, Clone, PartialEq)]
pub enum Step<'a, M> {
    /// A sample was drawn.
    Trial(Trial<'a, M>),
    /// Enough samples were drawn; further steps do nothing.
    Finished(StopReason),
}

/// One sample and its outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial<'a, M> {
    /// Number of the sample, from 1.
    pub iteration: usize,
    /// The sample, as indices into the input data.
    pub sample: &'a [usize],
    /// Number of models of the sample.
    pub num_models: usize,
    /// The best of these models, if any.
    pub model: Option<M>,
    /// Its score. An upper bound if the model could not win, unless
    /// [`RansacOptions::score_every_trial`](super::RansacOptions::score_every_trial) is set.
    pub score: f64,
    /// Number of its inliers; a lower bound in the same case.
    pub num_inliers: usize,
    /// Number of samples required by the best model so far; `u64::MAX` before there is one.
    pub required_iterations: u64,
    /// Whether this step found the best model so far.
    pub is_best: bool,
    /// The best model so far after local optimization, if that improved it further.
    pub refined: Option<M>,
}
