//! Which features of two photographs look alike? Both photographs and their matches.

use crate::contract::{Problem, Progress};
use crate::kit::features::{self, Pair};
use crate::kit::picture::Picture;
use crate::kit::question;
use epipole::Error;
use epipole::feature::{Features, MatchOptions, match_descriptors_with_progress};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// Size of the rendered photographs, pixels.
pub(super) const STILL_LIFE_SIZE: (u32, u32) = features::SIZE;

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
        let both = photographs.each_ref().map(Picture::image);
        let found = features::detect(both, &mut |share| progress(0.9 * share))?;
        let matches = find_matches(&found, |_, _| None, &mut |share| {
            progress(0.9 + 0.1 * share)
        })?;
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
    static FOUND: OnceLock<Vec<Match>> = OnceLock::new();
    let pair = Pair::of_still_life(&mut |share| progress(0.9 * share))?;
    let matches = match FOUND.get() {
        Some(found) => found,
        None => {
            let go_on = &mut |share| progress(0.9 + 0.1 * share);
            let judge = |index1, index2| Some(pair.is_right(index1, index2));
            let matches = find_matches(&pair.features, judge, go_on)?;
            FOUND.get_or_init(|| matches)
        }
    };
    Ok(Answer {
        photographs: pair.photographs.clone().map(Picture::from),
        matches: matches.clone(),
    })
}

/// Mutual nearest neighbors, told apart later by their ratio.
///
/// * `judge`: whether the features of these indices belong together, if that is known
fn find_matches(
    [first, second]: &[Features; 2],
    judge: impl Fn(usize, usize) -> Option<bool>,
    progress: Progress<'_>,
) -> Result<Vec<Match>, Error> {
    let any_ratio = MatchOptions {
        max_ratio: None,
        ..MatchOptions::default()
    };
    let found = match_descriptors_with_progress(
        &first.descriptors,
        &second.descriptors,
        &any_ratio,
        &mut |share| progress(f64::from(share)),
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
                is_right: judge(found.index1, found.index2),
            });
        }
    }
    Ok(matches)
}
