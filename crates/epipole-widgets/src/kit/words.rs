//! Text for pixels, epipoles, lines and matrices.

use crate::contract::format_number;
use crate::kit::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH, in_picture};
use epipole::epipolar::Epipole;
use epipole::math::Line2;
use nalgebra::{Matrix3, Point2};

/// Formats a pixel, such as "(320.0, 240.5)".
pub(crate) fn pixel(pixel: &Point2<f64>) -> String {
    format!(
        "({}, {})",
        format_number(pixel.x, 1),
        format_number(pixel.y, 1)
    )
}

/// Formats a pixel without decimals, such as "(320, 240)".
pub(crate) fn whole_pixel(pixel: &Point2<f64>) -> String {
    // Rounded first, so that halves are rounded consistently despite numerical noise.
    let [u, v] = [pixel.x, pixel.y].map(|x| format_number((x * 1e6).round() / 1e6, 0));
    format!("({u}, {v})")
}

/// Formats an epipole, such as "(1273, 240)".
pub(crate) fn short_epipole(epipole: &Epipole) -> String {
    match epipole {
        Epipole::Finite(place) => whole_pixel(place),
        Epipole::AtInfinity(_) => "at infinity".to_owned(),
    }
}

/// Returns the side of the picture that a pixel is on.
pub(crate) fn side(pixel: &Point2<f64>) -> &'static str {
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

/// Describes an epipole, such as "at (−290, 240), left of the picture".
pub(crate) fn epipole(epipole: &Epipole) -> String {
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

/// Formats a line, such as "0.123 u − 0.992 v + 211.4 = 0".
pub(crate) fn line(line: &Line2) -> String {
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

/// Formats a sentence that follows others: a space and the sentence, or nothing.
pub(crate) fn after(sentence: Option<&str>) -> String {
    sentence.map_or_else(String::new, |sentence| format!(" {sentence}"))
}

/// Formats a number with as few decimals as needed, at most two.
pub(crate) fn short(value: f64) -> String {
    let digits = (0..2).find(|&digits| {
        let times = [1.0, 10.0][digits];
        ((value * times).round() - value * times).abs() < 1e-4
    });
    format_number(value, digits.unwrap_or(2))
}

/// Formats a matrix row by row; lines break only between rows.
pub(crate) fn matrix(matrix: &Matrix3<f64>) -> String {
    let rows: Vec<String> = (0..3)
        .map(|row| {
            let entries: Vec<String> = (0..3).map(|column| entry(matrix[(row, column)])).collect();
            entries.join("\u{a0}\u{a0}")
        })
        .collect();
    rows.join("; ")
}

/// Formats a number with three significant digits, such as "−3.21·10⁻⁶".
fn entry(value: f64) -> String {
    // Zero up to rounding, in a matrix of unit norm.
    if value.abs() < 1e-13 {
        return "0".to_owned();
    }
    if value.abs() >= 0.001 {
        return format_number(value, 4);
    }
    with_power(value, 2)
}

/// Formats a positive number with about three significant digits, such as "41.3", "0.0217" or
/// "2.05·10⁵"; zero up to rounding relative to `largest` is "0".
pub(crate) fn magnitude(value: f64, largest: f64) -> String {
    match value {
        value if value <= 1e-12 * largest => "0".to_owned(),
        100.0..10_000.0 => format_number(value, 0),
        10.0..100.0 => format_number(value, 1),
        1.0..10.0 => format_number(value, 2),
        0.01..1.0 => format_number(value, 3),
        _ => with_power(value, 2),
    }
}

/// Formats a number as [`magnitude`] does, with its sign.
pub(crate) fn signed(value: f64, largest: f64) -> String {
    let text = magnitude(value.abs(), largest);
    if value < 0.0 && text != "0" {
        format!("−{text}")
    } else {
        text
    }
}

fn with_power(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}·10{}", mantissa.replace('-', "−"), raised(exponent))
}

/// Formats an integer as an exponent.
pub(crate) fn raised(number: &str) -> String {
    let raise = |c: char| match c {
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
    };
    number.chars().map(raise).collect()
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
    fn magnitudes_keep_three_digits() {
        assert_eq!(magnitude(204_900.0, 1e6), "2.05·10⁵");
        assert_eq!(magnitude(1234.4, 1e6), "1234");
        assert_eq!(magnitude(41.26, 1.0), "41.3");
        assert_eq!(magnitude(0.0217, 1.0), "0.022");
        assert_eq!(magnitude(3e-9, 1.0), "3.00·10⁻⁹");
        assert_eq!(magnitude(3e-9, 1e6), "0");
        assert_eq!(signed(-0.0217, 1.0), "−0.022");
        assert_eq!([-1e-15, 0.0].map(|value| signed(value, 1.0)), ["0", "0"]);
    }

    #[test]
    fn short_numbers_have_the_decimals_that_they_need() {
        let all = [-3.0, 0.5, 1.0 / 3.0, 12.000_01].map(short);
        assert_eq!(all, ["−3", "0.5", "0.33", "12"]);
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
