//! Readouts and description of `ratio-test`.

use super::model::RatioTest;
use crate::contract::{Readout, Words, format_number};
use crate::kit::words::whole_pixel;
use nalgebra::Point2;

/// Text in place of a missing number.
const WAITING: &str = "none yet";

fn kept_or_not(is_kept: bool) -> &'static str {
    if is_kept { "kept" } else { "rejected" }
}

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
        let percent = |(id, label), share: Option<f64>| {
            Readout::percent(id, label, share, 0).or("no match").main()
        };
        let [near, far] = found.distances.map(f64::from);
        let is_right = if found.is_right { "right" } else { "wrong" };
        let is_kept = kept_or_not(self.rules().keep(found));
        let verdict = format!("{is_right}, {is_kept}");
        let [u, v] = answer.spots[0][index].place;
        let place = whole_pixel(&Point2::new(u, v));
        vec![
            Readout::count(kept.0, kept.1, tally.num_kept).main(),
            Readout::count(right.0, right.1, tally.num_right).main(),
            percent(precision, tally.precision()),
            percent(recall, Some(tally.recall())),
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
        let (Some(tally), Some((_, found))) = (self.tally(), self.probed()) else {
            return self.asked.sentence();
        };
        let rules = self.rules();
        let ratio = format_number(f64::from(rules.max_ratio), 2);
        let rule = match (rules.max_ratio == 1.0, rules.is_mutual) {
            (true, false) => "Without the ratio test".to_owned(),
            (true, true) => "Without the ratio test, but with the mutual check".to_owned(),
            (false, false) => format!("With τ = {ratio}"),
            (false, true) => format!("With τ = {ratio} and the mutual check"),
        };
        let verdict = kept_or_not(rules.keep(found));
        format!(
            "{rule}, {} matches are kept and {} of them are right: precision {}%, recall {}%. \
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
