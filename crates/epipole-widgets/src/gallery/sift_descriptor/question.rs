//! What else is in the photograph? The picture, and fingerprints of its other places.

use super::prints::{Prints, SIGMA_PX};
use crate::contract::{Problem, Progress};
use crate::kit::features::{Pair, SIZE};
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use epipole::feature::Descriptors;
use epipole::imaging::{BT601_WEIGHTS, rgb_to_gray_f32};
use serde::{Deserialize, Serialize};

/// Other places to be confused with: the strongest features.
const NUM_OTHERS: usize = 200;

/// The rendered still life, always.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

/// What the computation finds.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) photograph: Picture,
    /// Places of other features, pixels.
    pub(super) places: Vec<(f64, f64)>,
    /// The numbers of their descriptors, each way.
    values: [Vec<f32>; 3],
}

impl Answer {
    /// The descriptors of the other features, each way.
    pub(super) fn lists(&self) -> Option<[Descriptors; 3]> {
        let count = self.places.len().max(1);
        let list = |values: &Vec<f32>| {
            Descriptors::from_floats((values.len() / count).max(1), values.clone()).ok()
        };
        let [raw, normalized, sift] = &self.values;
        Some([list(raw)?, list(normalized)?, list(sift)?])
    }
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Looking at the photograph";
    const FAILED: &'static str = "There is no photograph";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let pair = Pair::of_still_life(&mut |share| progress(0.9 * share))?;
        tell(progress, 0.9)?;
        let mut places: Vec<(f64, f64)> = Vec::new();
        for keypoint in &pair.features[0].keypoints {
            let is_new = |(u, v): &(f64, f64)| libm::hypot(u - keypoint.u, v - keypoint.v) > 4.0;
            if places.len() < NUM_OTHERS && places.iter().all(is_new) {
                places.push((keypoint.u, keypoint.v));
            }
        }
        let gray = rgb_to_gray_f32(&pair.photographs[0], &BT601_WEIGHTS);
        let prints = Prints::of(&gray, &places, SIGMA_PX, true)?;
        Ok(Answer {
            photograph: pair.photographs[0].clone().into(),
            places,
            values: prints.lists.each_ref().map(Descriptors::to_floats),
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let count = answer.places.len();
        answer.photograph.size() == SIZE
            && count > 0
            && answer
                .places
                .iter()
                .all(|(u, v)| u.abs() < 1e5 && v.abs() < 1e5)
            && answer.values[0].len() == 256 * count
            && answer.values[1].len() == 256 * count
            && answer.values[2].len() == 128 * count
            && answer.lists().is_some()
    }
}
