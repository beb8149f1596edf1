//! The job of `flow-window`: renders its photograph.

use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question;
use crate::kit::scenes::photograph;
use epipole_scenes::still_life_camera;
use serde::{Deserialize, Serialize};

/// Size of the photograph, pixels.
pub(super) const SIZE: (u32, u32) = (320, 240);

/// The request for the photograph; it has no parameters.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

impl question::Question for Question {
    type Answer = Picture;
    const LABEL: &'static str = "Taking the photograph";
    const FAILED: &'static str = "There is no photograph";

    fn answer(&self, progress: Progress<'_>) -> Result<Picture, Problem> {
        let camera = still_life_camera(SIZE.0, SIZE.1);
        Ok(photograph(&camera, SIZE, progress)?.into())
    }

    fn fits(&self, answer: &Picture) -> bool {
        answer.size() == SIZE
    }
}
