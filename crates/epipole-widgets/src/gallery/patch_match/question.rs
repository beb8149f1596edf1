//! The job of `patch-match`: five features with four candidates each, one of them correct.

use crate::contract::{Problem, Progress};
use crate::kit::features::{Pair, SIZE};
use crate::kit::patch::Spot;
use crate::kit::picture::Picture;
use crate::kit::question;
use epipole::Error;
use epipole::feature::nearest_few;
use epipole::math::random::Random;
use serde::{Deserialize, Serialize};

pub(super) const NUM_ROUNDS: usize = 5;
pub(super) const NUM_OPTIONS: usize = 4;
/// Approximate positions of the features in photograph 1, pixels: the apple, a poster, the cloth,
/// the vase, the fringe.
const PLACES: [(f64, f64); NUM_ROUNDS] = [
    (88.0, 189.0),
    (339.0, 57.0),
    (251.0, 291.0),
    (202.0, 95.0),
    (217.0, 324.0),
];
/// Norm of a byte descriptor that corresponds to 1.
const UNIT: f32 = 512.0;

/// The request for the rounds, always of the rendered still life.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Question;

/// A feature and its candidates, the correct one at a random position.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Round {
    /// Feature in photograph 1.
    pub(super) feature: Spot,
    /// Candidates in photograph 2.
    pub(super) options: [Spot; NUM_OPTIONS],
    /// Distances between the unit-length descriptors of the feature and of each candidate.
    pub(super) distances: [f32; NUM_OPTIONS],
    /// Index of the correct option.
    pub(super) right: u8,
}

impl Round {
    /// Returns the option with the nearest descriptor.
    pub(super) fn machine(&self) -> usize {
        let order = |a: &usize, b: &usize| self.distances[*a].total_cmp(&self.distances[*b]);
        (0..NUM_OPTIONS).min_by(order).unwrap_or(0)
    }
}

/// The photographs and the rounds.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) photographs: [Picture; 2],
    pub(super) rounds: [Round; NUM_ROUNDS],
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Cutting out patches";
    const FAILED: &'static str = "There are no patches";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let pair = Pair::of_still_life(progress)?;
        let mut random = Random::new(4);
        let mut rounds = Vec::new();
        for place in PLACES {
            rounds.extend(round(pair, place, &mut random)?);
        }
        let rounds = rounds.try_into().map_err(|_| Error::Degenerate {
            what: "the five features",
            why: "one of them has no match in photograph 2",
        })?;
        Ok(Answer {
            photographs: pair.photographs.map(|photograph| photograph.clone().into()),
            rounds,
        })
    }

    fn fits(&self, answer: &Answer) -> bool {
        let is_sound = |round: &Round| {
            round.feature.is_sound()
                && round.options.iter().all(Spot::is_sound)
                && round.distances.iter().all(|d| (0.0..=2.0).contains(d))
                && usize::from(round.right) < NUM_OPTIONS
        };
        answer.photographs.iter().all(|one| one.size() == SIZE)
            && answer.rounds.iter().all(is_sound)
    }
}

/// Returns the feature nearest to `place` with its correct match and the three nearest wrong ones;
/// `None` without a correct match.
fn round(pair: &Pair, place: (f64, f64), random: &mut Random) -> Result<Option<Round>, Error> {
    let [first, second] = pair.features;
    let far = |index: &usize| {
        let one = &first.keypoints[*index];
        libm::hypot(one.u - place.0, one.v - place.1)
    };
    let Some(index1) = (0..first.keypoints.len()).min_by(|a, b| far(a).total_cmp(&far(b))) else {
        return Ok(None);
    };
    let query = first.descriptors.get(index1).unwrap_or_default();
    let ranked = nearest_few(&query, &second.descriptors, second.keypoints.len())?;
    let (right, wrong): (Vec<_>, Vec<_>) = ranked
        .into_iter()
        .partition(|(index2, _)| pair.is_right(index1, *index2));
    let Some(&right) = right.first() else {
        return Ok(None);
    };
    // One option per position: a feature with two orientations would show the same patch twice.
    let mut options = vec![right];
    for other in wrong {
        let at = |index: usize| second.keypoints[index].point();
        let is_new = options
            .iter()
            .all(|(one, _)| (at(*one) - at(other.0)).norm() > 4.0);
        if is_new && options.len() < NUM_OPTIONS {
            options.push(other);
        }
    }
    let place = random.below(NUM_OPTIONS);
    let last = options.len() - 1;
    options.swap(0, place.min(last));
    let Ok(options) = <[(usize, f32); NUM_OPTIONS]>::try_from(options) else {
        return Ok(None);
    };
    Ok(Some(Round {
        feature: Spot::from(&first.keypoints[index1]),
        options: options.map(|(index, _)| Spot::from(&second.keypoints[index])),
        distances: options.map(|(_, distance)| distance / UNIT),
        right: place as u8,
    }))
}
