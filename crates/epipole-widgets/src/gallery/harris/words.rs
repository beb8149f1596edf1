//! Readouts and description of `harris`.

use super::model::{Harris, Verdict};
use crate::contract::{Readout, Words, format_number};

impl Verdict {
    fn word(self) -> &'static str {
        match self {
            Verdict::Flat => "flat",
            Verdict::Edge => "edge",
            Verdict::Corner => "corner",
        }
    }
}

impl Words for Harris {
    fn readouts(&self) -> Vec<Readout> {
        let Some(probe) = self.probe() else {
            return vec![Readout::words("state", "State", self.describe()).main()];
        };
        let number = |id, label, value, digits| Readout::number(id, label, value, digits, "");
        vec![
            Readout::number("response", "Score R", probe.response / 1e6, 2, "million").main(),
            Readout::words("verdict", "Verdict", probe.verdict.word()).main(),
            Readout::count("corners", "Corners", self.corners().len()).main(),
            number("lambda1", "λ₁", probe.lambda1, 0),
            number("lambda2", "λ₂", probe.lambda2, 0),
            number("a", "A, Σ Iu²", probe.tensor.uu, 0),
            number("b", "B, Σ Iv²", probe.tensor.vv, 0),
            number("c", "C, Σ IuIv", probe.tensor.uv, 0),
        ]
    }

    fn describe(&self) -> String {
        let is_told = self.asked.problem().is_none();
        let Some(probe) = self.probe().filter(|_| is_told) else {
            return self.asked.sentence();
        };
        let what = match probe.verdict {
            Verdict::Flat => "a flat place",
            Verdict::Edge => "an edge",
            Verdict::Corner => "a corner",
        };
        let corners = self.corners().len();
        let (u, v) = self.probe.place();
        format!(
            "{corners} {} above {}% of the strongest response. The probe at column {u}, row {v} is \
             on {what}: λ₁ is {}, λ₂ is {}, R is {} million.",
            if corners == 1 { "corner" } else { "corners" },
            format_number(self.threshold_percent(), 0),
            format_number(probe.lambda1, 0),
            format_number(probe.lambda2, 0),
            format_number(probe.response / 1e6, 2),
        )
    }
}
