//! What `epipolar-click` says: its readouts, its description, and how it says matches and motions.

use super::model::{EpipolarClick, Match};
use crate::contract::{Readout, format_number};
use crate::words::{self, pixel, side};

/// What the figure says when both cameras stand at one place.
pub(super) const NO_BASELINE: &str = "Both photographs are taken from the same place, so there is \
    no epipolar geometry: a point fixes its match without any depth, and no line is left over. \
    Move camera 2.";

pub(super) fn readouts(model: &EpipolarClick) -> Vec<Readout> {
    let selected = model
        .selected()
        .and_then(|index| Some((index, model.point(index)?)));
    let mut readouts = vec![match selected {
        Some((index, point)) => Readout::words(
            "point",
            "Selected point",
            format!("{} at {}", index + 1, pixel(&point)),
        ),
        None => Readout::words("point", "Selected point", "none"),
    }];
    let geometry = model.geometry();
    if let Some((_, point)) = selected {
        let matched = model.find_match(&point);
        readouts.push(Readout::words(
            "match",
            "Its match in photograph 2",
            found(matched),
        ));
        if let Some(geometry) = &geometry {
            let line = model.line2(geometry, &point);
            readouts.push(Readout::words(
                "line",
                "Its epipolar line F x₁",
                line.map_or_else(
                    || "none: the point is the epipole".to_owned(),
                    |line| words::line(&line),
                ),
            ));
            readouts.push(match (line, matched.pixel()) {
                (Some(line), Some(pixel2)) => Readout::number(
                    "residual",
                    "Distance of the match from the line",
                    line.signed_distance(&pixel2).abs(),
                    3,
                    "px",
                ),
                _ => Readout::words("residual", "Distance of the match from the line", "none"),
            });
        }
    }
    match &geometry {
        Some(geometry) => {
            for (id, label, epipole) in [
                ("e1", "Epipole e₁ in photograph 1", geometry.epipole1),
                ("e2", "Epipole e₂ in photograph 2", geometry.epipole2),
            ] {
                readouts.push(Readout::words(id, label, words::epipole(&epipole)));
            }
            readouts.push(Readout::words(
                "f",
                "F, by rows",
                words::matrix(&geometry.fundamental),
            ));
        }
        None => readouts.push(Readout::words("f", "F, by rows", "not determined")),
    }
    readouts
}

pub(super) fn describe(model: &EpipolarClick) -> String {
    let (right_m, forward_m, left_deg) = model.motion();
    let Some(geometry) = model.geometry() else {
        return NO_BASELINE.to_owned();
    };
    let mut text = format!("Camera 2 stands {}. ", motion(right_m, forward_m, left_deg));
    let count = model.points().count();
    if count == 0 {
        text.push_str("No point is chosen in photograph 1");
    } else {
        let seen = model
            .points()
            .filter(|(_, point)| matches!(model.find_match(point), Match::Visible(_)))
            .count();
        let points = if count == 1 { "point" } else { "points" };
        let lines = if count == 1 { "line" } else { "lines" };
        text.push_str(&format!(
            "The epipolar {lines} of {count} {points} of photograph 1 each hold the match, \
             which is visible in photograph 2 for {}",
            if seen == count {
                "all of them".to_owned()
            } else if seen == 0 {
                "none of them".to_owned()
            } else {
                format!("{seen} of them")
            }
        ));
    }
    text.push_str(&format!(
        "; the epipole e₂, where all lines meet, is {}.",
        words::epipole(&geometry.epipole2)
    ));
    if let Some((index, point)) = model.selected().zip(model.points().last().map(|(_, p)| p)) {
        let point = model.point(index).unwrap_or(point);
        text.push_str(&format!(" Point {} is at {}.", index + 1, pixel(&point)));
    }
    text
}

/// A match, such as "at (251.0, 202.3)".
fn found(found: Match) -> String {
    match found {
        Match::Visible(place) => format!("at {}", pixel(&place)),
        Match::Hidden(place, by) => format!("at {}, but hidden by {by}", pixel(&place)),
        Match::Outside(place) => format!("at {}, {}", pixel(&place), side(&place)),
        Match::Behind => "none: it is behind camera 2".to_owned(),
        Match::Nothing => "none: camera 1 sees nothing there".to_owned(),
    }
}

/// Where camera 2 stands, such as "0.50 m to the right of camera 1 and 0.40 m behind it, turned 14° to the left".
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
