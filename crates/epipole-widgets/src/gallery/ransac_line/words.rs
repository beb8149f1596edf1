//! Readouts and description of `ransac-line`.

use super::model::RansacLine;
use super::question::NUM_RUNS;
use crate::contract::{Readout, Words, format_number};
use crate::kit::line_points::Consensus;
use crate::kit::samples::Drawn;
use crate::kit::tally::Tally;

impl Words for RansacLine {
    fn readouts(&self) -> Vec<Readout> {
        let tally = self.tally().ok();
        let votes = |id, label, get: fn(&Tally) -> Option<&Consensus>| {
            let votes = tally.and_then(get).map(|line| line.num_votes().to_string());
            Readout::words(id, label, votes.unwrap_or("none yet".to_owned()))
        };
        let drawn = tally.map(|tally| tally.samples.drawn());
        let [drawn, needed] = Drawn::readouts(drawn, "none");
        let (runs, kind) = (self.runs(), self.kind());
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or("none yet")
        };
        let near = runs.map(|runs| runs.num_near(kind) as f64);
        let median = runs.and_then(|runs| runs.median_deg(kind));
        let mean = runs.and_then(|runs| runs.mean_samples(kind));
        vec![
            votes("inliers", "Votes now", |tally| tally.candidate.as_ref()).main(),
            votes("best", "Best votes", |tally| tally.best.as_ref()).main(),
            needed.main(),
            number("near", "Runs within 1°", near, 0, "").main(),
            drawn,
            number("error", "Off by", self.error_deg(), 1, "°"),
            votes("truth-votes", "Hidden line", |tally| Some(&tally.truth)),
            number("median", "Median error", median, 2, "°"),
            number("samples", "Mean samples", mean, 1, ""),
        ]
    }

    fn describe(&self) -> String {
        let tally = match self.tally() {
            Ok(tally) => tally,
            Err(sentence) => return sentence.to_owned(),
        };
        let count = self.scattered.points.len();
        let Some((candidate, best)) = tally.candidate.as_ref().zip(tally.best.as_ref()) else {
            return format!(
                "{count} points, about half of the outliers in one region. No sample yet."
            );
        };
        let near = self.runs().map(|runs| runs.num_near(self.kind()));
        let runs = near.map_or_else(String::new, |near| {
            format!(" Of {NUM_RUNS} runs on other points, {near} end within 1°.")
        });
        if self.is_decided() {
            return format!(
                "After {} samples the best line has the votes of {} of {count} points, which lie within {} px \
                 of it, and is {}° from the hidden one. {}{runs}",
                tally.samples.count(),
                best.num_votes(),
                format_number(self.epsilon_px(), 0),
                format_number(self.error_deg().unwrap_or(0.0), 1),
                tally.samples.drawn().outlook(),
            );
        }
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
