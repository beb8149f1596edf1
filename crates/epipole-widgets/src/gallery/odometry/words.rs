//! Readouts and description of `odometry`.

use super::model::OdometryFigure;
use crate::contract::{Readout, Words, format_number};

/// Millimeters per meter.
const MM: f64 = 1000.0;

impl Words for OdometryFigure {
    fn readouts(&self) -> Vec<Readout> {
        let missing = self.asked.missing();
        let answer = self.answer();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        let index = self.frame();
        let here = answer.and_then(|answer| self.error_m(index, answer.frames.get(index)?));
        let text = |words: Option<String>| words.unwrap_or_else(|| missing.to_owned());
        let placed =
            answer.map(|answer| format!("{} of {}", answer.num_placed(), answer.frames.len()));
        let keyframes = answer.map(|answer| {
            let keyframes = answer.frames.iter().filter(|frame| frame.is_keyframe);
            keyframes.count().to_string()
        });
        vec![
            number(
                "error",
                "Path error",
                answer.map(|a| MM * a.error_m),
                1,
                "mm",
            )
            .main(),
            number("here", "Off here", here.map(|error| MM * error), 1, "mm").main(),
            Readout::words("placed", "Frames placed", text(placed)).main(),
            Readout::words("keyframes", "Keyframes", text(keyframes)),
            number(
                "unit",
                "One unit",
                answer.map(|answer| answer.scale),
                3,
                "m",
            ),
            Readout::words(
                "frame",
                "Frame",
                format!("{} of {}", index + 1, self.last() + 1),
            ),
        ]
    }

    fn describe(&self) -> String {
        let Some(answer) = self.answer() else {
            return self.asked.sentence();
        };
        format!(
            "Frame {} of {}. The path has {} of {} frames and {} points; scaled onto the true one, it is {} mm \
             from it, root mean square. Seen from {}.",
            self.frame() + 1,
            self.last() + 1,
            answer.num_placed(),
            answer.frames.len(),
            answer.points.len(),
            format_number(MM * answer.error_m, 1),
            self.orbit.seen_from(),
        )
    }
}
