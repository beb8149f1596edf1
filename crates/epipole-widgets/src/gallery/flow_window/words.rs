//! Readouts and description of `flow-window`.

use super::model::{FlowWindow, Shown};
use crate::contract::{Readout, Words, format_number};
use nalgebra::Vector2;

/// Factor from squared gray values in [0, 1] to squared gray levels.
const LEVELS_SQUARED: f64 = 255.0 * 255.0;

fn motion_words(motion: Vector2<f64>, digits: usize) -> String {
    let [du, dv] = [motion.x, motion.y].map(|number| format_number(number, digits));
    format!("({du}, {dv}) px")
}

impl Words for FlowWindow {
    fn readouts(&self) -> Vec<Readout> {
        let missing = self.asked.missing();
        let found = match (self.flow(), self.found()) {
            (Err(_), _) => missing.to_owned(),
            (Ok(_), None) => "lost".to_owned(),
            (Ok(_), Some(found)) => motion_words(found, 2),
        };
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        let flow = self.flow().ok();
        let eigenvalues = flow.map(|flow| flow.tensor.eigenvalues());
        let [large, small] = [
            eigenvalues.map(|(large, _)| large * LEVELS_SQUARED),
            eigenvalues.map(|(_, small)| small * LEVELS_SQUARED),
        ];
        let difference = flow.zip(self.found());
        let difference = difference.map(|(flow, found)| 255.0 * flow.difference(found));
        let first = flow.and_then(|flow| flow.path.get(1)).copied();
        let first = first.map_or(missing.to_owned(), |first| motion_words(first, 2));
        vec![
            Readout::words("found", "Motion found", found).main(),
            Readout::words("truth", "True motion", motion_words(self.setup().motion, 1)),
            number("error", "Off by", self.error_px(), 2, "px").main(),
            number("large", "λ₁", large, 1, "levels²"),
            number("small", "λ₂", small, 1, "levels²").main(),
            number("difference", "Difference left", difference, 1, "levels"),
            Readout::words("first", "First step", first),
        ]
    }

    fn describe(&self) -> String {
        let flow = match self.flow() {
            Ok(flow) => flow,
            Err(sentence) => return sentence.to_owned(),
        };
        let setup = self.setup();
        let side = 2 * setup.half + 1;
        let (large, small) = flow.tensor.eigenvalues();
        let [large, small] = [large, small].map(|value| format_number(value * LEVELS_SQUARED, 1));
        let followed = match self.found() {
            Some(found) => format!(
                "{} steps on {} of the pyramid find {}",
                setup.num_steps,
                match setup.num_levels {
                    1 => "one level".to_owned(),
                    many => format!("{many} levels"),
                },
                motion_words(found, 2),
            ),
            None => "the window is lost".to_owned(),
        };
        let shown = match self.shown() {
            Shown::Equations => "one line per pixel",
            Shown::Difference => "how much the windows differ",
        };
        format!(
            "A window of {side} by {side} px at {} moves by {}; {followed}. Its structure tensor has the \
             eigenvalues {large} and {small} per pixel. The plane of motions shows {shown}.",
            self.place.text(),
            motion_words(setup.motion, 1),
        )
    }
}
