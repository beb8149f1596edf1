//! Readouts and description of `triangulate`.

use super::estimates::{Estimates, METHODS};
use super::model::{Show, Triangulate};
use crate::contract::{Readout, Words, format_number};
use crate::kit::guess::NOT_COMPARED;

const IDS: [&str; 4] = ["midpoint", "dlt", "angular", "optimal"];

/// Creates a readout of a length in centimeters; lengths from 99.99 m read "no limit".
fn centimeters(id: &'static str, label: &'static str, meters: Option<f64>) -> Readout {
    let cm = meters.map(|meters| 100.0 * meters);
    Readout::number(id, label, cm.filter(|cm| *cm < 9_999.0), 1, "cm").or("no limit")
}

/// Describes the content beside the region.
fn beside(model: &Triangulate, estimates: &Estimates) -> String {
    if !model.reveal().shows_answer() {
        return "How it grows with the distance is hidden; five points are your guess, from 1 m to 80 m.".to_owned();
    }
    let px = |method| {
        let missed = estimates.reprojection_px(method);
        missed.map_or("no number of".to_owned(), |px| format_number(px, 2))
    };
    let cm = |curve: &[(f64, f64)], at: f64| {
        let found = curve.iter().find(|(x, _)| *x >= at);
        found.map_or("no limit".to_owned(), |(_, long_m)| {
            format!("{} cm", format_number(100.0 * long_m, 1))
        })
    };
    let curves = &estimates.curves;
    let said = match model.show() {
        Show::Misses => format!(
            "In the photographs the midpoint misses the pixels by {} px, the optimum by {} px.",
            px(0),
            px(METHODS.len() - 1)
        ),
        Show::Angle => format!(
            "With camera 2 moved around P it would be {} at 5° and {} at 45°.",
            cm(&curves.angle, 5.0),
            cm(&curves.angle, 45.0)
        ),
        Show::Distance => format!(
            "With P moved away it would be {} at 5 m and {} at 50 m.",
            cm(&curves.distance, 5.0),
            cm(&curves.distance, 50.0)
        ),
    };
    let Some(factor) = model.guess_factor() else {
        return said;
    };
    let factor = format_number(factor, 1);
    format!("{said} Your guess is off by up to a factor of {factor}.")
}

impl Words for Triangulate {
    fn readouts(&self) -> Vec<Readout> {
        // Without estimates the readouts keep their position, without numbers.
        let estimates = self.estimates().ok();
        let angle_deg = estimates.map(|estimates| estimates.angle_deg);
        let predicted = estimates.and_then(Estimates::uncertainty_m);
        let scatter = estimates.and_then(Estimates::scatter_m);
        let angle = Readout::number("angle", "Ray angle", angle_deg, 1, "°");
        let mut readouts = vec![
            angle.or("none").main(),
            centimeters("uncertainty", "Depth σ", predicted).main(),
            centimeters("scatter", "Scatter", scatter),
        ];
        for (index, (id, label)) in IDS.into_iter().zip(LABELS).enumerate() {
            let error_px = estimates.and_then(|estimates| estimates.reprojection_px(index));
            let readout = Readout::number(id, label, error_px, 3, "px").or("no point");
            readouts.push(readout.main_if(matches!(id, "midpoint" | "optimal")));
        }
        let off = Readout::number("off", "Guess off", self.guess_factor(), 1, "×");
        readouts.push(off.or(NOT_COMPARED));
        let from = self.orbit.seen_from();
        readouts.push(Readout::words("view", "Seen from", from));
        readouts
    }

    fn describe(&self) -> String {
        let estimates = match self.estimates() {
            Ok(estimates) => estimates,
            Err(sentence) => return sentence.to_owned(),
        };
        let angle = format_number(estimates.angle_deg, 1);
        let best = estimates.points[METHODS.len() - 1].as_ref();
        let best = match best {
            Ok(best) => best,
            Err(error) => {
                return format!("The rays meet at {angle}°. There is no point, since {error}.");
            }
        };
        let off_cm = 100.0 * (best - estimates.truth).norm();
        let sigma = estimates.uncertainty_m();
        let sigma = sigma.map_or("no limit".to_owned(), |meters| {
            format!("{} cm", format_number(100.0 * meters, 1))
        });
        format!(
            "The rays meet at {angle}°. The optimal estimate is {} cm off; one standard deviation along \
             the rays is {sigma}. {}",
            format_number(off_cm, 1),
            beside(self, estimates)
        )
    }
}

const LABELS: [&str; 4] = [
    "Midpoint error",
    "DLT error",
    "Angular error",
    "Optimal error",
];
