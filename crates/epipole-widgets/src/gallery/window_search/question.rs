//! The job of `window-search`: renders the pair.

use crate::contract::{Problem, Progress};
use crate::kit::question;
use crate::kit::rectified::{self, RectifiedPair};
use serde::{Deserialize, Serialize};

/// Distance between the cameras, meters.
const BASELINE_M: f64 = 0.08;

/// The request for the pair; it has no parameters.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

impl question::Question for Question {
    type Answer = RectifiedPair;
    const LABEL: &'static str = "Taking the photographs";
    const FAILED: &'static str = "There are no photographs";

    fn answer(&self, progress: Progress<'_>) -> Result<RectifiedPair, Problem> {
        RectifiedPair::render(BASELINE_M, progress)
    }

    fn fits(&self, answer: &RectifiedPair) -> bool {
        answer.fits()
    }
}

/// Returns the depth of a disparity, meters; `None` unless the disparity is positive.
pub(super) fn depth_m(disparity_px: f64) -> Option<f64> {
    rectified::depth_m(BASELINE_M, disparity_px)
}
