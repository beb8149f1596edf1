//! Readouts and description of `path-costs`.

use super::costs::path_winner_px;
use super::model::PathCostsModel;
use crate::contract::{Readout, Words, format_number};

impl Words for PathCostsModel {
    fn readouts(&self) -> Vec<Readout> {
        let missing = self.asked.missing();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        let whole = |id, label, value: Option<usize>, unit| {
            number(id, label, value.map(|value| value as f64), 0, unit)
        };
        let costs = self.costs();
        let count = self.directions().len();
        let right = self.num_right();
        let right = right.map_or(missing.to_owned(), |right| format!("{right} of {count}"));
        let path = self.marked_path().map(path_winner_px);
        let path = whole("path-d", "Marked d", path, "px").or("none marked");
        let visibility = self
            .is_hidden()
            .map_or(missing, |is_hidden| match is_hidden {
                true => "hidden on the right",
                false => "both cameras see it",
            });
        vec![
            whole("raw", "Raw d", costs.map(|c| c.raw_winner_px()), "px").main(),
            whole("sum", "Sum's d", costs.map(|c| c.winner_px()), "px").main(),
            number("truth", "True d", self.truth_px(), 2, "px").main(),
            Readout::words("agree", "Paths right", right).main(),
            path,
            whole("minima", "Raw minima", costs.map(|c| c.num_minima()), ""),
            Readout::words("hidden", "Visibility", visibility),
        ]
    }

    fn describe(&self) -> String {
        let (Some(costs), Some(truth), Some(right)) =
            (self.costs(), self.truth_px(), self.num_right())
        else {
            return self.asked.sentence();
        };
        let penalties = self.penalties();
        let paths = match self.directions().len() {
            1 => "one path".to_owned(),
            count => format!("{count} paths"),
        };
        let marked = self.marked_label().zip(self.marked_path());
        let marked = marked.map_or(String::new(), |(label, path)| {
            let from = label.to_lowercase();
            format!(
                " The marked path {from} prefers {} px.",
                path_winner_px(path)
            )
        });
        format!(
            "The pixel at {}. Its raw cost is lowest at {} px, the sum of {paths} with P1 {} and P2 {} at {} px; \
             {} px is true. {right} of the paths are right on their own.{marked}",
            self.place.text(),
            costs.raw_winner_px(),
            penalties.small,
            penalties.large,
            costs.winner_px(),
            format_number(truth, 2),
        )
    }
}
