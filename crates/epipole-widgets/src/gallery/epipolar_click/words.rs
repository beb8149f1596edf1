//! How `epipolar-click` says matches and where camera 2 stands.

use super::model::Match;
use crate::contract::format_number;
use crate::words::{pixel, side};

/// What the figure says when both cameras stand at one place.
pub(super) const NO_BASELINE: &str = "Both photographs are taken from the same place, so there is \
    no epipolar geometry: a point fixes its match without any depth, and no line is left over. \
    Move camera 2.";

/// A match, such as "at (251.0, 202.3)".
pub(super) fn found(found: Match) -> String {
    match found {
        Match::Visible(place) => format!("at {}", pixel(&place)),
        Match::Hidden(place, by) => format!("at {}, but hidden by {by}", pixel(&place)),
        Match::Outside(place) => format!("at {}, {}", pixel(&place), side(&place)),
        Match::Behind => "none: it is behind camera 2".to_owned(),
        Match::Nothing => "none: camera 1 sees nothing there".to_owned(),
    }
}

/// Where camera 2 stands, such as "0.50 m to the right of camera 1 and 0.40 m behind it, turned 14° to the left".
pub(super) fn motion(right_m: f64, forward_m: f64, left_deg: f64) -> String {
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
