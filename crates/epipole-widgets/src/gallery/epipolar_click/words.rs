//! Readouts and description of `epipolar-click`.

use super::model::EpipolarClick;
use crate::contract::{Readout, Words, format_number};
use crate::kit::geometry::Geometry;
use crate::kit::guess::NOT_COMPARED;
use crate::kit::scenes::Seen;
use crate::kit::words::{self, matrix, pixel, short_epipole, side};
use nalgebra::Point2;

/// Message while both cameras are at the same position.
pub(super) const NO_BASELINE: &str = "Both photographs are taken from the same place, so there is \
    no epipolar geometry: a point fixes its match without any depth, and no line is left over. \
    Move camera 2.";

impl EpipolarClick {
    fn guess_words(&self, guess: &Point2<f64>) -> String {
        let Some((index, _)) = self.selected() else {
            return "No point is chosen in photograph 1, so there is no match to guess.".to_owned();
        };
        let place = pixel(guess);
        let text = format!("Your guess of the match of point {} is {place}", index + 1);
        if !self.shows_lines() {
            return format!("{text}; lines and matches are hidden.");
        }
        let number = |px: f64| format_number(px, 0);
        let distances = [self.guess_off_px(), self.guess_across_px()];
        match distances.map(|px| px.map(number)) {
            [Some(off), Some(across)] => {
                format!("{text}, {off} px from the match and {across} px from its line.")
            }
            [_, Some(across)] => {
                format!("{text}, {across} px from the line. Photograph 2 does not show the match.")
            }
            _ => format!("{text}."),
        }
    }
}

impl Words for EpipolarClick {
    fn readouts(&self) -> Vec<Readout> {
        let selected = self.selected();
        let matched = selected.map(|(_, point)| self.seen(&point));
        let pixel2 = matched.and_then(Seen::pixel);
        let geometry = self.geometry();
        let line = selected.zip(geometry);
        let line = line.and_then(|((_, point), geometry)| geometry.line2(&point));
        let distance = line.zip(pixel2);
        let distance = distance.map(|(line, pixel2)| line.signed_distance(&pixel2).abs());
        let residual = Readout::number("residual", "Residual", distance, 3, "px");
        let say = |id, label, text: Option<String>| {
            Readout::words(id, label, text.unwrap_or("none".to_owned()))
        };
        let of = |get: fn(&Geometry) -> String| geometry.as_ref().map(get);
        let point = selected.map(|(index, point)| format!("{} at {}", index + 1, pixel(&point)));
        let is_guess = self.guess().is_some();
        let off = Readout::number("off", "Off match", self.guess_off_px(), 0, "px");
        let across = self.guess_across_px();
        let across = Readout::number("across", "Off line", across, 0, "px");
        let told = |text: Option<String>| match self.shows_lines() {
            true => text,
            false => Some("hidden".to_owned()),
        };
        vec![
            say("match", "Its match", told(pixel2.as_ref().map(pixel))).main_if(!is_guess),
            residual.or("none").main_if(!is_guess),
            off.or(NOT_COMPARED).main_if(is_guess),
            across.or(NOT_COMPARED).main_if(is_guess),
            say("e2", "Epipole e′", of(|all| short_epipole(&all.epipole2))).main(),
            say("point", "Selected point", point),
            say("sight", "Visible", told(matched.map(sight))),
            say("line", "Line ℓ′", told(line.as_ref().map(words::line))),
            say("e1", "Epipole e", of(|all| short_epipole(&all.epipole1))),
            say("f", "F, by rows", of(|all| matrix(&all.fundamental))),
            say("e", "E, by rows", of(|all| matrix(&all.essential))),
        ]
    }

    fn describe(&self) -> String {
        let Some(geometry) = self.geometry() else {
            return NO_BASELINE.to_owned();
        };
        let (right_m, forward_m, left_deg) = self.motion();
        let mut text = format!("Camera 2 stands {}. ", motion(right_m, forward_m, left_deg));
        if let Some(guess) = self.guess() {
            text.push_str(&self.guess_words(&guess));
            return text;
        }
        let count = self.points().count();
        let is_seen = |(_, point): &(_, _)| matches!(self.seen(point), Seen::Visible(_));
        let seen = match self.points().filter(is_seen).count() {
            0 => "none".to_owned(),
            all if all == count => "all".to_owned(),
            some => some.to_string(),
        };
        text.push_str(&match count {
            0 => "No point is chosen in photograph 1".to_owned(),
            1 => {
                let visible = if seen == "none" { "out of sight" } else { "visible" };
                format!(
                    "The epipolar line of the point in photograph 1 holds its match, which is {visible} \
                     in photograph 2"
                )
            }
            _ => format!(
                "The epipolar lines of {count} points in photograph 1 hold their matches, of which \
                 {seen} can be seen in photograph 2"
            ),
        });
        text.push_str(&format!(
            "; the epipole e′, where all lines meet, is {}.",
            words::epipole(&geometry.epipole2)
        ));
        if let Some((index, point)) = self.selected() {
            text.push_str(&format!(" Point {} is at {}.", index + 1, pixel(&point)));
        }
        text
    }
}

/// Describes the visibility of a match in camera 2, such as "no: the jug hides it".
fn sight(found: Seen) -> String {
    match found {
        Seen::Visible(_) => "yes".to_owned(),
        Seen::Hidden(_, by) => format!("no: {by} hides it"),
        Seen::Outside(place) => format!("no: it is {}", side(&place)),
        Seen::Behind => "no: it is behind camera 2".to_owned(),
        Seen::Nothing => "no: camera 1 sees nothing there".to_owned(),
    }
}

/// Describes the pose of camera 2, such as "0.50 m to the right of camera 1 and 0.40 m behind it,
/// turned 14° to the left".
fn motion(right_m: f64, forward_m: f64, left_deg: f64) -> String {
    let number = |value: f64| format_number(value.abs(), 2);
    let mut parts = Vec::new();
    if right_m != 0.0 {
        parts.push(format!("{} m to the right of camera 1", number(right_m)));
    }
    if forward_m != 0.0 {
        let side = if forward_m > 0.0 {
            "in front of"
        } else {
            "behind"
        };
        let it = if right_m == 0.0 { "camera 1" } else { "it" };
        parts.push(format!("{} m {side} {it}", number(forward_m)));
    }
    let place = parts.join(" and ");
    let angle = format_number(left_deg.abs(), 0);
    match left_deg {
        turn if turn > 0.0 => format!("{place}, turned {angle}° to the left"),
        turn if turn < 0.0 => format!("{place}, turned {angle}° to the right"),
        _ => format!("{place}, looking the same way"),
    }
}
