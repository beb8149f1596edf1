//! Options for the pattern of a board.

use crate::matrices::positive;
use clap::{Args, ValueEnum};
use epipole::calibration::{MarkerDictionary, Pattern};

/// Default side of a marker, relative to that of its square.
const MARKER_RATIO: f64 = 0.75;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Printed {
    /// Squares; COLUMNSxROWS are inner corners.
    Chessboard,
    /// Squares with markers in the white ones; COLUMNSxROWS are squares, as in OpenCV.
    Charuco,
    /// AprilTags 36h11 as Kalibr prints them; COLUMNSxROWS are tags.
    Aprilgrid,
    /// Disks in rows and columns.
    Circles,
    /// Disks in rows, every second one shifted; COLUMNSxROWS are disks in a row and rows.
    AsymmetricCircles,
}

/// Pattern of a board.
#[derive(Debug, Args)]
pub(crate) struct PatternArguments {
    /// Pattern of the board.
    #[arg(long = "kind", value_enum, default_value = "chessboard")]
    pattern: Printed,
    /// Markers of a ChArUco board. 4x4_N, 5x5_N, 6x6_N, 7x7_N (N is 50, 100, 250 or 1000) or 36h11.
    #[arg(long, value_name = "NAME", default_value = "4x4_50", value_parser = dictionary)]
    dictionary: MarkerDictionary,
    /// Gap between the tags of an AprilGrid, relative to their side.
    #[arg(long, value_name = "RATIO", default_value_t = 0.3, value_parser = positive)]
    tag_spacing: f64,
}

impl PatternArguments {
    /// Returns the pattern.
    ///
    /// * `marker`, `square`: sides in one unit; the default marker side is three quarters of the
    ///   square
    pub(crate) fn pattern(&self, marker: Option<f64>, square: f64) -> Pattern {
        match self.pattern {
            Printed::Chessboard => Pattern::Chessboard,
            Printed::Circles => Pattern::Circles,
            Printed::AsymmetricCircles => Pattern::AsymmetricCircles,
            Printed::Charuco => Pattern::Charuco {
                dictionary: self.dictionary,
                marker_ratio: marker.map_or(MARKER_RATIO, |marker| marker / square),
            },
            Printed::Aprilgrid => Pattern::AprilGrid {
                spacing: self.tag_spacing,
            },
        }
    }

    /// Returns the name of the pattern on the command line.
    pub(crate) fn name(&self) -> String {
        let value = self.pattern.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

/// Reads the name of a dictionary, with or without OpenCV's prefix.
pub(crate) fn dictionary(text: &str) -> Result<MarkerDictionary, String> {
    let name = text.to_ascii_lowercase();
    let name = name.trim_start_matches("dict_");
    let name = name.trim_start_matches("apriltag_");
    let found = MarkerDictionary::ALL.into_iter().find(|d| d.name() == name);
    found.ok_or_else(|| {
        let names = MarkerDictionary::ALL.map(MarkerDictionary::name);
        format!("\"{text}\" is none of {}", names.join(", "))
    })
}

/// Reads "9x6".
pub(crate) fn columns_and_rows(text: &str) -> Result<(usize, usize), String> {
    let sides = text.split_once(['x', 'X', '×']);
    let parsed = sides.and_then(|(a, b)| Some((a.trim().parse().ok()?, b.trim().parse().ok()?)));
    parsed.ok_or_else(|| format!("\"{text}\" is not like 9x6"))
}
