//! The photograph, and the effect of a change on a keypoint's descriptors.

use super::comparison::{Comparison, Subject};
use crate::contract::{Problem, Progress};
use crate::kit::features::{Pair, SIZE};
use crate::kit::picture::Picture;
use crate::kit::question;
use serde::{Deserialize, Serialize};

/// Requested job on the rendered still life.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Question {
    /// The photograph itself.
    Photograph,
    /// The descriptors before and after a change.
    Comparison(Subject),
}

/// Result of the job.
#[derive(Serialize, Deserialize)]
pub(super) enum Answer {
    Photograph(Picture),
    Comparison(Comparison),
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Looking at the photograph";
    const FAILED: &'static str = "There is no photograph";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        Ok(match self {
            Self::Photograph => Answer::Photograph(Pair::photograph(0, progress)?.clone().into()),
            Self::Comparison(asking) => Answer::Comparison(Comparison::of(asking, progress)?),
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        match (self, answer) {
            (Self::Photograph, Answer::Photograph(picture)) => picture.size() == SIZE,
            (Self::Comparison(_), Answer::Comparison(comparison)) => comparison.is_sound(),
            _ => false,
        }
    }
}
