//! Readouts, description and messages of `two-view-sfm`.

use super::model::{FocalFrom, TwoViewSfm, focal_text};
use crate::contract::{Readout, Words, format_number};
use crate::kit::question::Question as _;
use crate::kit::reconstruction::{Answer, MIN_NUM_MATCHES, Question, Stage, Verdict};

fn degrees(value: f64) -> String {
    format!("{}°", format_number(value, 1))
}

/// Returns the reason why there is no cloud, if so.
pub(super) fn failure((question, answer): (&Question, &Answer)) -> Option<String> {
    let (matches, inliers) = (answer.matches.len(), answer.num_inliers());
    Some(match answer.verdict {
        Verdict::TooFew => {
            let found = match matches {
                0 => "No features match".to_owned(),
                1 => "Only 1 feature matches".to_owned(),
                _ => format!("Only {matches} features match"),
            };
            format!(
                "{found}, and fewer than {MIN_NUM_MATCHES} tell nothing. Do both photographs show the \
                 same thing?"
            )
        }
        Verdict::NoConsensus => format!(
            "{matches} features match, but no motion of the camera explains {MIN_NUM_MATCHES} of \
             them. The photographs hardly overlap, or nearly all matches are wrong."
        ),
        Verdict::Turned(angle_deg) if angle_deg < 0.1 => format!(
            "The camera did not move: {inliers} of {matches} matches are where they were. Without \
             a step aside there is no depth, and no cloud."
        ),
        Verdict::Turned(angle_deg) => format!(
            "The camera only turned, by {}: a rotation alone explains {inliers} of {matches} \
             matches. Without a step aside there is no depth, and no cloud.",
            degrees(angle_deg)
        ),
        Verdict::OrientationMismatch {
            angle_deg,
            focal_factor,
        } => format!(
            "The camera only turned, by {}, if its focal length is near {}: then a rotation alone explains \
             {inliers} of {matches} matches. Without a step aside there is no depth, and no cloud.",
            degrees(angle_deg),
            focal_text(question.focal * focal_factor)
        ),
        Verdict::Narrow(angle_deg) => format!(
            "The camera hardly moved: {inliers} of {matches} matches agree, but their rays meet at \
             only {}. That is too narrow for depth.",
            degrees(angle_deg)
        ),
        Verdict::Good | Verdict::Plane | Verdict::Lens => return None,
    })
}

/// Returns a warning about the cloud, if any.
fn caution(answer: &Answer) -> &'static str {
    match answer.verdict {
        Verdict::Plane => {
            " One homography explains most matches: they lie in one plane, or the camera only turned. The \
             motion is uncertain."
        }
        Verdict::Lens => " F fits more matches than any E: the focal length may be wrong.",
        _ => "",
    }
}

/// Describes the perturbation of camera 2, before and after bundle adjustment.
fn knocks(knock_deg: f64) -> (String, String) {
    let knock = format_number(knock_deg, 1);
    match knock_deg > 0.0 {
        true => (
            format!("Camera 2 has been knocked {knock}° askew."),
            format!("Camera 2 had been knocked {knock}° askew."),
        ),
        false => (
            "Camera 2 stands as RANSAC has it.".to_owned(),
            "Camera 2 had not been knocked.".to_owned(),
        ),
    }
}

/// Returns the reason why there are no dense points although the cameras are known.
pub(super) fn no_surface(answer: &Answer) -> Option<String> {
    let motion = answer.motion.as_ref()?;
    let error = motion.surface.as_ref().err()?;
    let [first, second] = answer.pictures.each_ref().map(|picture| picture.size());
    let why = match first == second {
        true => error.to_string(),
        false => format!(
            "that takes two photographs of the same size, but these have {} × {} and {} × {} pixels",
            first.0, first.1, second.0, second.1
        ),
    };
    Some(format!(
        "There is no depth for every pixel: {why}. The {} points of the matches are all there is.",
        motion.points.len()
    ))
}

impl Words for TwoViewSfm {
    /// Reports every stage up to the current one. Later stages show a dash, so that every number
    /// keeps its position.
    fn readouts(&self) -> Vec<Readout> {
        let (stage, answer) = (self.stage(), self.answer());
        let unknown = if answer.is_some() || self.asked.problem().is_some() {
            "–"
        } else {
            "…"
        };
        let say = |id, label, from: Stage, text: Option<String>| {
            let text = text.filter(|_| stage >= from);
            Readout::words(id, label, text.unwrap_or_else(|| unknown.to_owned()))
        };
        let motion = answer.and_then(|answer| answer.motion.as_ref());
        let number = |value: f64, digits: usize, unit: &str| {
            format!("{}{unit}", format_number(value, digits))
        };
        let inliers = answer.map(|answer| match stage >= Stage::Ransac {
            true => format!("{} of {}", answer.num_inliers(), answer.matches.len()),
            false => format!("? of {}", answer.matches.len()),
        });
        let error = |index: usize| motion.map(|motion| number(motion.error_px[index], 2, " px"));
        let features = answer.map(|answer| {
            let [first, second] = answer.keypoints.each_ref().map(Vec::len);
            format!("{first} and {second}")
        });
        let matches = answer.map(|answer| answer.matches.len().to_string());
        let in_front = motion.map(|motion| motion.num_in_front.map(|n| n.to_string()).join(", "));
        let turn = self.turn_deg().map(|turn| number(turn, 2, "°"));
        let truth = self.true_turn_deg().map(|turn| number(turn, 2, "°"));
        let points = motion.map(|motion| match (&motion.surface, stage) {
            (Ok(surface), Stage::Surface) => surface.points.len().to_string(),
            _ => motion.points.len().to_string(),
        });
        let mut readouts = vec![
            say("inliers", "Inliers", Stage::Match, inliers).main(),
            say("points", "Points", Stage::Cloud, points).main(),
            say("error-before", "Error before", Stage::Cloud, error(0)).main(),
            say("error", "Error adjusted", Stage::Adjust, error(1)).main(),
            say("features", "Features", Stage::Detect, features),
            say("matches", "Matches", Stage::Match, matches),
            say("in-front", "In front", Stage::Pose, in_front),
            say("rotation", "Rotation", Stage::Pose, turn),
            say("truth", "True rotation", Stage::Pose, truth),
        ];
        if self.is_own() {
            let from = match self.focal_from() {
                FocalFrom::Known | FocalFrom::Reader => "as you set it",
                FocalFrom::File => "from the file",
                FocalFrom::Guess => "a guess",
            };
            let text = format!("{}, {from}", focal_text(self.focal()));
            readouts.push(Readout::words("lens", "Focal length", text));
        }
        let from = self.orbit.seen_from();
        readouts.push(Readout::words("viewpoint", "Seen from", from));
        readouts
    }

    fn describe(&self) -> String {
        let (Some((question, answer)), None) = (self.asked.answered(), self.asked.problem()) else {
            return self.asked.sentence();
        };
        let stage = self.stage();
        let (matches, inliers) = (answer.matches.len(), answer.num_inliers());
        let counts = answer.keypoints.each_ref().map(Vec::len);
        let turn = degrees(self.turn_deg().unwrap_or(0.0));
        let (before, ago) = knocks(self.knock_deg());
        match (stage, failure((question, answer)), &answer.motion) {
            (Stage::Detect, ..) => format!(
                "{} features in the first photograph and {} in the second.",
                counts[0], counts[1]
            ),
            (Stage::Match, ..) => {
                format!("{matches} features of the first photograph have a partner in the second.")
            }
            (_, Some(failure), _) => failure,
            (_, None, None) => format!("{}.", Question::FAILED),
            (Stage::Ransac, ..) => format!(
                "{inliers} of {matches} matches agree with one motion of the camera; the other {} are \
                 dropped.",
                matches - inliers
            ),
            (Stage::Pose, _, Some(motion)) => {
                let [first, others @ ..] = motion.num_in_front;
                let others = others.map(|count| count.to_string()).join(", ");
                format!(
                    "Camera 2 is turned by {turn} against camera 1. Of the four poses that E allows, one \
                     puts {first} of {inliers} points in front of both cameras, the others {others}.{}",
                    caution(answer)
                )
            }
            (Stage::Cloud, _, Some(motion)) => format!(
                "{before} {} points, triangulated {}, miss their features by {} px (RMS).",
                motion.points.len(),
                if self.knock_deg() > 0.0 {
                    "all the same"
                } else {
                    "with it"
                },
                format_number(motion.error_px[0], 2),
            ),
            (Stage::Surface, _, Some(motion)) => match &motion.surface {
                Ok(surface) => format!(
                    "{} pixels of photograph 1 found their partner in photograph 2, and stand in space in their own \
                     colors, seen from {}. {ago}{}",
                    surface.points.len(),
                    self.orbit.words(),
                    caution(answer)
                ),
                Err(_) => no_surface(answer).unwrap_or_default(),
            },
            (Stage::Adjust, _, Some(motion)) => format!(
                "{} points in color and the two cameras, seen from {}. {ago} The adjustment takes the error from {} px to \
                 {} px (RMS).{}",
                motion.points.len(),
                self.orbit.words(),
                format_number(motion.error_px[0], 2),
                format_number(motion.error_px[1], 2),
                caution(answer)
            ),
        }
    }
}
