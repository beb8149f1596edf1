//! What `outlier-drag` says.

use super::fit::Fit;
use super::model::OutlierDrag;
use crate::contract::{Readout, Words, format_number};

impl Words for OutlierDrag {
    fn readouts(&self) -> Vec<Readout> {
        let state = self.state();
        let px = |id, label, get: fn(&Fit) -> f64| match state {
            Ok(state) => Readout::number(id, label, get(&state.fit), 1, "px"),
            Err(_) => Readout::words(id, label, "no F"),
        };
        let without = match state {
            Ok(state) => Readout::number("without", "Without it", state.without.mean_px, 2, "px"),
            Err(_) => Readout::words("without", "Without it", "no F"),
        };
        let farther = match state {
            Ok(state) => format!("{} of {}", state.fit.num_farther, state.truth.len()),
            Err(_) => "none".to_owned(),
        };
        vec![
            Readout::number("away", "Moved by", self.away_px(), 0, "px").main(),
            px("mean", "True mean", |fit| fit.mean_px).main(),
            px("worst", "True worst", |fit| fit.worst_px).main(),
            without.main(),
            px("own", "Wrong match", |fit| fit.wrong_px),
            Readout::words("farther", "Farther off", farther),
        ]
    }

    fn describe(&self) -> String {
        let state = match self.state() {
            Ok(state) => state,
            Err(sentence) => return sentence.to_owned(),
        };
        let number = |value: f64| format_number(value, 1);
        let (fit, count) = (&state.fit, state.truth.len());
        if !self.is_heard() {
            return format!(
                "F from {count} true matches, the wrong one left out. They are {} px from their lines on \
                 average, at most {} px; the wrong one is {} px from its own.",
                number(fit.mean_px),
                number(fit.worst_px),
                number(fit.wrong_px)
            );
        }
        format!(
            "F from {count} true matches and one that is {} px from where it belongs. The true ones are now \
             {} px from their lines on average, at most {} px; without the wrong one, {} px on average. \
             The wrong one is {} px from its line.",
            format_number(self.away_px(), 0),
            number(fit.mean_px),
            number(fit.worst_px),
            format_number(state.without.mean_px, 2),
            number(fit.wrong_px)
        )
    }
}
