//! Readouts and description of `calibrate`.

use super::model::Calibrate;
use super::question::FOCAL_PX;
use crate::contract::{Readout, Words, format_number};

impl Words for Calibrate {
    fn readouts(&self) -> Vec<Readout> {
        let found = self.found().and_then(Result::ok);
        let missing = if self.asked.is_waiting() {
            "…"
        } else {
            "open"
        };
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or(missing)
        };
        vec![
            number("focal", "Focal found", found.map(|f| f.focal_px), 1, "px").main(),
            number("std", "± (1 σ)", found.map(|f| f.focal_std_px), 1, "px").main(),
            number("worst", "Worst error", found.map(|f| f.worst_px()), 1, "px").main(),
            Readout::number("true", "True focal", FOCAL_PX, 0, "px"),
            number("rms", "Reprojection RMS", found.map(|f| f.rms_px), 3, "px"),
            number("k1", "k₁ found", found.map(|f| f.k1), 3, ""),
            number(
                "coverage",
                "Image covered",
                found.map(|f| 100.0 * f.coverage),
                0,
                "%",
            ),
            Readout::count("used", "Views used", self.num_used()),
        ]
    }

    fn describe(&self) -> String {
        let used = self.num_used();
        match self.found() {
            None => self.asked.sentence(),
            Some(Err(sentence)) => format!("{used} of ten views give no camera: {sentence}."),
            Some(Ok(found)) => format!(
                "{used} of ten views give a focal length of {} ± {} px, where {} px is true. The reprojection \
                 error is {} px; in the picture, the camera found is up to {} px from the true one.",
                format_number(found.focal_px, 1),
                format_number(found.focal_std_px, 1),
                format_number(FOCAL_PX, 0),
                format_number(found.rms_px, 3),
                format_number(found.worst_px(), 1)
            ),
        }
    }
}
