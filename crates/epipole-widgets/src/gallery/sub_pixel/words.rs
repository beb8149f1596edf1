//! Readouts and description of `sub-pixel`.

use super::model::SubPixel;
use super::patch::CORNER;
use crate::contract::{Readout, Words, format_number};

impl Words for SubPixel {
    fn readouts(&self) -> Vec<Readout> {
        let state = self.state();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or("no corner")
        };
        let corner = state.corner();
        vec![
            number("error", "Error", state.error_px(), 3, "px").main(),
            number(
                "start-error",
                "Start off",
                Some((state.path[0] - CORNER).norm()),
                2,
                "px",
            )
            .main(),
            number(
                "steps",
                "Steps",
                corner.map(|_| state.path.len() as f64 - 1.0),
                0,
                "",
            )
            .main(),
            number("column", "Column", corner.map(|corner| corner.x), 2, ""),
            number("row", "Row", corner.map(|corner| corner.y), 2, ""),
        ]
    }

    fn describe(&self) -> String {
        let state = self.state();
        let digits = |value: f64| format_number(value, 2);
        let window = 2 * self.half() + 1;
        match (state.corner(), state.error_px()) {
            (Some(corner), Some(error)) => format!(
                "A corner of a chessboard in pixels, at column {}, row {}. From {} px away, {} steps with a window of \
                 {window} px lead to column {}, row {}, {} px off.",
                digits(CORNER.x),
                digits(CORNER.y),
                digits((state.path[0] - CORNER).norm()),
                state.path.len() - 1,
                digits(corner.x),
                digits(corner.y),
                format_number(error, 3),
            ),
            _ => format!(
                "A corner of a chessboard in pixels. From the start, {} px away, a window of {window} px finds no corner.",
                digits((state.path[0] - CORNER).norm()),
            ),
        }
    }
}
