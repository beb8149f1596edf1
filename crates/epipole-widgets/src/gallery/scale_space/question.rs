//! The photograph and its differences of Gaussians.

use crate::contract::{Problem, Progress};
use crate::kit::features::SIZE;
use crate::kit::picture::{self, Picture};
use crate::kit::question::{self, tell};
use crate::kit::scenes::photograph;
use epipole::feature::{SiftOptions, scale_space};
use epipole::imaging::{BT601_WEIGHTS, Border, GrayImage32, rgb_to_gray_f32, sample_bilinear};
use epipole_scenes::still_life_camera;
use serde::{Deserialize, Serialize};

/// Number of octaves shown, and of layers per octave in which extrema are searched.
pub(super) const NUM_OCTAVES: usize = 4;
pub(super) const NUM_LAYERS: usize = 3;

/// Request for the rendered still life, without parameters.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

/// A difference of two blurs.
#[derive(Serialize, Deserialize)]
pub(super) struct Layer {
    /// Blur σ of extrema in this layer, pixels.
    pub(super) sigma_px: f64,
    /// Pixels of the photograph per sample.
    pub(super) step_px: f64,
    /// Position of the first sample, pixels.
    origin: [f64; 2],
    /// More blurred minus less blurred, for gray values in [0, 1].
    #[serde(with = "picture::floats")]
    pub(super) values: GrayImage32,
}

/// Result of the job.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) photograph: Picture,
    /// Layers by increasing blur.
    pub(super) layers: Vec<Layer>,
}

impl Layer {
    /// Returns the value at a position in the photograph, gray levels.
    pub(super) fn at(&self, (u, v): (f64, f64)) -> f64 {
        let x = (u - self.origin[0]) / self.step_px;
        let y = (v - self.origin[1]) / self.step_px;
        255.0 * f64::from(sample_bilinear(&self.values, x, y, Border::Replicate))
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Blurring the photograph";
    const FAILED: &'static str = "There is no scale space";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let camera = still_life_camera(SIZE.0, SIZE.1);
        let shot = photograph(&camera, SIZE, &mut |share| progress(0.8 * share))?;
        let gray = rgb_to_gray_f32(&shot, &BT601_WEIGHTS);
        let options = SiftOptions::default()
            .with_layers_per_octave(NUM_LAYERS)
            .with_upsample(false);
        let space = scale_space(&gray, &options, &mut ())?;
        tell(progress, 0.95)?;
        let octaves = space.octaves.into_iter().take(NUM_OCTAVES);
        let layers = octaves.flat_map(|octave| {
            let (step_px, origin) = (octave.step_px, octave.origin);
            let inner = octave.differences.into_iter().zip(octave.sigmas_px);
            inner
                .skip(1)
                .take(NUM_LAYERS)
                .map(move |(values, sigma_px)| Layer {
                    sigma_px,
                    step_px,
                    origin,
                    values,
                })
        });
        Ok(Answer {
            layers: layers.collect(),
            photograph: shot.into(),
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let is_sound = |layer: &Layer| {
            let [u, v] = layer.origin;
            (0.5..1e3).contains(&layer.sigma_px)
                && (0.5..1e3).contains(&layer.step_px)
                && u.abs() < 1e3
                && v.abs() < 1e3
                && layer.values.width() > 1
                && layer.values.iter().all(|value| value.abs() <= 1.0)
        };
        answer.photograph.size() == SIZE
            && answer.layers.len() == NUM_OCTAVES * NUM_LAYERS
            && answer.layers.iter().all(is_sound)
            && (answer.layers.windows(2)).all(|two| two[0].sigma_px < two[1].sigma_px)
    }
}
