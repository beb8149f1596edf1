//! What `ransac-line` says.

use super::model::RansacLine;
use super::question::NUM_RUNS;
use crate::contract::{Readout, Words, format_number};
use crate::kit::line_points::Consensus;

impl Words for RansacLine {
    fn readouts(&self) -> Vec<Readout> {
        let tally = self.tally().ok();
        let votes = |consensus: Option<&Consensus>| match consensus {
            Some(consensus) => consensus.num_votes().to_string(),
            None => "none yet".to_owned(),
        };
        let of = |get: fn(&super::tally::Tally) -> Option<&Consensus>| votes(tally.and_then(get));
        let none = || {
            [
                ("iterations", "Samples drawn"),
                ("budget", "Samples needed"),
            ]
            .map(|(id, label)| Readout::words(id, label, "none"))
        };
        let [drawn, needed] = tally.map_or_else(none, |tally| tally.samples.drawn().readouts());
        let (runs, kind) = (self.runs(), self.kind());
        let number = |id, label, value: Option<f64>, digits, unit| match value {
            Some(value) => Readout::number(id, label, value, digits, unit),
            None => Readout::words(id, label, "none yet"),
        };
        let near = runs.map(|runs| runs.num_near(kind) as f64);
        let median = runs.and_then(|runs| runs.median_deg(kind));
        let mean = runs.and_then(|runs| runs.mean_samples(kind));
        vec![
            Readout::words("inliers", "Votes now", of(|tally| tally.candidate.as_ref())).main(),
            Readout::words("best", "Best votes", of(|tally| tally.best.as_ref())).main(),
            needed.main(),
            number("near", "Runs within 1°", near, 0, "").main(),
            drawn,
            number("error", "Off by", self.error_deg(), 1, "°"),
            Readout::words("truth-votes", "Hidden line", of(|tally| Some(&tally.truth))),
            number("median", "Median error", median, 2, "°"),
            number("samples", "Mean samples", mean, 1, ""),
        ]
    }

    fn describe(&self) -> String {
        let tally = match self.tally() {
            Ok(tally) => tally,
            Err(sentence) => return sentence.to_owned(),
        };
        let count = self.scattered().points.len();
        let Some((candidate, best)) = tally.candidate.as_ref().zip(tally.best.as_ref()) else {
            return format!(
                "{count} points, about half of the outliers in one region. No sample yet."
            );
        };
        let runs = match self.runs() {
            Some(runs) => format!(
                " Of {NUM_RUNS} runs on other points, {} end within 1°.",
                runs.num_near(self.kind())
            ),
            None => String::new(),
        };
        format!(
            "Sample {}: {} of {count} points lie within {} px of its line and vote for it. The best line so \
             far has {} votes and is {}° from the hidden one. {}{runs}",
            tally.samples.count(),
            candidate.num_votes(),
            format_number(self.epsilon_px(), 0),
            best.num_votes(),
            format_number(self.error_deg().unwrap_or(0.0), 1),
            tally.samples.drawn().outlook(),
        )
    }
}
