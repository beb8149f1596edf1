//! Readouts and description of `window-shift`.

use super::measure::Verdict;
use super::model::WindowShift;
use crate::contract::{Readout, Words, format_number};

impl Verdict {
    /// Returns the class as one word.
    pub(super) fn word(self) -> &'static str {
        match self {
            Verdict::Flat => "flat",
            Verdict::Edge => "edge",
            Verdict::Corner => "corner",
        }
    }
}

impl Words for WindowShift {
    fn readouts(&self) -> Vec<Readout> {
        let Ok(found) = self.found() else {
            return vec![Readout::words("state", "State", self.describe()).main()];
        };
        let (large, small) = found.eigenvalues();
        let shift = self.shift.place();
        let (change, estimate) = (found.change(shift), found.estimate(shift));
        let number = |id, label, value: f64| Readout::number(id, label, value, 0, "");
        vec![
            Readout::words("verdict", "Verdict", self.verdict(found).word()).main(),
            number("lambda1", "λ₁ per pixel", large).main(),
            number("lambda2", "λ₂ per pixel", small).main(),
            number("change", "Squared change", change).main(),
            number("estimate", "Taylor's estimate", estimate),
        ]
    }

    fn describe(&self) -> String {
        let found = match self.found() {
            Ok(found) => found,
            Err(problem) => return problem,
        };
        let what = match self.verdict(found) {
            Verdict::Flat => "a flat place: no shift changes it much",
            Verdict::Edge => "an edge: shifts along it change little, shifts across it much",
            Verdict::Corner => "a corner: every shift changes it",
        };
        let (large, small) = found.eigenvalues();
        let (du, dv) = self.shift.place();
        let change = found.change((du, dv));
        let numbers = [large, small, self.threshold(), du, dv, change];
        let [large, small, threshold, du, dv, change] =
            numbers.map(|number| format_number(number, 0));
        let window = self.window.text();
        format!(
            "The window at {window} is on {what}. Per pixel λ₁ is {large} and λ₂ is {small}; \
             {threshold} and more counts as large. A shift by {du} columns and {dv} rows changes it by {change}."
        )
    }
}
