//! Readouts and description of `vanishing-points`.

use super::model::{VanishingPoints, pixel};
use crate::contract::{Readout, Words, format_number};
use crate::kit::words;

impl Words for VanishingPoints {
    fn readouts(&self) -> Vec<Readout> {
        let found = Readout::number("found", "Focal found", self.found_focal_px(), 0, "px");
        let points = self.vanishing_points();
        let place = |index: usize| match points.and_then(|points| pixel(points[index])) {
            Some(pixel) => words::whole_pixel(&pixel),
            None => "at infinity".to_owned(),
        };
        vec![
            found.or("none").main(),
            Readout::number("focal", "True focal", self.focal_px(), 0, "px").main(),
            Readout::number("rim", "Below horizon", self.rim_below_px(), 0, "px").main(),
            Readout::words("first", "Vanishing point v₁", place(0)),
            Readout::words("second", "Vanishing point v₂", place(1)),
            Readout::number("moved", "Corner moved", self.moved_px(), 1, "px"),
        ]
    }

    fn describe(&self) -> String {
        let points = self.vanishing_points();
        let place = |index: usize| match points.and_then(|points| pixel(points[index])) {
            Some(pixel) => format!("at {}", words::whole_pixel(&pixel)),
            None => "at infinity".to_owned(),
        };
        let focal = match self.found_focal_px() {
            Some(focal) => format!(
                "For these directions to be at right angles, the focal length must be {} px; it is {} px.",
                format_number(focal, 0),
                format_number(self.focal_px(), 0)
            ),
            None => "No focal length makes these directions right-angled.".to_owned(),
        };
        format!(
            "The sides AB and DC of the cloth meet {}, the sides AD and BC {}, and the horizon is the line \
             through both. {focal} The camera is {} m above the table.",
            place(0),
            place(1),
            format_number(self.height_m(), 2)
        )
    }
}
