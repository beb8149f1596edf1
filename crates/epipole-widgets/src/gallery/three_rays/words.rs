//! Readouts and description of `three-rays`.

use super::model::ThreeRays;
use crate::contract::{Readout, Words, format_number};

impl Words for ThreeRays {
    fn readouts(&self) -> Vec<Readout> {
        let found = self.meeting();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit)
        };
        let sigma = |index: usize| found.map(|found| found.sigma[index]);
        let place = found.and_then(|found| found.place());
        let at = |value: Option<f64>, id, label| number(id, label, value, 3, "m").or("at infinity");
        vec![
            number("sigma3", "σ₃", sigma(2), 4, "").or("–").main(),
            at(place.map(|place| place.x), "x", "X").main(),
            at(place.map(|place| place.y), "z", "Z").main(),
            number("sigma2", "σ₂", sigma(1), 3, "").or("–"),
            number("sigma1", "σ₁", sigma(0), 3, "").or("–"),
        ]
    }

    fn describe(&self) -> String {
        let columns = self.columns().map(|u| format_number(u, 0));
        let [u1, u2, u3] = &columns;
        let seen = match self.num_used() {
            2 => format!(
                "Two cameras side by side, seen from above, see P in the columns {u1} and {u2}."
            ),
            _ => format!(
                "Three cameras side by side, seen from above, see P in the columns {u1}, {u2} and {u3}."
            ),
        };
        let Some(found) = self.meeting() else {
            return seen;
        };
        let sigma = format_number(found.sigma[2], 4);
        match found.place() {
            Some(place) => format!(
                "{seen} The smallest singular value of the equations is {sigma}; its vector is the place \
                 {} m to the right and {} m away. P is at 0.30 m and 2.00 m.",
                format_number(place.x, 3),
                format_number(place.y, 3),
            ),
            None => format!(
                "{seen} The rays are parallel: the smallest singular value of the equations is {sigma}, and \
                 its vector is a direction, a place at infinity."
            ),
        }
    }
}
