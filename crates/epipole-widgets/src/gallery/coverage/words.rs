//! Readouts and description of `coverage`.

use super::boards::FOCAL_PX;
use super::model::Coverage;
use super::question::NUM_AGAIN;
use crate::contract::{Readout, Words, format_number};

impl Words for Coverage {
    fn readouts(&self) -> Vec<Readout> {
        let found = self.found().and_then(Result::ok);
        let missing = match self.found() {
            Some(Err(_)) => "open",
            _ => self.asked.missing(),
        };
        let number = |id, label, value: Option<f64>, digits| {
            Readout::number(id, label, value, digits, "px").or(missing)
        };
        let coverage = found.map(|found| found.coverage);
        vec![
            number("focal", "Focal found", found.map(|f| f.focal_px), 1).main(),
            number("std", "± (1 σ)", found.map(|f| f.focal_std_px), 1).main(),
            number("corner", "Corner error", found.map(|f| f.corner_px), 1).main(),
            Readout::percent("covered", "Image covered", coverage, 0)
                .or(missing)
                .main(),
            Readout::number("true", "True focal", FOCAL_PX, 0, "px"),
            number("rms", "Reprojection RMS", found.map(|f| f.rms_px), 3),
            number(
                "scatter",
                "Focal scatter",
                found.map(|f| f.focal_scatter_px),
                1,
            ),
            Readout::number("reach", "Boards reach", self.covered_px(), 0, "px"),
        ]
    }

    fn describe(&self) -> String {
        let boards = self.arrangement();
        let views = format!(
            "{} boards reach {} px from the middle of the image",
            boards.num_views,
            format_number(self.covered_px(), 0)
        );
        match self.found() {
            None => format!("{views}. {}", self.asked.sentence()),
            Some(Err(sentence)) => format!("{views}. They give no camera: {sentence}."),
            Some(Ok(found)) => format!(
                "{views} and cover {}% of it. The focal length is {} ± {} px, where {} px is true; with fresh noise, \
                 {NUM_AGAIN} calibrations scatter by {} px. In the farthest corner, they are {} px from the true \
                 camera.",
                format_number(100.0 * found.coverage, 0),
                format_number(found.focal_px, 1),
                format_number(found.focal_std_px, 1),
                format_number(FOCAL_PX, 0),
                format_number(found.focal_scatter_px, 1),
                format_number(found.corner_px, 1)
            ),
        }
    }
}
