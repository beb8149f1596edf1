//! Readouts and description of `disparity-map`.

use super::model::DisparityMap;
use super::question::Method;
use crate::contract::{Readout, Words, format_number};

impl Words for DisparityMap {
    fn readouts(&self) -> Vec<Readout> {
        let answered = self.asked.answered();
        let scores = answered.map(|(_, answer)| answer.scores);
        let probed = answered.and_then(|(_, answer)| self.probed(answer));
        let is_waiting = self.asked.is_waiting();
        let waiting = if is_waiting { "…" } else { "none" };
        let number = |id, label, value: Option<f64>, digits, unit, otherwise: &str| {
            Readout::number(id, label, value, digits, unit).or(otherwise)
        };
        let found_px = probed.and_then(|probed| probed.found_px);
        let truth_px = probed.map(|probed| probed.truth_px);
        let depth_m = |d: Option<f32>| {
            let (question, _) = answered?;
            question.depth_m(d?)
        };
        let [found_m, true_m] = [found_px, truth_px].map(depth_m);
        let none = probed.map_or(waiting, |_| "no answer");
        let percent = |id, label, share: Option<f64>| {
            Readout::percent(id, label, share, 1).or(waiting).main()
        };
        let error_px = scores.map(|scores| scores.mean_error_px);
        let hidden = probed.map_or(waiting, |probed| match probed.is_hidden {
            true => "hidden on the right",
            false => "both cameras see it",
        });
        vec![
            percent("bad", "Bad answers", scores.map(|scores| scores.bad)),
            percent("coverage", "Coverage", scores.map(|scores| scores.coverage)),
            number("found", "Found d", found_px.map(f64::from), 2, "px", none).main(),
            number("truth", "True d", truth_px.map(f64::from), 2, "px", waiting).main(),
            number("error", "Mean error", error_px, 2, "px", waiting),
            number("depth", "Depth found", found_m, 3, "m", none),
            number("true-depth", "True depth", true_m, 3, "m", waiting),
            Readout::words("hidden", "Visibility", hidden),
        ]
    }

    fn describe(&self) -> String {
        let answered = self
            .asked
            .answered()
            .filter(|_| self.asked.problem().is_none());
        let probed = answered.and_then(|(_, answer)| self.probed(answer));
        let (Some((question, answer)), Some(probed)) = (answered, probed) else {
            return self.asked.sentence();
        };
        let method = match question.method {
            Method::Blocks(window_px) => format!("Block matching with {window_px} px windows"),
            Method::SemiGlobal => "Semi-global matching".to_owned(),
        };
        let at = match probed.found_px {
            Some(found) => format!("it finds {} px", format_number(found.into(), 1)),
            None => "it finds nothing".to_owned(),
        };
        let range = match question.reaches_nearest(answer) {
            true => "",
            false => " The nearest things lie beyond the range of the search.",
        };
        format!(
            "{method} answers for {}% of what both cameras see; {}% of the answers are more than \
             2 px off. At the probe {at}, and {} px is true.{range}",
            format_number(100.0 * answer.scores.coverage, 1),
            format_number(100.0 * answer.scores.bad, 1),
            format_number(probed.truth_px.into(), 1),
        )
    }
}
