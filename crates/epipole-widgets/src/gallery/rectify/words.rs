//! Readouts and description of `rectify`.

use super::model::{Rectify, State};
use crate::contract::{Readout, Words, format_number};

impl Words for Rectify {
    fn readouts(&self) -> Vec<Readout> {
        let state = self.state().ok();
        let turned = state.map(|state| &state.turned);
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or("no pair")
        };
        let apart = turned.map(|turned| turned.apart_deg());
        let off = turned.map(|turned| turned.off_baseline_deg());
        let valid = turned.map(|turned| 100.0 * turned.valid_ratio());
        let seen = self.selected().filter(|(_, shown)| shown.is_seen);
        let own_px = seen.map(|(_, shown)| shown.rows_px());
        vec![
            number("rows", "Row offset", state.map(State::worst_px), 1, "px").main(),
            number("apart", "Headings apart", apart, 1, "°").main(),
            number("off", "Off baseline", off, 1, "°").main(),
            Readout::number("own", "Row p′ − row p", own_px, 1, "px").or("not seen"),
            number("valid", "Valid region", valid, 0, "%"),
        ]
    }

    fn describe(&self) -> String {
        let state = match self.state() {
            Ok(state) => state,
            Err(sentence) => return sentence.to_owned(),
        };
        let number = |value: f64| format_number(value, 1);
        let (worst, apart) = (state.worst_px(), state.turned.apart_deg());
        let mut words = match (self.is_rectified(), apart < 0.05) {
            (true, _) => format!(
                "The pair is rectified: both cameras look the same way, square to the baseline, and every \
                 match is in one row. The photographs fill {}% of the smaller frame.",
                format_number(100.0 * state.turned.valid_ratio(), 0)
            ),
            (false, true) => format!(
                "The cameras are parallel, but their rows are {}° off the baseline: matches are up to {} px \
                 from their rows.",
                number(state.turned.off_baseline_deg()),
                number(worst)
            ),
            (false, false) => format!(
                "The headings differ by {}°. Epipolar lines are tilted, and matches are up to {} px from \
                 their rows.",
                number(apart),
                number(worst)
            ),
        };
        if self.selected().is_none_or(|(_, shown)| !shown.is_seen) {
            words.push_str(" Photograph 2 does not show the chosen match.");
        }
        words
    }
}
