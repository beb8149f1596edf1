//! Frames of a camera that moves on a closed path in front of the still life.

use crate::contract::Progress;
use crate::kit::question::tell;
use crate::kit::scenes::{photograph, still_life_pair};
use epipole::Error;
use epipole::camera::PosedCamera;
use image::RgbImage;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Number of frames; the last one is a step before the first.
pub(crate) const NUM_FRAMES: usize = 32;
/// Size of a frame, pixels.
pub(crate) const SIZE: (u32, u32) = (320, 240);
/// Semi-axes of the path to the right and forward, meters.
const ACROSS_M: f64 = 0.3;
const FORWARD_M: f64 = 0.12;
/// Distance of the point that the camera keeps in its middle column, meters.
const TARGET_M: f64 = 1.6;

/// Returns the camera of a frame.
pub(crate) fn camera(frame: usize) -> PosedCamera {
    let angle = TAU * frame as f64 / NUM_FRAMES as f64;
    let right_m = ACROSS_M * libm::sin(angle);
    let forward_m = FORWARD_M * (1.0 - libm::cos(angle));
    let left_deg = libm::atan2(right_m, TARGET_M - forward_m).to_degrees();
    let [_, camera] = still_life_pair(SIZE, right_m, forward_m, left_deg);
    camera
}

/// Returns all frames, rendered on the first call.
///
/// # Errors
/// [`Error::Canceled`] if `progress` cancels.
pub(crate) fn frames(progress: Progress<'_>) -> Result<&'static [RgbImage], Error> {
    static FRAMES: OnceLock<Vec<RgbImage>> = OnceLock::new();
    if let Some(frames) = FRAMES.get() {
        return Ok(frames);
    }
    let mut frames = Vec::new();
    for frame in 0..NUM_FRAMES {
        tell(progress, frame as f64 / NUM_FRAMES as f64)?;
        frames.push(photograph(&camera(frame), SIZE, &mut |_| {
            std::ops::ControlFlow::Continue(())
        })?);
    }
    Ok(FRAMES.get_or_init(|| frames))
}
