//! What `scale-space` says.

use super::model::ScaleSpace;
use super::question::Question;
use crate::contract::{Readout, Words, format_number};
use crate::kit::question::Question as _;

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
        vec![
            match extremum {
                Some(found) => Readout::number("peak", "Extremum σ", found.sigma_px, 1, "px"),
                None => Readout::words("peak", "Extremum σ", "none"),
            }
            .main(),
            Readout::words("kind", "Found there", kind).main(),
            Readout::number("now", "Difference", now, 1, "levels").main(),
            Readout::number(
                "strongest",
                "Strongest answer",
                extremum.map_or(0.0, |found| found.value),
                1,
                "levels",
            ),
        ]
    }

    fn describe(&self) -> String {
        if let Some(problem) = self.asked.problem() {
            return problem.to_owned();
        }
        let Some(now) = self.now() else {
            return format!("{}.", Question::LABEL);
        };
        let (u, v) = self.place();
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
