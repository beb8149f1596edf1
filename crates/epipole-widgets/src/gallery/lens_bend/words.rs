//! Readouts and description of `lens-bend`.

use super::model::{LensBend, worst_px};
use crate::contract::{Readout, Words, format_number};

impl Words for LensBend {
    fn readouts(&self) -> Vec<Readout> {
        let (bent_px, left_px) = (worst_px(&self.bent()), worst_px(&self.corrected()));
        let corner = 100.0 * self.corner_factor();
        vec![
            Readout::number("bent", "Edges bent", bent_px, 1, "px").main(),
            Readout::number("left", "Bend left", left_px, 1, "px").main(),
            Readout::number("corner", "Corner radius", corner, 0, "%").main(),
        ]
    }

    fn describe(&self) -> String {
        let (lens, guess) = (self.lens(), self.guess());
        let number = |value: f64| format_number(value, 2);
        let way = match self.corner_factor() {
            factor if factor < 1.0 => "inward, like a barrel",
            factor if factor > 1.0 => "outward, like a pincushion",
            _ => "nowhere",
        };
        format!(
            "A lens with k₁ = {} and k₂ = {} moves the corners of the picture {way}, and bends straight edges by \
             up to {} px. Your k₁ = {} and k₂ = {} leave {} px.",
            number(lens.k1),
            number(lens.k2),
            format_number(worst_px(&self.bent()), 1),
            number(guess.k1),
            number(guess.k2),
            format_number(worst_px(&self.corrected()), 1)
        )
    }
}
