//! Readouts and description of `plane-or-not`.

use super::model::{Plane, PlaneOrNot};
use crate::contract::{Readout, Words, format_number};
use crate::kit::words;

impl PlaneOrNot {
    /// Returns the name of the plane, such as "the table".
    fn plane_words(&self) -> &'static str {
        match self.plane() {
            Plane::Table => "the table",
            Plane::Pictures => "the pictures",
            Plane::Infinity => "the plane at infinity",
        }
    }
}

impl Words for PlaneOrNot {
    fn readouts(&self) -> Vec<Readout> {
        let pixel1 = self.point();
        let found = self.parallax(&pixel1);
        let line = self.geometry().and_then(|geometry| geometry.line2(&pixel1));
        let length = found.map(|found| found.length_px());
        let height = found.and_then(|found| self.height_m(&found.point));
        let off = found.and_then(|found| Some(line?.signed_distance(&found.predicted).abs()));
        let pixel = |pixel: Option<_>| {
            pixel.map_or_else(|| "not seen".to_owned(), |pixel| words::pixel(&pixel))
        };
        vec![
            Readout::number("parallax", "Parallax", length, 1, "px")
                .or("not seen")
                .main(),
            Readout::number("height", "Above plane", height.map(|m| 100.0 * m), 1, "cm")
                .or("no height")
                .main(),
            Readout::number("line", "H p off line ℓ′", off, 2, "px")
                .or("no line")
                .main(),
            Readout::number("median", "Median parallax", self.median_px(), 1, "px").or("one point"),
            Readout::words(
                "predicted",
                "H p",
                pixel(found.map(|found| found.predicted)),
            ),
            Readout::words("match", "Match p′", pixel(found.map(|found| found.pixel2))),
            Readout::words(
                "homography",
                "H, by rows",
                words::matrix(&self.homography().normalize()),
            ),
        ]
    }

    fn describe(&self) -> String {
        let plane = self.plane_words();
        let Some(found) = self.parallax(&self.point()) else {
            return format!("Camera 2 does not see the place under p. The plane is {plane}.");
        };
        let [predicted, pixel2] = [&found.predicted, &found.pixel2].map(words::pixel);
        let length = format_number(found.length_px(), 1);
        let height = match self.height_m(&found.point) {
            Some(height) => format!(
                "The point is {} cm above it, and its match is at {pixel2}: a parallax of {length} px",
                format_number(100.0 * height, 1)
            ),
            None => format!("Its match is at {pixel2}: a parallax of {length} px"),
        };
        let along = match self.geometry() {
            Some(_) => " along the epipolar line",
            None => ". Both photographs are taken from one place, so no point has parallax",
        };
        let warped = match self.is_warped() {
            true => " The right panel shows image 1 through the homography, in place of image 2.",
            false => "",
        };
        format!(
            "The homography of {plane} puts p at {predicted} in image 2. {height}{along}.{warped}"
        )
    }
}
