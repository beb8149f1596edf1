//! The job of `disparity-map`: renders a pair, matches it and scores the disparities.

use crate::contract::{Problem, Progress};
use crate::kit::question;
use crate::kit::rectified::{self, Map, RectifiedPair};
use epipole::Error;
use epipole::imaging::rgb_to_gray;
use epipole::progress::{Monitor, Status};
use epipole::stereo::{DisparityFilter, DisparityImage, StereoBm, StereoSgm};
use image::GrayImage;
use serde::{Deserialize, Serialize};

/// Error above which a disparity is bad, pixels.
pub(super) const BAD_PX: f32 = 2.0;

/// Matching method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum Method {
    /// Block matching with windows of this side, pixels.
    Blocks(u32),
    /// Semi-global matching.
    SemiGlobal,
}

/// All inputs of the job.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) baseline_m: f64,
    pub(super) method: Method,
    /// Number of disparities searched, from 0 pixels up.
    pub(super) num_disparities: u32,
    /// Whether uncertain disparities are dropped.
    pub(super) checks: bool,
}

/// The pair, its true and its computed disparities, and their scores.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) pair: RectifiedPair,
    /// Computed disparities.
    pub(super) found: Map,
    pub(super) scores: Scores,
}

/// Coverage and error of the computed disparities.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Scores {
    /// Fraction of the pixels visible to both cameras that have a disparity.
    pub(super) coverage: f64,
    /// Fraction of these disparities that are bad.
    pub(super) bad: f64,
    /// Mean error of these disparities, pixels.
    pub(super) mean_error_px: f64,
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Matching every pixel";
    const FAILED: &'static str = "There is no disparity";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let pair = RectifiedPair::render(self.baseline_m, &mut |share| progress(0.6 * share))?;
        let [left, right] = &pair.pictures;
        let [left, right] = [left, right].map(|picture| rgb_to_gray(picture.image()));
        let found = self.search(&left, &right, &mut |status: Status| {
            progress(0.6 + 0.4 * f64::from(status.fraction))
        })?;
        let found = Map(found.as_raw().to_vec());
        Ok(Answer {
            scores: Scores::of(&found, &pair.truth, &pair.hidden),
            pair,
            found,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let scores = &answer.scores;
        answer.pair.fits()
            && answer.found.fits()
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

    /// Returns the usual filter, or one without its tests if `checks` is false.
    fn filter(&self, usual: DisparityFilter) -> DisparityFilter {
        match self.checks {
            true => usual,
            false => usual
                .with_left_right_max_px(None)
                .with_uniqueness_percent(0)
                .with_speckle_size(0),
        }
    }

    /// Returns the depth of a disparity, meters; `None` unless the disparity is positive.
    pub(super) fn depth_m(&self, disparity_px: f32) -> Option<f64> {
        rectified::depth_m(self.baseline_m, disparity_px.into())
    }

    /// Whether the search reaches the largest true disparity.
    pub(super) fn reaches_nearest(&self, answer: &Answer) -> bool {
        answer.scale_px() < self.num_disparities as f32 - 1.0
    }
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
    /// Returns computed minus true disparity, pixels; `None` without one.
    pub(super) fn error_px(&self, u: u32, v: u32) -> Option<f32> {
        Some(self.found.get(u, v)? - self.pair.truth.get(u, v)?)
    }

    /// Returns the largest true disparity, which is the end of the color scale, pixels.
    pub(super) fn scale_px(&self) -> f32 {
        let finite = self.pair.truth.0.iter().filter(|d| d.is_finite());
        finite.fold(1.0, |most, d| d.max(most))
    }
}
