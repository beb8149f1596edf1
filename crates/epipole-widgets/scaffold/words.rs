//! Readouts and description of `new-figure`.

use super::model::NewFigure;
use crate::contract::{Readout, Words, format_number};

impl Words for NewFigure {
    fn readouts(&self) -> Vec<Readout> {
        let distance_m = self.distance_m();
        vec![Readout::number("distance", "From the middle", distance_m, 2, "m").main()]
    }

    fn describe(&self) -> String {
        let is_inside = self.distance_m() <= self.radius_m();
        let side = if is_inside { "inside" } else { "outside" };
        format!(
            "The point is {} m from the middle, {side} the circle of radius {} m.",
            format_number(self.distance_m(), 2),
            format_number(self.radius_m(), 1)
        )
    }
}
