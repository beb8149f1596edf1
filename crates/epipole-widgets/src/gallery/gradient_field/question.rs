//! The job of `gradient-field` for photographs: rendering or smoothing one takes longer than a
//! frame.

use super::field::Field;
use crate::contract::{Problem, Progress};
use crate::kit::picture::{Picture, gray_levels};
use crate::kit::question::{self, tell};
use crate::kit::scenes;
use epipole_scenes::still_life_camera;
use serde::{Deserialize, Serialize};

/// Size of the rendered photograph, pixels.
pub(super) const STILL_LIFE_SIZE: (u32, u32) = (480, 360);

/// Source of the photograph.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Source {
    /// The still life, not rendered yet.
    StillLife,
    /// An available photograph.
    Taken(Picture),
}

/// All inputs of the job.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) source: Source,
    /// Standard deviation of the Gaussian, pixels; `None` without smoothing.
    pub(super) smooth_px: Option<f64>,
}

/// The photograph and its gradient.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    /// The photograph before smoothing.
    pub(super) picture: Picture,
    pub(super) field: Field,
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Measuring slopes";
    const FAILED: &'static str = "There is no gradient";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let picture = match &self.source {
            Source::StillLife => {
                let (width, height) = STILL_LIFE_SIZE;
                let camera = still_life_camera(width, height);
                let part = &mut |share| progress(0.9 * share);
                scenes::photograph(&camera, STILL_LIFE_SIZE, part)?.into()
            }
            Source::Taken(picture) => picture.clone(),
        };
        let levels = gray_levels(picture.image());
        tell(progress, 0.95)?;
        let field = Field::new(&levels, self.smooth_px)?;
        Ok(Answer { picture, field })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let size = match &self.source {
            Source::StillLife => STILL_LIFE_SIZE,
            Source::Taken(picture) => picture.size(),
        };
        answer.picture.size() == size && answer.field.fits(size)
    }
}
