//! Readouts and description of `flat-scene`.

use super::model::{FlatScene, State};
use crate::contract::{Readout, Words, format_number};
use crate::kit::words;

impl Words for FlatScene {
    fn readouts(&self) -> Vec<Readout> {
        let state = self.state().ok();
        let px = |id, label, get: fn(&State) -> f64| {
            Readout::number(id, label, state.map(get), 2, "px").or("no F")
        };
        let worded = |get: &dyn Fn(&State) -> String| state.map_or("no F".to_owned(), get);
        let ratio = worded(&|state| words::magnitude(state.fit.ratio(), 0.0));
        let values = worded(&|state| {
            let sigma = &state.fit.singular_values;
            let values = [5, 6, 7, 8].map(|k| words::magnitude(sigma[k], sigma[0]));
            values.join(", ")
        });
        vec![
            Readout::words("ratio", "σ₈ / σ₉", ratio).main(),
            Readout::number("fan", "Lines fan", self.fan_deg(), 1, "°")
                .or("no line")
                .main(),
            px("used", "Matches used", |state| state.used_px).main(),
            px("new", "New points", |state| state.new_px).main(),
            Readout::words("values", "σ₆ to σ₉", values),
        ]
    }

    fn describe(&self) -> String {
        let state = match self.state() {
            Ok(state) => state,
            Err(sentence) => return sentence.to_owned(),
        };
        let shape = match self.spread() {
            0.0 => "on a plane".to_owned(),
            spread => format!("with a depth spread of {}", format_number(spread, 2)),
        };
        format!(
            "F from {} matches of points {shape}, with {} px of noise: σ₈ is {} times σ₉. The matches are {} px from \
             their lines on average, new points in depth {} px. The lines of the probe that fit fan out by \
             {}°.",
            state.matches.len(),
            format_number(self.noise_px(), 1),
            words::magnitude(state.fit.ratio(), 0.0),
            format_number(state.used_px, 2),
            format_number(state.new_px, 2),
            format_number(self.fan_deg().unwrap_or(0.0), 1),
        )
    }
}
