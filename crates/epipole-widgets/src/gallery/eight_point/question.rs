//! The job that renders the photographs. Matches need only the shapes of the scene, but a
//! photograph needs its light, which takes too long for a page.

use crate::contract::{Problem, Progress};
use crate::kit::matches::cameras;
use crate::kit::picture::Picture;
use crate::kit::question;
use crate::kit::scenes::{PHOTO_SIZE, photograph};
use image::RgbImage;
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// The request for both photographs; it has no parameters.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

/// The photographs.
pub(super) type Answer = [Picture; 2];

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Taking the photographs";
    const FAILED: &'static str = "There are no photographs";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        // Cached, because posters of several sizes need the photographs several times.
        static TAKEN: OnceLock<[RgbImage; 2]> = OnceLock::new();
        let taken = match TAKEN.get() {
            Some(taken) => taken,
            None => {
                let [first, second] = cameras();
                let first = photograph(&first, PHOTO_SIZE, &mut |share| progress(0.5 * share))?;
                let second = photograph(&second, PHOTO_SIZE, &mut |share| {
                    progress(0.5 + 0.5 * share)
                })?;
                TAKEN.get_or_init(|| [first, second])
            }
        };
        Ok(taken.clone().map(Picture::from))
    }

    fn fits(&self, answer: &Answer) -> bool {
        answer.iter().all(|picture| picture.size() == PHOTO_SIZE)
    }
}
