//! Readouts and description of `epipolar-plane`.

use super::model::{EpipolarPlane, Lit};
use super::scenery::Scenery;
use crate::contract::{Readout, Words, format_number};
use crate::kit::words::{self, whole_pixel};

/// Message without a baseline.
pub(super) const NO_BASELINE: &str =
    "Both cameras stand at the same place: no baseline, and so no plane. Move one.";
/// Message while P lies on the baseline.
pub(super) const ON_BASELINE: &str =
    "P lies on the baseline, so it spans no plane with it: its image is the epipole. Move P.";

impl Words for EpipolarPlane {
    fn readouts(&self) -> Vec<Readout> {
        let scenery = self.scenery();
        let number = |id, label, value: Option<f64>, digits, unit| {
            Readout::number(id, label, value, digits, unit).or("none")
        };
        let pixel = |id, label, index: usize| {
            let place = scenery.and_then(|scenery| scenery.pixels[index]);
            let text = place.map_or("behind it".to_owned(), |place| whole_pixel(&place));
            Readout::words(id, label, text)
        };
        let of = |get: fn(&Scenery) -> Option<f64>| scenery.and_then(get);
        let epipole = |id, label, index: usize| {
            let text = scenery
                .and_then(|scenery| scenery.geometry)
                .map(|geometry| {
                    words::short_epipole(&[geometry.epipole1, geometry.epipole2][index])
                });
            Readout::words(id, label, text.unwrap_or_else(|| "none".to_owned()))
        };
        let (before, baseline) = (
            of(Scenery::before_surface_m),
            scenery.map(Scenery::baseline_m),
        );
        let from = self.orbit.seen_from();
        vec![
            number("tilt", "Plane tilt", self.tilt_deg(), 1, "°").main(),
            pixel("p1", "Image p", 0),
            pixel("p2", "Image p′", 1).main(),
            number("residual", "Residual", of(Scenery::residual_px), 3, "px").main(),
            Readout::words("lit", "Lit up", self.meaning()),
            number("before", "Before surface", before, 2, "m"),
            number("baseline", "Baseline", baseline, 2, "m"),
            epipole("e1", "Epipole e", 0),
            epipole("e2", "Epipole e′", 1),
            Readout::words("seen", "Seen from", from),
        ]
    }

    fn describe(&self) -> String {
        let Some(scenery) = self.scenery() else {
            return "A camera cannot stand there.".to_owned();
        };
        let Some(geometry) = &scenery.geometry else {
            return NO_BASELINE.to_owned();
        };
        let Some(plane) = &scenery.plane else {
            return ON_BASELINE.to_owned();
        };
        let tilt = plane.tilt_deg();
        let image = match scenery.pixels[1] {
            Some(pixel) => format!("p′ is at {} on its line there", whole_pixel(&pixel)),
            None => "P is behind camera 2".to_owned(),
        };
        format!(
            "Two cameras {} m apart, their photographs before them, and P {} m along its ray from camera 1. \
             The plane through both centers and P is tilted {}° {}; {image}. The epipole e′ is {}. {}",
            format_number(scenery.baseline_m(), 2),
            format_number(scenery.depth_m(), 2),
            format_number(tilt.abs(), 1),
            if tilt < 0.0 { "up" } else { "down" },
            words::epipole(&geometry.epipole2),
            match self.lit() {
                Lit::Point => "P and its images are lit up.",
                Lit::Baseline => "The baseline is lit up.",
                Lit::Plane => "The plane is lit up.",
                Lit::Line => "The epipolar lines are lit up.",
                Lit::Epipole => "The epipoles are lit up.",
            }
        )
    }
}

impl EpipolarPlane {
    /// Returns the values of the highlighted element.
    pub(super) fn meaning(&self) -> String {
        let none = || "none".to_owned();
        let Some(scenery) = self.scenery() else {
            return none();
        };
        let pixel =
            |index: usize| scenery.pixels[index].map_or_else(none, |pixel| whole_pixel(&pixel));
        match self.lit() {
            Lit::Point => format!("p = {}, p′ = {}", pixel(0), pixel(1)),
            Lit::Baseline => format!("t is {} m long", format_number(scenery.baseline_m(), 2)),
            Lit::Plane => self.tilt_deg().map_or_else(none, |tilt| {
                let way = if tilt < 0.0 { "up" } else { "down" };
                format!("tilted {}° {way}", format_number(tilt.abs(), 1))
            }),
            Lit::Line => scenery.lines()[1].map_or_else(none, |line| words::line(&line)),
            Lit::Epipole => scenery.geometry.map_or_else(none, |geometry| {
                let [e1, e2] = [&geometry.epipole1, &geometry.epipole2].map(words::short_epipole);
                format!("e = {e1}, e′ = {e2}")
            }),
        }
    }
}
