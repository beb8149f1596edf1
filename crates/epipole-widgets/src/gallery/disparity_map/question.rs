//! The job of `disparity-map`: renders a pair, matches it and scores the disparities.

use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use epipole::Error;
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::imaging::rgb_to_gray;
use epipole::progress::{Monitor, Status};
use epipole::stereo::{DisparityFilter, DisparityImage, StereoBm, StereoSgm, depth_from_disparity};
use epipole_scenes::{Photograph, Sampling, Scene, still_life_camera};
use image::GrayImage;
use serde::{Deserialize, Serialize};

/// Size of the photographs, pixels.
pub(super) const SIZE: (u32, u32) = (320, 240);
/// Error above which an answer is bad, pixels.
pub(super) const BAD_PX: f32 = 2.0;
/// Disparities that differ by more belong to different surfaces, pixels.
const SAME_SURFACE_PX: f32 = 1.0;

/// Matching method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum Method {
    /// Block matching with windows of this side, pixels.
    Blocks(u32),
    /// Semi-global matching.
    SemiGlobal,
}

/// Everything that the answer depends on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) baseline_m: f64,
    pub(super) method: Method,
    /// Number of disparities searched, from 0 pixels up.
    pub(super) num_disparities: u32,
    /// Whether uncertain answers are dropped.
    pub(super) checks: bool,
}

/// One value per pixel, row by row; NaN without a value.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Map(Vec<f32>);

impl Map {
    pub(super) fn get(&self, u: u32, v: u32) -> Option<f32> {
        let index = v as usize * SIZE.0 as usize + u as usize;
        let value = self.0.get(index).filter(|_| u < SIZE.0)?;
        value.is_finite().then_some(*value)
    }
}

/// The pair, its true and its computed disparities, and their scores.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) pictures: [Picture; 2],
    /// True disparities of the left photograph.
    pub(super) truth: Map,
    /// Disparities found.
    pub(super) found: Map,
    hidden: Vec<bool>,
    pub(super) scores: Scores,
}

/// Coverage and error of the computed disparities.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Scores {
    /// Fraction of the pixels visible to both cameras that have an answer.
    pub(super) coverage: f64,
    /// Fraction of these answers that is bad.
    pub(super) bad: f64,
    /// Mean error of these answers, pixels.
    pub(super) mean_error_px: f64,
}

/// Returns the focal length of both cameras, pixels.
pub(super) fn focal_px() -> f64 {
    still_life_camera(SIZE.0, SIZE.1).camera.intrinsics.fu_px()
}

/// Returns the left camera and the right one, a baseline apart along the rows.
fn cameras(baseline_m: f64) -> [PosedCamera; 2] {
    let left = still_life_camera(SIZE.0, SIZE.1);
    // Half a baseline to either side of the composition's viewpoint, so that both see the table.
    let shifted = |x_m: f64| PosedCamera {
        cam_from_world: RigidTransform::translation(-x_m, 0.0, 0.0) * left.cam_from_world,
        ..left
    };
    [shifted(-0.5 * baseline_m), shifted(0.5 * baseline_m)]
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Matching every pixel";
    const FAILED: &'static str = "There is no disparity";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        tell(progress, 0.0)?;
        if !(self.baseline_m > 0.0 && self.baseline_m < 1.0) {
            return Err(Error::OutOfRange {
                what: "the baseline",
                requirement: "between 0 and 1 meters",
                value: self.baseline_m,
            }
            .into());
        }
        let scene = Scene::still_life();
        let [left, right] = cameras(self.baseline_m);
        let left = scene.render(&left, SIZE.0, SIZE.1, Sampling::Full)?;
        tell(progress, 0.3)?;
        let right = scene.render(&right, SIZE.0, SIZE.1, Sampling::Full)?;
        tell(progress, 0.6)?;
        let gray = |photo: &Photograph| rgb_to_gray(&photo.image);
        let found = self.search(&gray(&left), &gray(&right), &mut |status: Status| {
            progress(0.6 + 0.4 * f64::from(status.share))
        })?;
        let truth = self.true_disparity(&left);
        let hidden = hidden(&truth.0, &self.true_disparity(&right).0);
        let found = Map(found.as_raw().to_vec());
        Ok(Answer {
            pictures: [left.image.into(), right.image.into()],
            scores: Scores::of(&found, &truth, &hidden),
            truth,
            found,
            hidden,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let num_pixels = (SIZE.0 * SIZE.1) as usize;
        let scores = &answer.scores;
        answer.pictures.iter().all(|picture| picture.size() == SIZE)
            && [&answer.truth, &answer.found].map(|map| map.0.len()) == [num_pixels; 2]
            && answer.hidden.len() == num_pixels
            && [scores.coverage, scores.bad, scores.mean_error_px]
                .iter()
                .all(|score| score.is_finite())
    }
}

impl Question {
    fn search(
        &self,
        left: &GrayImage,
        right: &GrayImage,
        monitor: &mut dyn Monitor,
    ) -> Result<DisparityImage, Error> {
        match self.method {
            Method::Blocks(window_px) => {
                let mut matcher = StereoBm::default()
                    .with_num_disparities(self.num_disparities)
                    .with_window_px(window_px);
                if !self.checks {
                    matcher.min_texture = 0.0;
                }
                matcher.filter = self.filter(matcher.filter);
                matcher.compute(left, right, monitor)
            }
            Method::SemiGlobal => {
                let mut matcher = StereoSgm::default().with_num_disparities(self.num_disparities);
                matcher.filter = self.filter(matcher.filter);
                matcher.compute(left, right, monitor)
            }
        }
    }

    /// Returns the usual filter, or one without its tests if `checks` is off.
    fn filter(&self, usual: DisparityFilter) -> DisparityFilter {
        match self.checks {
            true => usual,
            false => usual
                .with_left_right_max_px(None)
                .with_uniqueness_percent(0)
                .with_speckle_size(0),
        }
    }

    /// Returns the true disparity of every pixel, `d = f B / Z`.
    fn true_disparity(&self, photograph: &Photograph) -> Map {
        let scale = focal_px() * self.baseline_m;
        let depths = photograph.depth_m.as_raw().iter();
        Map(depths.map(|&z| (scale / f64::from(z)) as f32).collect())
    }

    /// Returns the depth of a disparity, meters; `None` unless the disparity is positive.
    pub(super) fn depth_m(&self, disparity_px: f32) -> Option<f64> {
        depth_from_disparity(focal_px(), self.baseline_m, f64::from(disparity_px)).ok()
    }

    /// Whether the search reaches the largest true disparity.
    pub(super) fn reaches_nearest(&self, answer: &Answer) -> bool {
        answer.scale_px() < self.num_disparities as f32 - 1.0
    }
}

/// Returns, for each pixel of the left photograph, whether it is hidden from the right camera.
fn hidden(left: &[f32], right: &[f32]) -> Vec<bool> {
    let width = SIZE.0 as usize;
    let is_hidden = |index: usize| {
        let (row, u) = (index / width, (index % width) as f32);
        let there = (u - left[index]).round();
        if there < 0.0 {
            return true;
        }
        // A surface in front has a larger disparity.
        let before = right[row * width + (there as usize).min(width - 1)] - left[index];
        before > SAME_SURFACE_PX
    };
    (0..left.len()).map(is_hidden).collect()
}

impl Scores {
    fn of(found: &Map, truth: &Map, hidden: &[bool]) -> Self {
        let (mut seen, mut answered, mut bad, mut sum) = (0.0, 0.0, 0.0, 0.0);
        for ((found, truth), is_hidden) in found.0.iter().zip(&truth.0).zip(hidden) {
            if *is_hidden {
                continue;
            }
            seen += 1.0;
            let error_px = (found - truth).abs();
            if error_px.is_finite() {
                answered += 1.0;
                sum += f64::from(error_px);
                bad += f64::from(u8::from(error_px > BAD_PX));
            }
        }
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        Self {
            coverage: share(answered, seen),
            bad: share(bad, answered),
            mean_error_px: share(sum, answered),
        }
    }
}

impl Answer {
    /// Whether a pixel of the left photograph is hidden from the right camera.
    pub(super) fn is_hidden(&self, u: u32, v: u32) -> bool {
        let index = v as usize * SIZE.0 as usize + u as usize;
        self.hidden.get(index).copied().unwrap_or(false)
    }

    /// Returns found minus true disparity, pixels; `None` without an answer.
    pub(super) fn error_px(&self, u: u32, v: u32) -> Option<f32> {
        Some(self.found.get(u, v)? - self.truth.get(u, v)?)
    }

    /// Returns the largest true disparity, which is the end of the color scale, pixels.
    pub(super) fn scale_px(&self) -> f32 {
        let finite = self.truth.0.iter().filter(|d| d.is_finite());
        finite.fold(1.0, |most, d| d.max(most))
    }
}
