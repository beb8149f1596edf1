//! The job of `harris`: the picture, its Harris response and the local maxima.

use crate::contract::{Problem, Progress};
use crate::kit::picture::{self, Picture};
use crate::kit::question::{self, tell};
use crate::kit::scenes::{self, square_picture};
use epipole::feature::{
    StructureTensorOptions, Window, WindowTensor, harris_response, non_maximum_suppression,
};
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};
use epipole_scenes::still_life_camera;
use image::RgbImage;
use serde::{Deserialize, Serialize};
use std::cell::OnceCell;

/// Size of the rendered photograph, pixels.
pub(super) const STILL_LIFE_SIZE: (u32, u32) = (480, 360);
/// Noise of the test pattern, gray levels.
const PATTERN_NOISE: f64 = 2.5;
/// Radius of non-maximum suppression, pixels.
const SUPPRESSION_RADIUS_PX: usize = 4;
/// Maximum number of local maxima kept, the strongest ones.
const MAX_PEAKS: usize = 4000;

/// Source of the picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Source {
    /// A rotated square on a uniform background, with a little noise.
    Pattern,
    /// The rendered still life.
    StillLife,
    /// The reader's photograph.
    Own(Picture),
}

/// All inputs of the job.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) source: Source,
    pub(super) k: f32,
    pub(super) window_px: usize,
}

/// The picture, its Harris response and the local maxima.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) picture: Picture,
    /// Harris response, in gray levels to the fourth power.
    #[serde(with = "picture::floats")]
    pub(super) response: GrayImage32,
    /// Local maxima, strongest first.
    pub(super) peaks: Vec<(u32, u32)>,
    #[serde(skip)]
    gray: OnceCell<GrayImage32>,
}

/// Returns gray levels divided by 8, the gain of the 3 × 3 Sobel filter, so that gradients are in
/// gray levels per pixel.
fn gray_levels(picture: &RgbImage) -> GrayImage32 {
    let mut gray = rgb_to_gray_f32(picture, &BT601_WEIGHTS);
    gray.pixels_mut()
        .for_each(|pixel| pixel.0[0] *= 255.0 / 8.0);
    gray
}

impl Question {
    fn options(&self) -> StructureTensorOptions {
        StructureTensorOptions::default().with_window(Window::Box(self.window_px))
    }

    /// Returns the structure tensor at a pixel of the answer's picture.
    pub(super) fn tensor(&self, answer: &Answer, pixel: (u32, u32)) -> Option<WindowTensor> {
        let gray = (answer.gray).get_or_init(|| gray_levels(answer.picture.image()));
        WindowTensor::at(gray, pixel, &self.options()).ok()
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Looking for corners";
    const FAILED: &'static str = "There are no corners";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let picture = match &self.source {
            Source::Pattern => square_picture(PATTERN_NOISE).into(),
            Source::StillLife => {
                let (width, height) = STILL_LIFE_SIZE;
                let camera = still_life_camera(width, height);
                let part = &mut |share| progress(0.7 * share);
                scenes::photograph(&camera, STILL_LIFE_SIZE, part)?.into()
            }
            Source::Own(picture) => picture.clone(),
        };
        let gray = gray_levels(picture.image());
        let response = harris_response(&gray, self.k, &self.options(), &mut ())?;
        tell(progress, 0.8)?;
        let mut peaks = non_maximum_suppression(&response, SUPPRESSION_RADIUS_PX, 0.0, &mut ())?;
        peaks.truncate(MAX_PEAKS);
        Ok(Answer {
            peaks: (peaks.iter())
                .map(|peak| (peak.u as u32, peak.v as u32))
                .collect(),
            picture,
            response,
            gray: OnceCell::new(),
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let (width, height) = answer.picture.size();
        answer.response.dimensions() == (width, height)
            && (answer.peaks.iter()).all(|(u, v)| *u < width && *v < height)
    }
}

impl Answer {
    /// Returns the maximum response of the picture, always positive, so that fractions of it are
    /// defined.
    pub(super) fn strongest(&self) -> f32 {
        let first = self.peaks.first();
        first.map_or(f32::MIN_POSITIVE, |&(u, v)| {
            self.response.get_pixel(u, v).0[0]
        })
    }
}
