//! Readouts and description of `scale-drift`.

use super::model::ScaleDrift;
use super::question::{Judged, Kind, Question};
use crate::contract::{Readout, Words, format_number};
use crate::kit::question::Question as _;

fn steps(length: f64) -> String {
    format!("{} steps", format_number(length, 2))
}

fn times(scale: f64) -> String {
    format!("{} ×", format_number(scale, 2))
}

fn percent(share: f64) -> String {
    let value = 100.0 * share;
    format!(
        "{}%",
        format_number(value, if value < 9.95 { 1 } else { 0 })
    )
}

fn error(model: &ScaleDrift, judged: &Judged) -> String {
    match judged.error {
        Some(error) => steps(error),
        None if model.asked.is_waiting() => "…".to_owned(),
        None => "none yet on a straight line".to_owned(),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

impl Words for ScaleDrift {
    fn readouts(&self) -> Vec<Readout> {
        let before = &self.before;
        // Readouts without a value keep their position.
        let missing = self.asked.missing();
        let closed =
            |say: &dyn Fn(&Judged) -> String| self.after().map_or_else(|| missing.to_owned(), say);
        let error = |judged: &Judged| judged.error.map_or_else(|| missing.to_owned(), steps);
        let scale = |judged: &Judged| times(judged.scale_at_end());
        let gap = |judged: &Judged| match self.is_home() {
            true => steps(judged.gap()),
            false => "not home yet".to_owned(),
        };
        let worst = |judged: &Judged| percent(judged.worst_scale());
        let loop_says = match (self.seen(), self.kind()) {
            (None, _) if self.is_home() => missing.to_owned(),
            (None, _) => "not home yet".to_owned(),
            (Some(_), None) => "not asked".to_owned(),
            (Some(seen), Some(Kind::Similarity)) => {
                format!("home again, {} as large", times(seen))
            }
            (Some(_), Some(Kind::Rigid)) => "home again, nothing of scale".to_owned(),
        };
        vec![
            Readout::words("error-before", "Error, odometry", error(before)).main(),
            Readout::words("error", "Error, closed", closed(&error)).main(),
            Readout::words("scale-before", "Scale, odometry", scale(before)).main(),
            Readout::words("scale", "Scale, closed", closed(&scale)).main(),
            Readout::words("gap-before", "Gap, odometry", gap(before)),
            Readout::words("gap", "Gap, closed", closed(&gap)),
            Readout::words("worst-before", "Worst, odometry", worst(before)),
            Readout::words("worst", "Worst, closed", closed(&worst)),
            Readout::words("loop", "Loop says", loop_says),
        ]
    }

    fn describe(&self) -> String {
        let before = &self.before;
        let who = match self.is_metric() {
            true => "A stereo rig".to_owned(),
            false => format!(
                "One camera, whose scale drifts by {}% a step,",
                format_number(self.drift_percent(), 1)
            ),
        };
        let (traveled, all) = (self.traveled(), self.num_steps());
        let size = match self.is_metric() {
            true => String::new(),
            false => format!(
                "everything comes out {} as large as at first",
                times(before.scale_at_end())
            ),
        };
        if !self.is_home() {
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
        let ending = match (self.after(), self.kind()) {
            _ if self.asked.is_waiting() => format!("{}.", Question::LABEL),
            _ if self.asked.problem().is_some() => {
                self.asked.problem().unwrap_or_default().to_owned()
            }
            (Some(after), Some(kind)) => {
                let means = match kind {
                    Kind::Rigid => "rigid motions",
                    Kind::Similarity => "similarities",
                };
                format!(
                    "Closing the loop with {means} takes the trajectory error from {} to {} (RMS) and \
                     leaves the scale of the last frame at {}.",
                    error(self, before),
                    error(self, after),
                    format_number(after.scale_at_end(), 2)
                )
            }
            _ => format!(
                "The loop stays open, with a trajectory error of {} (RMS).",
                error(self, before)
            ),
        };
        format!("{who} goes {all} steps around a block. Back home, {home}. {ending}")
    }
}
