//! Readouts and description of `column-sizes`.

use super::model::{Both, ColumnSizes};
use crate::contract::{Readout, Words, format_number};

/// Formats a ratio, such as 3.2, 41 or 52 000.
fn times(ratio: f64) -> String {
    match ratio {
        ratio if ratio < 10.0 => format_number(ratio, 1),
        ratio => format_number(ratio, 0),
    }
}

impl Words for ColumnSizes {
    fn readouts(&self) -> Vec<Readout> {
        let both = self.both().ok();
        let ratio = |id, label, get: fn(&Both) -> f64, digits| {
            Readout::number(id, label, both.map(get), digits, "").or("no columns")
        };
        vec![
            ratio("raw", "Raw ratio", |both| both.raw.spread(), 0).main(),
            ratio(
                "normalized",
                "Normalized ratio",
                |both| both.normalized.spread(),
                1,
            )
            .main(),
            ratio("first", "Raw u′u", |both| both.raw.0[0], 0),
        ]
    }

    fn describe(&self) -> String {
        match self.both() {
            Ok(both) => format!(
                "The nine columns of the equations of {} matches in images {} px wide. In raw pixels the largest \
                 column is {} times as large as the smallest; normalized, {} times.",
                self.count(),
                format_number(self.width_px(), 0),
                times(both.raw.spread()),
                times(both.normalized.spread())
            ),
            Err(sentence) => sentence.to_owned(),
        }
    }
}
