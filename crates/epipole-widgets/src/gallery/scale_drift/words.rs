//! What `scale-drift` says: readouts and description.

use super::answer::{Answer, Judged};
use super::closing::Kind;
use super::model::ScaleDrift;
use super::request::WAITING;
use crate::contract::{Readout, format_number};

/// What is said if a worker's answer makes no sense.
pub(super) const NO_ANSWER: &str = "The path could not be judged.";

fn steps(length: f64) -> String {
    format!("{} steps", format_number(length, 2))
}

fn times(scale: f64) -> String {
    format!("{} ×", format_number(scale, 2))
}

fn percent(share: f64) -> String {
    let value = 100.0 * share;
    format!(
        "{} %",
        format_number(value, if value < 9.95 { 1 } else { 0 })
    )
}

fn error(model: &ScaleDrift, judged: &Judged) -> String {
    match judged.error {
        Some(error) => steps(error),
        None if model.is_waiting() => "…".to_owned(),
        None => "none yet on a straight line".to_owned(),
    }
}

/// What it is now, and what it was before the loop was closed.
fn pair(answer: &Answer, say: impl Fn(&Judged) -> String) -> String {
    let before = say(&answer.before);
    match &answer.after {
        Some(Ok(after)) => format!("{} (before: {before})", say(after)),
        _ => before,
    }
}

pub(super) fn readouts(model: &ScaleDrift) -> Vec<Readout> {
    let answer = model.answer();
    let gap = match model.is_home() {
        true => pair(answer, |judged| steps(judged.gap())),
        false => "not home yet".to_owned(),
    };
    let loop_says = match (answer.seen, model.kind()) {
        (None, _) if model.is_home() => "…".to_owned(),
        (None, _) => "not home yet".to_owned(),
        (Some(_), None) => "not asked".to_owned(),
        (Some(seen), Some(Kind::Similarity)) => {
            format!("home again, {} as large", times(seen))
        }
        (Some(_), Some(Kind::Rigid)) => "home again, nothing of scale".to_owned(),
    };
    let mut readouts = vec![
        Readout::words(
            "scale",
            "Scale of the last frame",
            pair(answer, |judged| times(judged.scale_at_end())),
        ),
        Readout::words("gap", "Gap on coming home", gap),
        Readout::words(
            "error",
            "Trajectory error (aligned, RMS)",
            pair(answer, |judged| error(model, judged)),
        ),
        Readout::words(
            "worst",
            "Largest error of scale",
            pair(answer, |judged| percent(judged.worst_scale())),
        ),
        Readout::words("loop", "The loop says", loop_says),
    ];
    if let Some(Err(problem)) = &answer.after {
        readouts.push(Readout::words("problem", "Problem", problem.clone()));
    }
    readouts
}

pub(super) fn describe(model: &ScaleDrift) -> String {
    let answer = model.answer();
    let before = &answer.before;
    let who = match model.is_metric() {
        true => "A stereo rig".to_owned(),
        false => format!(
            "One camera, whose scale drifts by {} % a step,",
            format_number(model.drift_percent(), 1)
        ),
    };
    let (traveled, all) = (model.traveled(), model.num_steps());
    let size = match model.is_metric() {
        true => String::new(),
        false => format!(
            "everything comes out {} as large as at first",
            times(before.scale_at_end())
        ),
    };
    if !model.is_home() {
        let size = if size.is_empty() {
            size
        } else {
            format!("{size}. ")
        };
        return format!(
            "{who} has gone {traveled} of {all} steps around a block. {}It is not home yet, so there \
             is no loop to close.",
            capital(&size)
        );
    }
    let gap = steps(before.gap());
    let home = match size.is_empty() {
        true => format!("the path misses the start by {gap}"),
        false => format!("{size}, and the path misses the start by {gap}"),
    };
    let ending = match (&answer.after, model.kind()) {
        _ if model.is_waiting() => format!("{WAITING}."),
        (Some(Err(problem)), _) => problem.clone(),
        (Some(Ok(after)), Some(kind)) => {
            let means = match kind {
                Kind::Rigid => "rigid motions",
                Kind::Similarity => "similarities",
            };
            format!(
                "Closing the loop with {means} takes the trajectory error from {} to {} (RMS) and \
                 leaves the scale of the last frame at {}.",
                error(model, before),
                error(model, after),
                format_number(after.scale_at_end(), 2)
            )
        }
        _ => format!(
            "The loop stays open, with a trajectory error of {} (RMS).",
            error(model, before)
        ),
    };
    format!("{who} goes {all} steps around a block. Back home, {home}. {ending}")
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
