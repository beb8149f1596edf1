//! Readouts and description of `scale-ambiguity`.

use super::model::ScaleAmbiguity;
use crate::contract::{Readout, Words, format_number};

impl Words for ScaleAmbiguity {
    fn readouts(&self) -> Vec<Readout> {
        let changes = self.changes_px();
        let change = |id, label, index: usize| {
            let change_px = changes.map(|changes| changes[index]);
            Readout::number(id, label, change_px, 1, "px").or("not seen")
        };
        let from = self.orbit.seen_from();
        vec![
            change("first", "Photo 1 change", 0).main(),
            change("second", "Photo 2 change", 1).main(),
            Readout::words("view", "Seen from", from),
        ]
    }

    fn describe(&self) -> String {
        let [house, baseline] = self.times().map(|times| format_number(times, 2));
        let photographs = match self.changes_px() {
            Some([0.0, 0.0]) => "Both photographs are exactly as they were.".to_owned(),
            Some([_, second]) => format!(
                "Photograph 1 is exactly as it was; in photograph 2 points move by up to {} px.",
                format_number(second, 0)
            ),
            None => "Part of the house is behind a camera now.".to_owned(),
        };
        format!(
            "The house is {house} times as large as before, the baseline {baseline} times as long. {photographs}"
        )
    }
}
