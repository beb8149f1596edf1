//! Readouts and description of `optimal-plane`.

use super::model::{OptimalPlane, State};
use crate::contract::{Readout, Words, format_number};

/// Message if p has no match.
pub(super) const NOTHING: &str = "Camera 2 does not see what is at p. Move p.";

impl Words for OptimalPlane {
    fn readouts(&self) -> Vec<Readout> {
        let state = self.state();
        let now = state.as_ref().and_then(|state| state.at(self.angle_deg()));
        let miss = now.map(|(_, miss)| miss);
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or("–")
        };
        let best = |value: fn(&State) -> f64| state.as_ref().map(value);
        vec![
            number("first", "p misses", miss.map(|miss| miss.px[0]), 1, "px").main(),
            number("second", "p′ misses", miss.map(|miss| miss.px[1]), 1, "px").main(),
            number("sum", "Squares", miss.map(|miss| miss.sum_sq()), 0, "px²").main(),
            number(
                "least",
                "Least",
                best(|state| state.best.1.sum_sq()),
                0,
                "px²",
            )
            .main(),
            number("angle", "Angle", Some(self.angle_deg()), 2, "°"),
            number(
                "best-angle",
                "Best angle",
                best(|state| state.best.0),
                2,
                "°",
            ),
            number(
                "best-first",
                "Best p",
                best(|state| state.best.1.px[0]),
                1,
                "px",
            ),
            number(
                "best-second",
                "Best p′",
                best(|state| state.best.1.px[1]),
                1,
                "px",
            ),
        ]
    }

    fn describe(&self) -> String {
        let Some(state) = self.state() else {
            return NOTHING.to_owned();
        };
        let (best_deg, best) = state.best;
        let now = state.at(self.angle_deg()).map_or_else(String::new, |(_, miss)| {
            format!(
                " The plane is turned by {}° from the ray of p: p misses its line by {} px and p′ by {} px, and the \
                 squares add up to {} px².",
                format_number(self.angle_deg(), 1),
                format_number(miss.px[0], 1),
                format_number(miss.px[1], 1),
                format_number(miss.sum_sq(), 0),
            )
        });
        format!(
            "Two photographs of a still life, p and p′ in them, and a plane through both cameras.{now} The least is \
             {} px², at {}°, where p misses by {} px and p′ by {} px.",
            format_number(best.sum_sq(), 0),
            format_number(best_deg, 1),
            format_number(best.px[0], 1),
            format_number(best.px[1], 1),
        )
    }
}
