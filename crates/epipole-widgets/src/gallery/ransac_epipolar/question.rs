//! Which features of two photographs look alike? Both photographs and their matches.

use crate::contract::{Problem, Progress};
use crate::kit::picture::Picture;
use crate::kit::question;
use crate::kit::scenes::{self, still_life_pair};
use epipole::Error;
use epipole::feature::{
    Features, MatchOptions, SiftOptions, detect_sift_with_progress, match_descriptors_with_progress,
};
use epipole::imaging::{BT601_WEIGHTS, rgb_to_gray_f32};
use epipole::synthetic::Transfer;
use image::RgbImage;
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// Size of the rendered photographs, pixels.
pub(super) const STILL_LIFE_SIZE: (u32, u32) = (480, 360);
/// Where the second camera stands: meters to the right, meters forward, degrees to the left.
const MOTION: (f64, f64, f64) = (0.35, -0.25, 14.0);
/// The strongest features of a photograph; more make the picture fuller, not clearer.
const MAX_FEATURES: usize = 600;
/// A match is right if it is so near to where the scene's geometry puts it, pixels.
const RIGHT_WITHIN_PX: f64 = 3.0;

/// Where the photographs come from.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Question {
    /// The rendered still life.
    StillLife,
    /// The reader's own.
    Own([Picture; 2]),
}

/// A feature of photograph 1 and the one of photograph 2 that looks most alike, each the other's
/// nearest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Match {
    /// Column and row in photograph 1, then in photograph 2.
    pub(super) places: [[f64; 2]; 2],
    /// Lowe's ratio: distance of the descriptors over that of the second nearest.
    pub(super) ratio: f32,
    /// Whether it is right, where the truth is known.
    pub(super) is_right: Option<bool>,
}

/// What the computation finds.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) photographs: [Picture; 2],
    pub(super) matches: Vec<Match>,
}

impl Match {
    pub(super) fn pixel1(&self) -> Point2<f64> {
        self.places[0].into()
    }

    pub(super) fn pixel2(&self) -> Point2<f64> {
        self.places[1].into()
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Matching features";
    const FAILED: &'static str = "There are no matches";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let photographs = match self {
            Self::StillLife => return still_life(progress),
            Self::Own(photographs) => photographs.clone(),
        };
        let matches = find_matches([photographs[0].image(), photographs[1].image()], progress)?;
        Ok(Answer {
            photographs,
            matches,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let sizes = match self {
            Self::StillLife => [STILL_LIFE_SIZE; 2],
            Self::Own(photographs) => [photographs[0].size(), photographs[1].size()],
        };
        let is_finite = |found: &Match| {
            found.ratio.is_finite() && found.places.iter().flatten().all(|x| x.is_finite())
        };
        sizes == [answer.photographs[0].size(), answer.photographs[1].size()]
            && answer.matches.iter().all(is_finite)
    }
}

/// The still life never changes, and posters of several sizes need it several times.
fn still_life(progress: Progress<'_>) -> Result<Answer, Problem> {
    static FOUND: OnceLock<([RgbImage; 2], Vec<Match>)> = OnceLock::new();
    let (photographs, matches) = match FOUND.get() {
        Some(found) => found,
        None => {
            let found = match_still_life(progress)?;
            FOUND.get_or_init(|| found)
        }
    };
    Ok(Answer {
        photographs: photographs.clone().map(Picture::from),
        matches: matches.clone(),
    })
}

fn match_still_life(progress: Progress<'_>) -> Result<([RgbImage; 2], Vec<Match>), Error> {
    let (right_m, forward_m, left_deg) = MOTION;
    let cameras = still_life_pair(STILL_LIFE_SIZE, right_m, forward_m, left_deg);
    let mut photograph = |camera, done: f64| {
        let part = &mut |share| progress(done + 0.3 * share);
        scenes::photograph(camera, STILL_LIFE_SIZE, part)
    };
    let photographs = [photograph(&cameras[0], 0.0)?, photograph(&cameras[1], 0.3)?];
    let both = [&photographs[0], &photographs[1]];
    let mut matches = find_matches(both, &mut |share| progress(0.6 + 0.4 * share))?;
    let scene = scenes::still_life();
    for found in &mut matches {
        let truth = scene.transfer(&cameras[0], &cameras[1], &found.pixel1());
        found.is_right = Some(match truth {
            Transfer::Visible { pixel2, .. } => (pixel2 - found.pixel2()).norm() < RIGHT_WITHIN_PX,
            _ => false,
        });
    }
    Ok((photographs, matches))
}

/// SIFT on both photographs, then mutual nearest neighbors, told apart later by their ratio.
fn find_matches(photographs: [&RgbImage; 2], progress: Progress<'_>) -> Result<Vec<Match>, Error> {
    let mut go_on = |share: f64| progress(share) == ControlFlow::Continue(());
    let options = SiftOptions {
        max_features: MAX_FEATURES,
        ..SiftOptions::default()
    };
    let mut features = |photograph: &RgbImage, done: f64| -> Result<Features, Error> {
        let gray = rgb_to_gray_f32(photograph, &BT601_WEIGHTS);
        detect_sift_with_progress(&gray, &options, &mut |share| {
            go_on(done + 0.45 * f64::from(share))
        })
    };
    let (first, second) = (
        features(photographs[0], 0.0)?,
        features(photographs[1], 0.45)?,
    );
    let any_ratio = MatchOptions {
        max_ratio: None,
        ..MatchOptions::default()
    };
    let found = match_descriptors_with_progress(
        &first.descriptors,
        &second.descriptors,
        &any_ratio,
        &mut |share| go_on(0.9 + 0.1 * f64::from(share)),
    )?;
    let mut matches: Vec<Match> = Vec::with_capacity(found.len());
    for found in &found {
        let (pixel1, pixel2) = (
            first.keypoints[found.index1].point(),
            second.keypoints[found.index2].point(),
        );
        let places = [pixel1.coords.into(), pixel2.coords.into()];
        // A feature with two directions is one piece of evidence.
        if matches.iter().all(|other| other.places != places) {
            matches.push(Match {
                places,
                ratio: found.ratio,
                is_right: None,
            });
        }
    }
    Ok(matches)
}
