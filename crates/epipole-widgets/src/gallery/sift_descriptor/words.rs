//! Readouts and description of `sift-descriptor`.

use super::model::SiftDescriptor;
use super::prints::WAYS;
use super::question::Question;
use crate::contract::{Readout, Words, format_number};
use crate::kit::question::Question as _;

/// Text in place of a missing number.
const WAITING: &str = "none yet";

impl Words for SiftDescriptor {
    fn readouts(&self) -> Vec<Readout> {
        let ratios = [
            ("raw-ratio", "Raw patch"),
            ("normalized-ratio", "Normalized"),
            ("sift-ratio", "SIFT"),
        ];
        let Some(compared) = self.compared() else {
            let waiting = |(id, label)| Readout::words(id, label, WAITING).main();
            return ratios.map(waiting).into();
        };
        let mut readouts: Vec<Readout> = (ratios.into_iter().zip(&compared.distances))
            .map(|((id, label), distance)| {
                Readout::number(id, label, distance.ratio(), 2, "").main()
            })
            .collect();
        let details = [
            (
                "raw",
                "Raw, original",
                "raw-other",
                "Raw, other",
                1,
                "levels",
            ),
            (
                "normalized",
                "Normalized, original",
                "normalized-other",
                "Normalized, other",
                2,
                "",
            ),
            ("sift", "SIFT, original", "sift-other", "SIFT, other", 2, ""),
        ];
        for ((id, label, other_id, other, digits, unit), distance) in
            details.into_iter().zip(&compared.distances)
        {
            readouts.push(Readout::number(id, label, distance.original, digits, unit));
            readouts.push(Readout::number(
                other_id,
                other,
                distance.other,
                digits,
                unit,
            ));
        }
        let angles = (compared.looks.each_ref()).map(|look| look.angle_rad.to_degrees());
        readouts.push(Readout::number(
            "before",
            "Direction before",
            angles[0],
            0,
            "°",
        ));
        readouts.push(Readout::number(
            "after",
            "Direction after",
            angles[1],
            0,
            "°",
        ));
        readouts
    }

    fn describe(&self) -> String {
        if let Some(problem) = self.problem() {
            return problem.to_owned();
        }
        let Some(compared) = self.compared() else {
            return format!("{}.", Question::LABEL);
        };
        let said: Vec<String> = (WAYS.iter().zip(&compared.distances))
            .map(|(way, distance)| format!("{way} {}", format_number(distance.ratio(), 2)))
            .collect();
        let change = self.change();
        format!(
            "The photograph is turned by {}°, scaled by {} and {} gray levels brighter. Distance to the \
             original, divided by that to the nearest other feature: {}. Below 0.8 it would be recognized.",
            format_number(change.turn_rad.to_degrees(), 0),
            format_number(change.zoom, 2),
            format_number(change.brighter * 255.0, 0),
            said.join(", ")
        )
    }
}
