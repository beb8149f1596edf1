//! Readouts and description of `track`.

use super::model::TrackFigure;
use crate::contract::{Readout, Words, format_number};

impl Words for TrackFigure {
    fn readouts(&self) -> Vec<Readout> {
        let missing = self.asked.missing();
        let tally = (self.answer()).map(|answer| self.tally(answer, self.frame()));
        let count = |id, label, value: Option<usize>| {
            let text = value.map_or(missing.to_owned(), |value| value.to_string());
            Readout::words(id, label, text)
        };
        let frame = format!("{} of {}", self.frame() + 1, self.last() + 1);
        let median = tally.as_ref().and_then(|tally| tally.median_px);
        vec![
            count(
                "followed",
                "Followed",
                tally.as_ref().map(|t| t.num_followed),
            )
            .main(),
            count("wrong", "Wrong", tally.as_ref().map(|t| t.num_wrong)).main(),
            count("lost", "Lost", tally.as_ref().map(|t| t.num_lost)).main(),
            Readout::number("median", "Median error", median, 2, "px")
                .or(missing)
                .main(),
            Readout::words("frame", "Frame", frame),
        ]
    }

    fn describe(&self) -> String {
        let Some(answer) = self.answer() else {
            return self.asked.sentence();
        };
        let tally = self.tally(answer, self.frame());
        let median = tally.median_px.map_or(String::new(), |median| {
            format!(
                " Half of those that can be seen are within {} px of the truth.",
                format_number(median, 2)
            )
        });
        format!(
            "Frame {} of {}: {} of {} corners are still followed, {} of them to a wrong place.{median}",
            self.frame() + 1,
            self.last() + 1,
            tally.num_followed,
            answer.tracks.len(),
            tally.num_wrong,
        )
    }
}
