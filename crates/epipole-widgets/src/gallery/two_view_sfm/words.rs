//! What `two-view-sfm` says: readouts, description, sentences.

use super::answer::{Answer, Motion, Verdict};
use super::model::{FocalFrom, Stage, TwoViewSfm};
use super::pipeline::MIN_NUM_MATCHES;
use crate::contract::{Readout, format_number};

pub(super) const WAITING: &str = "Following the pipeline";
pub(super) const NO_PHOTOGRAPHS: &str =
    "Choose two photographs of the same thing, taken a step apart.";
pub(super) const ONE_PHOTOGRAPH: &str =
    "One photograph is there. Choose the other one, of the same thing, taken a step aside.";
pub(super) const NO_ANSWER: &str = "The motion could not be computed.";

/// A problem as a sentence.
pub(super) fn sentence(problem: &str) -> String {
    let mut letters = problem.chars();
    let first: String = letters
        .next()
        .map_or(String::new(), |c| c.to_uppercase().collect());
    format!("{first}{}.", letters.as_str())
}

/// A focal length in units of the longer side, and the lens that a full-frame camera would have.
pub(super) fn focal(value: f64) -> String {
    let mm = format_number(36.0 * value, 0);
    format!("{} (as {mm} mm)", format_number(value, 2))
}

fn degrees(value: f64) -> String {
    format!("{}°", format_number(value, 1))
}

/// What went wrong, if there is no cloud.
pub(super) fn failure(answer: &Answer) -> Option<String> {
    let (matches, inliers) = (answer.matches.len(), answer.num_inliers());
    Some(match answer.verdict {
        Verdict::TooFew => format!(
            "Only {matches} features match, and fewer than {MIN_NUM_MATCHES} tell nothing. Do both \
             photographs show the same thing?"
        ),
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
        Verdict::Narrow(angle_deg) => format!(
            "The camera hardly moved: {inliers} of {matches} matches agree, but their rays meet at \
             only {}. That is too narrow for depth.",
            degrees(angle_deg)
        ),
        Verdict::Good | Verdict::Plane | Verdict::Lens => return None,
    })
}

/// What the reader should know of a cloud that is there.
fn caution(answer: &Answer) -> &'static str {
    match answer.verdict {
        Verdict::Plane => " Most matches lie in one plane, so the motion is less certain.",
        Verdict::Lens => " F fits more matches than any E: the focal length may be wrong.",
        _ => "",
    }
}

fn turn_deg(motion: &Motion) -> f64 {
    motion.cam2_from_cam1().rotation.angle().to_degrees()
}

pub(super) fn readouts(model: &TwoViewSfm) -> Vec<Readout> {
    let mut readouts = Vec::new();
    match (model.answer(), model.problem()) {
        (Some(answer), _) => stages(model, answer, &mut readouts),
        (None, Some(problem)) => readouts.push(Readout::words("state", "State", problem)),
        (None, None) => awaited(model, &mut readouts),
    }
    if model.is_own() {
        let from = match model.focal_from() {
            FocalFrom::Known | FocalFrom::Reader => "as you set it",
            FocalFrom::File => "from the file",
            FocalFrom::Guess => "a guess",
        };
        let text = format!("{}, {from}", focal(model.focal()));
        readouts.push(Readout::words("lens", "Focal length", text));
    }
    let zoom = format_number(model.zoom(), 1);
    let from = format!("{}, {zoom} ×", model.orbit().words());
    readouts.push(Readout::words("viewpoint", "Seen from", from));
    readouts
}

/// The readouts of the stages before anything is found: a page may show the finished picture beside
/// them, and nothing should jump when their values come.
fn awaited(model: &TwoViewSfm, readouts: &mut Vec<Readout>) {
    let rows = [
        (Stage::Detect, "features", "Features"),
        (Stage::Match, "matches", "Matches"),
        (Stage::Ransac, "inliers", "Inliers"),
        (Stage::Pose, "rotation", "Rotation"),
        (Stage::Pose, "truth", "True rotation"),
        (Stage::Pose, "in-front", "In front, four poses"),
        (Stage::Cloud, "points", "Points"),
        (Stage::Cloud, "error", "Error, RMS"),
        (Stage::Cloud, "error-before", "Before adjustment"),
    ];
    for (stage, id, label) in rows {
        let is_untold = id == "truth" && model.true_turn_deg().is_none();
        if model.stage() >= stage && !is_untold {
            readouts.push(Readout::words(id, label, "…"));
        }
    }
}

/// What each stage up to the present one has found.
fn stages(model: &TwoViewSfm, answer: &Answer, readouts: &mut Vec<Readout>) {
    let stage = model.stage();
    let counts = answer.keypoints.each_ref().map(Vec::len);
    let features = format!("{} and {}", counts[0], counts[1]);
    readouts.push(Readout::words("features", "Features", features));
    if stage >= Stage::Match {
        readouts.push(Readout::count("matches", "Matches", answer.matches.len()));
    }
    if stage >= Stage::Ransac {
        let share = 100.0 * answer.num_inliers() as f64 / answer.matches.len().max(1) as f64;
        let inliers = format!("{} ({} %)", answer.num_inliers(), format_number(share, 0));
        readouts.push(Readout::words("inliers", "Inliers", inliers));
    }
    let Some(motion) = answer.motion.as_ref().filter(|_| stage >= Stage::Pose) else {
        return;
    };
    readouts.push(Readout::number(
        "rotation",
        "Rotation",
        turn_deg(motion),
        2,
        "°",
    ));
    if let Some(angle_deg) = model.true_turn_deg() {
        readouts.push(Readout::number("truth", "True rotation", angle_deg, 2, "°"));
    }
    let counts = motion.num_in_front.map(|count| count.to_string());
    readouts.push(Readout::words(
        "in-front",
        "In front, four poses",
        counts.join(", "),
    ));
    if stage == Stage::Cloud {
        readouts.push(Readout::count("points", "Points", motion.points.len()));
        let [before_px, after_px] = motion.error_px;
        readouts.push(Readout::number("error", "Error, RMS", after_px, 3, "px"));
        readouts.push(Readout::number(
            "error-before",
            "Before adjustment",
            before_px,
            3,
            "px",
        ));
    }
}

pub(super) fn describe(model: &TwoViewSfm) -> String {
    if let Some(problem) = model.problem() {
        return problem.to_owned();
    }
    let Some(answer) = model.answer() else {
        return format!("{WAITING}.");
    };
    let stage = model.stage();
    let (matches, inliers) = (answer.matches.len(), answer.num_inliers());
    let counts = answer.keypoints.each_ref().map(Vec::len);
    match (stage, failure(answer), &answer.motion) {
        (Stage::Detect, ..) => format!(
            "{} features in the first photograph and {} in the second.",
            counts[0], counts[1]
        ),
        (Stage::Match, ..) => {
            format!("{matches} features of the first photograph have a partner in the second.")
        }
        (_, Some(failure), _) => failure,
        (_, None, None) => NO_ANSWER.to_owned(),
        (Stage::Ransac, ..) => format!(
            "{inliers} of {matches} matches agree with one motion of the camera; the other {} are \
             dropped.",
            matches - inliers
        ),
        (Stage::Pose, _, Some(motion)) => {
            let [first, others @ ..] = motion.num_in_front;
            let others = others.map(|count| count.to_string()).join(", ");
            format!(
                "Camera 2 is turned by {} against camera 1. Of the four poses that E allows, one \
                 puts {first} of {inliers} points in front of both cameras, the others {others}.{}",
                degrees(turn_deg(motion)),
                caution(answer)
            )
        }
        (_, _, Some(motion)) => format!(
            "{} points in color and the two cameras, seen from {}. Projections miss their \
             features by {} px (RMS).{}",
            motion.points.len(),
            model.orbit().words(),
            format_number(motion.error_px[1], 2),
            caution(answer)
        ),
    }
}
