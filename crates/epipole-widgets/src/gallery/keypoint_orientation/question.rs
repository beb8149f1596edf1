//! The job of `keypoint-orientation`: renders the photograph.

use crate::contract::{Problem, Progress};
use crate::kit::features::{Pair, SIZE};
use crate::kit::picture::Picture;
use crate::kit::question;
use serde::{Deserialize, Serialize};

/// The request for the photograph; it has no parameters.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

impl question::Question for Question {
    type Answer = Picture;
    const LABEL: &'static str = "Taking the photograph";
    const FAILED: &'static str = "There is no photograph";

    fn answer(&self, progress: Progress<'_>) -> Result<Picture, Problem> {
        Ok(Pair::photograph(0, progress)?.clone().into())
    }

    fn fits(&self, answer: &Picture) -> bool {
        answer.size() == SIZE
    }
}
