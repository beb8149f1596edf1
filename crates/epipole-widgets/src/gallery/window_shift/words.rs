//! What `window-shift` says.

use super::measure::Verdict;
use super::model::WindowShift;
use crate::contract::{Readout, Words, format_number};

impl Verdict {
    /// One word, the same in the picture and beside it.
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
        let (du, dv) = self.shift;
        let change = found.change(du as i32, dv as i32);
        let number = |id, label, value| Readout::number(id, label, value, 0, "");
        vec![
            Readout::words("verdict", "Verdict", self.verdict(found).word()).main(),
            number("lambda1", "λ₁ per pixel", large).main(),
            number("lambda2", "λ₂ per pixel", small).main(),
            number("change", "Squared change", change).main(),
            number("estimate", "Taylor's estimate", found.estimate(self.shift)),
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
        let (du, dv) = self.shift;
        format!(
            "The window at column {}, row {} is on {what}. Per pixel λ₁ is {} and λ₂ is {}; {} and \
             more counts as large. A shift by {} columns and {} rows changes it by {}.",
            self.window.0,
            self.window.1,
            format_number(large, 0),
            format_number(small, 0),
            format_number(self.threshold(), 0),
            format_number(du, 0),
            format_number(dv, 0),
            format_number(found.change(du as i32, dv as i32), 0),
        )
    }
}
