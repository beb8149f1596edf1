//! The matches of two photographs, and their votes for F.

use super::matches::Match;
use super::votes::{Voters, Votes};
use crate::contract::{Problem, Progress};
use crate::kit::features::{self, Pair};
use crate::kit::picture::Picture;
use crate::kit::question;
use epipole::Error;
use epipole::feature::{Features, MatchOptions, match_descriptors};
use epipole::progress::Status;
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// Size of the rendered photographs, pixels.
pub(super) const STILL_LIFE_SIZE: (u32, u32) = features::SIZE;

/// Requested computation.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Question {
    /// The matches of the rendered still life.
    StillLife,
    /// The matches of the reader's photographs.
    Own([Picture; 2]),
    /// The votes of matches.
    Votes(Voters),
}

/// Result of the computation.
#[derive(Clone, Serialize, Deserialize)]
pub(super) enum Answer {
    Matched(Matched),
    Votes(Votes),
}

/// Two photographs and their matches.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Matched {
    pub(super) photographs: [Picture; 2],
    pub(super) matches: Vec<Match>,
}

impl question::Question for Question {
    type Answer = Answer;
    const LABEL: &'static str = "Matching features";
    const FAILED: &'static str = "There are no matches";

    fn answer(&self, progress: Progress<'_>) -> Result<Answer, Problem> {
        let photographs = match self {
            Self::StillLife => return Ok(Answer::Matched(still_life(progress)?)),
            Self::Own(photographs) => photographs.clone(),
            Self::Votes(voters) => return Ok(Answer::Votes(voters.vote(progress)?)),
        };
        let both = photographs.each_ref().map(Picture::image);
        let found = features::detect(both, &mut |share| progress(0.9 * share))?;
        let matches = find_matches(found.each_ref(), |_, _| None, &mut |share| {
            progress(0.9 + 0.1 * share)
        })?;
        Ok(Answer::Matched(Matched {
            photographs,
            matches,
        }))
    }

    fn fits(&self, answer: &Answer) -> bool {
        let (sizes, found) = match (self, answer) {
            (Self::Votes(voters), Answer::Votes(votes)) => return votes.fit(voters.places.len()),
            (Self::StillLife, Answer::Matched(found)) => ([STILL_LIFE_SIZE; 2], found),
            (Self::Own(photographs), Answer::Matched(found)) => {
                ([photographs[0].size(), photographs[1].size()], found)
            }
            _ => return false,
        };
        let is_finite = |found: &Match| {
            found.ratio.is_finite() && found.places.iter().flatten().all(|x| x.is_finite())
        };
        sizes == [found.photographs[0].size(), found.photographs[1].size()]
            && found.matches.iter().all(is_finite)
    }
}

/// Cached: the still life never changes, and posters of several sizes need it.
fn still_life(progress: Progress<'_>) -> Result<Matched, Problem> {
    static FOUND: OnceLock<Vec<Match>> = OnceLock::new();
    let pair = Pair::of_still_life(&mut |share| progress(0.9 * share))?;
    let matches = match FOUND.get() {
        Some(found) => found,
        None => {
            let go_on = &mut |share| progress(0.9 + 0.1 * share);
            let judge = |index1, index2| Some(pair.is_right(index1, index2));
            let matches = find_matches(pair.features, judge, go_on)?;
            FOUND.get_or_init(|| matches)
        }
    };
    Ok(Matched {
        photographs: pair.photographs.map(|photograph| photograph.clone().into()),
        matches: matches.clone(),
    })
}

/// Finds mutual nearest neighbors; the ratio test comes later.
///
/// * `judge`: returns whether the features with these indices are a correct match, if known
fn find_matches(
    [first, second]: [&Features; 2],
    judge: impl Fn(usize, usize) -> Option<bool>,
    progress: Progress<'_>,
) -> Result<Vec<Match>, Error> {
    let any_ratio = MatchOptions::default().with_max_ratio(None);
    let found = match_descriptors(
        &first.descriptors,
        &second.descriptors,
        &any_ratio,
        &mut |status: Status| progress(f64::from(status.fraction)),
    )?;
    let mut matches: Vec<Match> = Vec::with_capacity(found.len());
    for found in &found {
        let (pixel1, pixel2) = (
            first.keypoints[found.index1].point(),
            second.keypoints[found.index2].point(),
        );
        let places = [pixel1.coords.into(), pixel2.coords.into()];
        // A feature with two orientations counts once.
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
