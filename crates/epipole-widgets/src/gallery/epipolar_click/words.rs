//! How `epipolar-click` says pixels, lines, matrices and places.

use super::model::Match;
use crate::contract::format_number;
use crate::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH, in_picture};
use epipole::epipolar::Epipole;
use epipole::math::Line2;
use nalgebra::{Matrix3, Point2};

/// What the figure says when both cameras stand at one place.
pub(super) const NO_BASELINE: &str = "Both photographs are taken from the same place, so there is \
    no epipolar geometry: a point fixes its match without any depth, and no line is left over. \
    Move camera 2.";

/// A pixel, such as "(320.0, 240.5)".
pub(super) fn pixel(pixel: &Point2<f64>) -> String {
    format!(
        "({}, {})",
        format_number(pixel.x, 1),
        format_number(pixel.y, 1)
    )
}

/// On which side of the picture a pixel is.
pub(super) fn side(pixel: &Point2<f64>) -> &'static str {
    let beyond = [
        (-0.5 - pixel.x, "left of the picture"),
        (
            pixel.x - f64::from(PHOTO_WIDTH) + 0.5,
            "right of the picture",
        ),
        (-0.5 - pixel.y, "above the picture"),
        (pixel.y - f64::from(PHOTO_HEIGHT) + 0.5, "below the picture"),
    ];
    let farthest = beyond.iter().max_by(|a, b| a.0.total_cmp(&b.0));
    farthest.map_or("", |(_, words)| words)
}

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

/// An epipole, such as "at (−290, 240), left of the picture".
pub(super) fn epipole(epipole: &Epipole) -> String {
    match epipole {
        Epipole::Finite(place) => {
            let at = format!(
                "at ({}, {})",
                format_number(place.x, 1),
                format_number(place.y, 1)
            );
            if in_picture(place) {
                format!("{at}, inside the picture")
            } else {
                format!("{at}, {}", side(place))
            }
        }
        Epipole::AtInfinity(direction) if direction.y.abs() < 1e-6 => {
            "at infinity along the rows".to_owned()
        }
        Epipole::AtInfinity(direction) if direction.x.abs() < 1e-6 => {
            "at infinity along the columns".to_owned()
        }
        Epipole::AtInfinity(direction) => format!(
            "at infinity in the direction ({}, {})",
            format_number(direction.x, 2),
            format_number(direction.y, 2)
        ),
    }
}

/// A line, such as "0.123 u − 0.992 v + 211.4 = 0".
pub(super) fn line(line: &Line2) -> String {
    let term = |value: f64, digits: usize| {
        let sign = if value < 0.0 { "−" } else { "+" };
        format!("{sign} {}", format_number(value.abs(), digits))
    };
    format!(
        "{} u {} v {} = 0",
        format_number(line.a, 3),
        term(line.b, 3),
        term(line.c, 1)
    )
}

/// A matrix of very different entries, row by row.
pub(super) fn matrix(matrix: &Matrix3<f64>) -> String {
    let rows: Vec<String> = (0..3)
        .map(|row| {
            let entries: Vec<String> = (0..3).map(|column| entry(matrix[(row, column)])).collect();
            entries.join("  ")
        })
        .collect();
    rows.join("; ")
}

/// A number with three significant digits, such as "−3.21·10⁻⁶".
fn entry(value: f64) -> String {
    // Zero up to rounding, in a matrix of unit norm.
    if value.abs() < 1e-13 {
        return "0".to_owned();
    }
    if value.abs() >= 0.001 {
        return format_number(value, 4);
    }
    let text = format!("{:.2e}", value);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let raised: String = exponent
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '0' => '⁰',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '4' => '⁴',
            '5' => '⁵',
            '6' => '⁶',
            '7' => '⁷',
            '8' => '⁸',
            '9' => '⁹',
            other => other,
        })
        .collect();
    format!("{}·10{raised}", mantissa.replace('-', "−"))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_entries_keep_three_digits() {
        assert_eq!(entry(-3.214e-6), "−3.21·10⁻⁶");
        assert_eq!(entry(0.60711), "0.6071");
        assert_eq!(entry(1e-17), "0");
        assert_eq!(entry(1.5e-12), "1.50·10⁻¹²");
    }

    #[test]
    fn sides_are_named() {
        assert_eq!(side(&Point2::new(-290.0, 240.0)), "left of the picture");
        assert_eq!(side(&Point2::new(900.0, 700.0)), "right of the picture");
        assert_eq!(side(&Point2::new(300.0, 900.0)), "below the picture");
    }

    #[test]
    fn a_line_reads_as_an_equation() {
        let shown = line(&Line2 {
            a: -0.6,
            b: -0.8,
            c: 211.44,
        });
        assert_eq!(shown, "−0.600 u − 0.800 v + 211.4 = 0");
    }
}
