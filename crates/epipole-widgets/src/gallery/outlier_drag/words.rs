//! Readouts and description of `outlier-drag`.

use super::model::{OutlierDrag, State};
use crate::contract::{Readout, Words, format_number};

impl Words for OutlierDrag {
    fn readouts(&self) -> Vec<Readout> {
        let state = self.state();
        let px = |id, label, digits, get: fn(&State) -> f64| {
            Readout::number(id, label, state.ok().map(get), digits, "px").or("no F")
        };
        let farther = state.map_or("none".to_owned(), |state| {
            format!("{} of {}", state.fit.num_farther, state.truth.len())
        });
        vec![
            Readout::number("away", "Moved by", self.away_px(), 0, "px").main(),
            px("mean", "True mean", 2, |state| state.fit.mean_px).main(),
            px("worst", "True worst", 1, |state| state.fit.worst_px).main(),
            px("without", "Without it", 2, |state| state.without.mean_px).main(),
            px("own", "Wrong match", 1, |state| state.fit.wrong_px),
            Readout::words("farther", "Farther off", farther),
        ]
    }

    fn describe(&self) -> String {
        let state = match self.state() {
            Ok(state) => state,
            Err(sentence) => return sentence.to_owned(),
        };
        let (fit, count) = (&state.fit, state.truth.len());
        let [mean, worst, wrong] =
            [fit.mean_px, fit.worst_px, fit.wrong_px].map(|px| format_number(px, 1));
        if !self.is_heard() {
            return format!(
                "F from {count} true matches, the wrong one left out. They are {mean} px from their lines on \
                 average, at most {worst} px; the wrong one is {wrong} px from its own."
            );
        }
        let away = format_number(self.away_px(), 0);
        let without = format_number(state.without.mean_px, 2);
        format!(
            "F from {count} true matches and one that is {away} px from where it belongs. The true ones are now \
             {mean} px from their lines on average, at most {worst} px; without the wrong one, {without} px on \
             average. The wrong one is {wrong} px from its line."
        )
    }
}
