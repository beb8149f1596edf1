//! Readouts and description of `incremental-sfm`.

use super::model::IncrementalSfm;
use crate::contract::{Readout, Words, format_number};

/// Millimeters per meter.
const MM: f64 = 1000.0;

impl Words for IncrementalSfm {
    fn readouts(&self) -> Vec<Readout> {
        let missing = self.asked.missing();
        let step = self.step();
        let text = |words: Option<String>| words.unwrap_or_else(|| missing.to_owned());
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        let registered =
            step.map(|step| format!("{} of {}", step.num_registered(), step.cam_from_world.len()));
        let agree = step.map(|step| {
            let agreeing = step.sights.iter().filter(|(_, agrees)| *agrees);
            format!("{} of {}", agreeing.count(), step.sights.len())
        });
        let name = |image: Option<usize>| {
            let is_known = step.is_some();
            is_known.then(|| image.map_or("none".to_owned(), |image| (image + 1).to_string()))
        };
        vec![
            Readout::words("registered", "Registered", text(registered)).main(),
            Readout::words("agree", "Points agreeing", text(agree)).main(),
            Readout::words(
                "points",
                "Points",
                text(step.map(|step| step.num_points.to_string())),
            )
            .main(),
            number(
                "off",
                "Cameras off",
                step.map(|step| MM * step.off_m),
                1,
                "mm",
            )
            .main(),
            number("error", "Error", step.map(|step| step.error_px), 2, "px"),
            Readout::words("newest", "Newest", text(name(step.map(|step| step.newest)))),
            Readout::words("next", "Next", text(name(self.next()))),
        ]
    }

    fn describe(&self) -> String {
        let Some(step) = self.step() else {
            return self.asked.sentence();
        };
        let agreeing = step.sights.iter().filter(|(_, agrees)| *agrees).count();
        let next = self.next().map_or_else(
            || {
                let left = step.cam_from_world.len() - step.num_registered();
                match left {
                    0 => "No photograph is left.".to_owned(),
                    1 => "One sees too few of the points, and is left out.".to_owned(),
                    left => format!("{left} see too few of the points, and are left out."),
                }
            },
            |next| {
                format!(
                    "The next is photograph {}, which sees {} of them.",
                    next + 1,
                    step.num_seen[next]
                )
            },
        );
        format!(
            "{} of {} photographs are registered, photograph {} last: {agreeing} of its {} known points agree. \
             {} points; the cameras are {} mm from their true places. {next} Seen from {}.",
            step.num_registered(),
            step.cam_from_world.len(),
            step.newest + 1,
            step.sights.len(),
            step.num_points,
            format_number(MM * step.off_m, 1),
            self.orbit.seen_from(),
        )
    }
}
