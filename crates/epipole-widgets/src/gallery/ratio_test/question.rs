//! The two nearest neighbors of each feature, and which of them are correct.

use crate::contract::{Problem, Progress};
use crate::kit::features::{Pair, RIGHT_WITHIN_PX, SIZE};
use crate::kit::patch::Spot;
use crate::kit::picture::Picture;
use crate::kit::question::{self, tell};
use epipole::feature::{MatchOptions, match_descriptors, nearest_few};
use serde::{Deserialize, Serialize};

/// Norm of a byte descriptor.
const UNIT: f32 = 512.0;

/// Request for the rendered still life, without parameters.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

/// A feature of photograph 1 with its two nearest neighbors in photograph 2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Candidate {
    /// Indices of the nearest and the second nearest.
    pub(super) nearest: [u32; 2],
    /// Their distances, for descriptors of norm 1.
    pub(super) distances: [f32; 2],
    /// Ratio of the smaller distance to the larger.
    pub(super) ratio: f32,
    /// Whether the nearest neighbor's nearest neighbor is this feature.
    pub(super) is_mutual: bool,
    /// Whether the nearest neighbor is a correct match.
    pub(super) is_right: bool,
}

/// Result of the computation.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) photographs: [Picture; 2],
    /// The features.
    pub(super) spots: [Vec<Spot>; 2],
    /// Candidates by feature of photograph 1.
    pub(super) candidates: Vec<Candidate>,
    /// Number of features of photograph 1 with a correct match among those of photograph 2.
    pub(super) num_findable: u32,
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Matching features";
    const FAILED: &'static str = "There are no matches";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let pair = Pair::of_still_life(&mut |share| progress(0.9 * share))?;
        let [first, second] = pair.features.each_ref().map(|found| &found.descriptors);
        let options = MatchOptions::default().with_max_ratio(None);
        let mut is_mutual = vec![false; first.len()];
        for found in match_descriptors(first, second, &options, &mut ())? {
            is_mutual[found.index1] = true;
        }
        tell(progress, 0.92)?;
        let mut candidates = Vec::with_capacity(first.len());
        for (index1, is_mutual) in is_mutual.into_iter().enumerate() {
            let query = first.get(index1).unwrap_or_default();
            let found = nearest_few(&query, second, 2)?;
            let &[(nearest, near), (other, far)] = &found[..] else {
                continue;
            };
            candidates.push(Candidate {
                nearest: [nearest as u32, other as u32],
                distances: [near / UNIT, far / UNIT],
                ratio: if far > 0.0 { near / far } else { 1.0 },
                is_mutual,
                is_right: pair.is_right(index1, nearest),
            });
        }
        let spots = (pair.features.each_ref())
            .map(|found| found.keypoints.iter().map(Spot::from).collect::<Vec<_>>());
        let places2: Vec<_> = (pair.features[1].keypoints.iter())
            .map(|keypoint| keypoint.point())
            .collect();
        let findable = pair.truths.iter().flatten().filter(|truth| {
            let is_near =
                |place: &nalgebra::Point2<f64>| (place - **truth).norm() < RIGHT_WITHIN_PX;
            places2.iter().any(is_near)
        });
        Ok(Answer {
            num_findable: findable.count() as u32,
            photographs: pair.photographs.map(|photograph| photograph.clone().into()),
            spots,
            candidates,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let [num1, num2] = answer.spots.each_ref().map(Vec::len);
        let is_sound = |found: &Candidate| {
            found.nearest.iter().all(|index| (*index as usize) < num2)
                && (0.0..=1.0).contains(&found.ratio)
                && found.distances.iter().all(|d| (0.0..=2.0).contains(d))
        };
        answer.photographs.iter().all(|one| one.size() == SIZE)
            && answer.spots.iter().flatten().all(Spot::is_sound)
            && answer.candidates.len() == num1
            && answer.candidates.iter().all(is_sound)
    }
}
