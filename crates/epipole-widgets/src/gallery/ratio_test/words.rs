//! What `ratio-test` says.

use super::model::RatioTest;
use super::question::Question;
use crate::contract::{Readout, Words, format_number};
use crate::kit::question::Question as _;

/// Stands for a number until there is one.
const WAITING: &str = "none yet";

impl Words for RatioTest {
    fn readouts(&self) -> Vec<Readout> {
        let names = [
            ("kept", "Kept"),
            ("right", "Right"),
            ("precision", "Precision"),
            ("recall", "Recall"),
        ];
        let (Some(answer), Some(tally), Some((index, found))) =
            (self.asked.answer(), self.tally(), self.probed())
        else {
            let waiting = |(id, label)| Readout::words(id, label, WAITING).main();
            return names.map(waiting).into();
        };
        let [kept, right, precision, recall] = names;
        let percent = |(id, label), share: Option<f64>| match share {
            Some(share) => Readout::number(id, label, 100.0 * share, 0, "%"),
            None => Readout::words(id, label, "no match"),
        };
        let [near, far] = found.distances.map(f64::from);
        let is_kept = self.rules().keep(found);
        let verdict = match (found.is_right, is_kept) {
            (true, true) => "right, kept",
            (true, false) => "right, rejected",
            (false, true) => "wrong, kept",
            (false, false) => "wrong, rejected",
        };
        let [u, v] = answer.spots[0][index].place;
        let place = format!("({}, {})", format_number(u, 0), format_number(v, 0));
        vec![
            Readout::count(kept.0, kept.1, tally.num_kept).main(),
            Readout::count(right.0, right.1, tally.num_right).main(),
            percent(precision, tally.precision()).main(),
            percent(recall, Some(tally.recall())).main(),
            Readout::number("nearest", "Nearest d₁", near, 2, ""),
            Readout::number("second", "Second d₂", far, 2, ""),
            Readout::number("probed-ratio", "d₁ / d₂", f64::from(found.ratio), 3, ""),
            Readout::words("verdict", "That match", verdict),
            Readout::words("place", "Feature at", place),
            Readout::count("features", "Features", answer.candidates.len()),
            Readout::count("findable", "Findable", answer.num_findable as usize),
        ]
    }

    fn describe(&self) -> String {
        if let Some(problem) = self.asked.problem() {
            return problem.to_owned();
        }
        let (Some(tally), Some((_, found))) = (self.tally(), self.probed()) else {
            return format!("{}.", Question::LABEL);
        };
        let rules = self.rules();
        let test = match rules.max_ratio {
            1.0 => "Without the ratio test".to_owned(),
            ratio => format!("With τ = {}", format_number(f64::from(ratio), 2)),
        };
        let mutual = if rules.is_mutual {
            " and the mutual check"
        } else {
            ""
        };
        let verdict = if rules.keep(found) {
            "kept"
        } else {
            "rejected"
        };
        format!(
            "{test}{mutual}, {} matches are kept and {} of them are right: precision {} %, recall {} %. \
             The feature at the probe has its two nearest at the distances {} and {}, a ratio of {}: \
             {verdict}.",
            tally.num_kept,
            tally.num_right,
            format_number(100.0 * tally.precision().unwrap_or(0.0), 0),
            format_number(100.0 * tally.recall(), 0),
            format_number(f64::from(found.distances[0]), 2),
            format_number(f64::from(found.distances[1]), 2),
            format_number(f64::from(found.ratio), 3),
        )
    }
}
