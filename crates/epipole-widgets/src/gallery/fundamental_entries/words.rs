//! Readouts and description of `fundamental-entries`.

use super::entries::Entries;
use super::model::FundamentalEntries;
use crate::contract::{Readout, Words, format_number};
use crate::kit::words;

/// Message while all nine entries are zero.
pub(super) const NO_LINES: &str = "All nine numbers are zero, and F draws no line.";

impl Words for FundamentalEntries {
    fn readouts(&self) -> Vec<Readout> {
        let known = self.entries().ok();
        let px = |id, label, value| Readout::number(id, label, value, 2, "px").or("no lines");
        let worded = |id, label, get: fn(&Entries) -> String| {
            Readout::words(id, label, known.map_or("no F".to_owned(), get))
        };
        let free = if self.change().has_rank2 {
            "7 = 9 − 1 − 1"
        } else {
            "8 = 9 − 1"
        };
        let miss = match (known, self.miss_px()) {
            (Some(entries), None) if entries.mean_px.is_some() => {
                Readout::words("miss", "Lines miss", "nearly parallel")
            }
            (_, miss_px) => px("miss", "Lines miss", miss_px),
        };
        let probe = "Probe's match";
        vec![
            px("mean", "Mean distance", self.mean_px()).main(),
            miss.main(),
            worded("det", "det F", |entries| {
                words::signed(entries.determinant(), 0.0)
            })
            .main(),
            Readout::words("free", "Free numbers", free).main(),
            match (self.probe_line(), self.probe_px()) {
                (Some(_), None) => Readout::words("probe-px", probe, "not seen"),
                (_, distance) => px("probe-px", probe, distance),
            },
            worded("norm", "‖F‖", |entries| {
                format_number(entries.numbers.norm(), 2)
            }),
            worded("third", "s₃ / s₁", |entries| {
                let [s1, _, s3] = entries.singular_values.into();
                words::magnitude(s3 / s1.max(f64::MIN_POSITIVE), 1.0)
            }),
            worded("f", "F, by rows", |entries| words::matrix(&entries.numbers)),
        ]
    }

    fn describe(&self) -> String {
        let entries = match self.entries() {
            Ok(entries) => entries,
            Err(sentence) => return sentence.to_owned(),
        };
        let Some(mean_px) = entries.mean_px else {
            return NO_LINES.to_owned();
        };
        let change = self.change();
        let coordinates = if change.is_normalized {
            "normalized coordinates"
        } else {
            "pixels"
        };
        let scaled = match change.scale {
            1.0 => String::new(),
            scale => format!(", all entries times {}", format_number(scale, 1)),
        };
        let rank2 = if change.has_rank2 {
            ", rank 2 enforced"
        } else {
            ""
        };
        let changed = match change.by.iter().filter(|by| **by != 0.0).count() {
            0 => "No entry is changed".to_owned(),
            1 => "One entry is changed".to_owned(),
            several => format!("{several} entries are changed"),
        };
        let meeting = match entries.meeting {
            Some(meeting) if meeting.is_exact() => "all lines meet in the epipole".to_owned(),
            Some(meeting) => format!(
                "the lines miss one another by {} px",
                format_number(meeting.miss_px, 2)
            ),
            None => "the lines are nearly parallel".to_owned(),
        };
        format!(
            "F in {coordinates}{scaled}{rank2}. {changed}; {}, the selected one, is {}. The matches are {} px \
             from their lines on average, and {meeting}.",
            self.selected_label(),
            words::signed(entries.numbers[self.selected_place()], 1.0),
            format_number(mean_px, 2),
        )
    }
}
