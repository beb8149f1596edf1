//! What `bundle-adjustment` says: readouts and description.

use super::model::BundleAdjustment;
use super::scene::NUM_CAMERAS;
use crate::contract::{Readout, format_number};
use crate::words::magnitude;

pub(super) const WAITING: &str = "Adjusting cameras and points";
pub(super) const NO_ANSWER: &str = "The adjustment could not be computed.";

fn percent(share: f64) -> String {
    let value = 100.0 * share;
    format_number(value, if value < 0.995 { 2 } else { 1 })
}

pub(super) fn readouts(model: &BundleAdjustment) -> Vec<Readout> {
    let mut readouts = Vec::new();
    if let Some(problem) = model.problem() {
        readouts.push(Readout::words("problem", "Problem", problem));
    } else {
        // Before the answer the rows are there already, so that nothing jumps when it comes.
        let found = values(model).unwrap_or_else(|| ROWS.map(|_| "…".to_owned()));
        for ((id, label), text) in ROWS.into_iter().zip(found) {
            readouts.push(Readout::words(id, label, text));
        }
    }
    let zoom = format_number(model.zoom(), 1);
    let from = format!("{}, {zoom} ×", model.orbit().words());
    readouts.push(Readout::words("viewpoint", "Seen from", from));
    readouts
}

const ROWS: [(&str, &str); 6] = [
    ("error", "Reprojection error, RMS"),
    ("off", "House off by"),
    ("cost", "Cost"),
    ("damping-now", "Damping λ of this step"),
    ("unknowns", "Unknowns"),
    ("measured", "Numbers measured"),
];

fn values(model: &BundleAdjustment) -> Option<[String; 6]> {
    let ([start, now], answer) = (model.states()?, model.answer()?);
    let num_unknowns = 6 * NUM_CAMERAS + 3 * answer.features.len();
    let pixels = |value: f64| magnitude(value, 1e3);
    let loss = match model.is_robust() {
        true => "Huber's loss",
        false => "squares",
    };
    Some([
        format!(
            "{} px (start: {})",
            pixels(now.rms_px),
            pixels(start.rms_px)
        ),
        format!(
            "{} % of its width (start: {})",
            percent(now.off),
            percent(start.off)
        ),
        format!("{} px², {loss}", magnitude(now.cost, 1e6)),
        magnitude(now.damping, 1.0),
        format!("{num_unknowns}, 7 of them free"),
        format_number(2.0 * answer.num_observations as f64, 0),
    ])
}

pub(super) fn describe(model: &BundleAdjustment) -> String {
    if let Some(problem) = model.problem() {
        return problem.to_owned();
    }
    let (Some([start, now]), Some(answer)) = (model.states(), model.answer()) else {
        return format!("{WAITING}.");
    };
    let pixels = |value: f64| magnitude(value, 1e3);
    let taken = model.num_taken();
    if taken == 0 {
        return format!(
            "{NUM_CAMERAS} cameras and a house of {} points, all disturbed: the points are shown \
             {} px from their features (RMS), and the house is off by {} % of its width.",
            answer.features.len(),
            pixels(now.rms_px),
            percent(now.off)
        );
    }
    let num_steps = answer.num_steps();
    let plural = if num_steps == 1 { "step" } else { "steps" };
    let end = match (model.is_finished(), answer.converged) {
        (true, true) => " The loop has converged.",
        (true, false) => " The loop has not converged.",
        _ if !now.accepted => " This step was refused, since it would have raised the cost.",
        _ => "",
    };
    format!(
        "After {taken} of {num_steps} {plural} the reprojection error is {} px (RMS) instead of {} px, \
         and the house, which was off by {} % of its width, is off by {} %.{end}",
        pixels(now.rms_px),
        pixels(start.rms_px),
        percent(start.off),
        percent(now.off)
    )
}
