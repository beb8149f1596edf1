//! Readouts and description of `same-picture`.

use super::model::SamePicture;
use crate::contract::{Readout, Words, format_number};

impl Words for SamePicture {
    fn readouts(&self) -> Vec<Readout> {
        let picture_px = self.picture_px().unwrap_or(f64::NAN);
        let column2_px = self.column2_px().unwrap_or(f64::NAN);
        vec![
            Readout::number("picture", "Pixel height", picture_px, 0, "px").main(),
            Readout::number("height", "Height H", self.height_m(), 2, "m").main(),
            Readout::number("distance", "Distance Z", self.distance_m, 2, "m").main(),
            Readout::number("column2", "Photo 2 column", column2_px, 0, "px"),
        ]
    }

    fn describe(&self) -> String {
        let size = match self.grows() {
            true => "It grows with its distance, so photograph 1 never changes.",
            false => "It keeps its size, so photograph 1 changes with its distance.",
        };
        format!(
            "A mug {} m tall stands {} m from camera 1, which sees it {} px tall. {size} Photograph \
             2, from the side, shows it in column {}.",
            format_number(self.height_m(), 2),
            format_number(self.distance_m, 2),
            format_number(self.picture_px().unwrap_or(0.0), 0),
            format_number(self.column2_px().unwrap_or(0.0), 0),
        )
    }
}
