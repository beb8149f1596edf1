//! Readouts and description of `bundle-adjustment`.

use super::model::BundleAdjustment;
use crate::contract::{Readout, Words, format_number};
use crate::kit::house::NUM_CAMERAS;
use crate::kit::words::magnitude;

fn percent(share: f64) -> String {
    let value = 100.0 * share;
    format_number(value, if value < 0.995 { 2 } else { 1 })
}

/// Number of leading rows that are main readouts.
const NUM_MAIN: usize = 4;
const ROWS: [(&str, &str); 8] = [
    ("error", "Error now"),
    ("error-start", "Start error"),
    ("off", "House off"),
    ("off-start", "Start off"),
    ("cost", "Cost"),
    ("damping-now", "Damping λ"),
    ("unknowns", "Unknowns"),
    ("measured", "Measured numbers"),
];

fn values(model: &BundleAdjustment) -> Option<[String; 8]> {
    let ([start, now], answer) = (model.states()?, model.asked.answer()?);
    let num_unknowns = 6 * NUM_CAMERAS + 3 * answer.features.len();
    let pixels = |value: f64| format!("{} px", magnitude(value, 1e3));
    let width = |share: f64| format!("{}%", percent(share));
    let loss = match model.is_robust() {
        true => "Huber's loss",
        false => "squares",
    };
    Some([
        pixels(now.rms_px),
        pixels(start.rms_px),
        width(now.off),
        width(start.off),
        format!("{} px², {loss}", magnitude(now.cost, 1e6)),
        magnitude(now.damping, 1.0),
        format!("{num_unknowns}, 7 of them free"),
        format_number(2.0 * answer.num_observations as f64, 0),
    ])
}

impl Words for BundleAdjustment {
    fn readouts(&self) -> Vec<Readout> {
        // The rows exist before the result, so that the layout does not jump.
        let unknown = self.asked.missing();
        let found = values(self).unwrap_or_else(|| ROWS.map(|_| unknown.to_owned()));
        let rows = ROWS.into_iter().zip(found).enumerate();
        let row = |(index, ((id, label), text)): (usize, ((_, _), String))| {
            Readout::words(id, label, text).main_if(index < NUM_MAIN)
        };
        let mut readouts: Vec<Readout> = rows.map(row).collect();
        let from = self.orbit.seen_from();
        readouts.push(Readout::words("viewpoint", "Seen from", from));
        readouts
    }

    fn describe(&self) -> String {
        let known = (self.states(), self.asked.answer(), self.asked.problem());
        let (Some([start, now]), Some(answer), None) = known else {
            return self.asked.sentence();
        };
        let pixels = |value: f64| magnitude(value, 1e3);
        let taken = self.num_taken();
        if taken == 0 {
            return format!(
                "{NUM_CAMERAS} cameras and a house of {} points, all disturbed: the points are shown \
                 {} px from their features (RMS), and the house is off by {}% of its width.",
                answer.features.len(),
                pixels(now.rms_px),
                percent(now.off)
            );
        }
        let num_steps = answer.num_steps();
        let plural = if num_steps == 1 { "step" } else { "steps" };
        let end = match (self.is_finished(), answer.converged) {
            (true, true) => " The loop has converged.",
            (true, false) => " The loop has not converged.",
            _ if !now.accepted => " This step was refused, since it would have raised the cost.",
            _ => "",
        };
        format!(
            "After {taken} of {num_steps} {plural} the reprojection error is {} px (RMS) instead of {} px, \
             and the house, which was off by {}% of its width, is off by {}%.{end}",
            pixels(now.rms_px),
            pixels(start.rms_px),
            percent(start.off),
            percent(now.off)
        )
    }
}
