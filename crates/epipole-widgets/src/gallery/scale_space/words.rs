//! Readouts and description of `scale-space`.

use super::model::ScaleSpace;
use crate::contract::{Readout, Words, format_number};

impl Words for ScaleSpace {
    fn readouts(&self) -> Vec<Readout> {
        let Some(now) = self.now() else {
            return vec![Readout::words("peak", "Extremum σ", "none yet").main()];
        };
        let extremum = self.extremum();
        let kind = match extremum.map(|found| found.value < 0.0) {
            Some(true) => "bright",
            Some(false) => "dark",
            None => "nothing",
        };
        let peak_px = extremum.map(|found| found.sigma_px);
        let strongest = extremum.map_or(0.0, |found| found.value);
        let levels = |id, label, value: f64| Readout::number(id, label, value, 1, "levels");
        vec![
            Readout::number("peak", "Extremum σ", peak_px, 1, "px")
                .or("none")
                .main(),
            Readout::words("kind", "Found there", kind).main(),
            levels("now", "Difference", now).main(),
            levels("strongest", "Strongest answer", strongest),
        ]
    }

    fn describe(&self) -> String {
        let Some(now) = self.now() else {
            return self.asked.sentence();
        };
        let (u, v) = self.probe.place();
        let peak = self.extremum().map_or_else(
            || "no blur gives more than its neighbors".to_owned(),
            |found| {
                format!(
                    "the difference is strongest at σ = {} px, the size of something {}",
                    format_number(found.sigma_px, 1),
                    if found.value < 0.0 { "bright" } else { "dark" }
                )
            },
        );
        format!(
            "At column {u}, row {v} {peak}. At σ = {} px the difference of Gaussians is {} gray levels.",
            format_number(self.sigma_px(), 1),
            format_number(now, 1)
        )
    }
}
