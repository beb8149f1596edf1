//! Sheets of single markers.

use crate::failure::Failure;
use crate::matrices::positive;
use crate::pattern::dictionary;
use clap::Args;
use epipole::calibration::{BoardDrawing, MarkerDictionary};
use nalgebra::Point2;

/// Default gap between markers, relative to their side.
const GAP_RATIO: f64 = 0.25;

/// Markers in place of a board.
#[derive(Debug, Args)]
#[command(next_help_heading = "Single markers")]
pub(super) struct SheetArguments {
    /// Draw single markers, not a board. 4x4_N, 5x5_N, 6x6_N, 7x7_N (N is 50, 100, 250 or 1000) or
    /// 36h11.
    #[arg(long, value_name = "DICTIONARY", value_parser = dictionary, conflicts_with_all = ["pattern", "dictionary", "marker_mm", "tag_spacing"])]
    pub(super) markers: Option<MarkerDictionary>,
    /// ID of the first marker.
    #[arg(long, value_name = "N", default_value_t = 0, requires = "markers")]
    first_id: usize,
    /// White gap between markers, mm [default: a quarter of their side].
    #[arg(long, value_name = "G", value_parser = positive, requires = "markers")]
    gap_mm: Option<f64>,
}

/// Markers on paper; a square is the side of a marker.
pub(super) struct Sheet {
    pub(super) dictionary: MarkerDictionary,
    pub(super) drawing: BoardDrawing,
    /// IDs and their positions.
    pub(super) labels: Vec<([f64; 2], String)>,
    /// First and last ID.
    pub(super) ids: [usize; 2],
    pub(super) gap_mm: f64,
}

impl SheetArguments {
    /// Returns the sheet, if requested.
    ///
    /// * `size`: columns and rows
    /// * `side_mm`: side of a marker
    ///
    /// # Errors
    /// For numbers that the dictionary does not have, and for a gap of less than a bit.
    pub(super) fn sheet(
        &self,
        (columns, rows): (usize, usize),
        side_mm: f64,
    ) -> Result<Option<Sheet>, Failure> {
        let Some(dictionary) = self.markers else {
            return Ok(None);
        };
        let num_markers = dictionary.num_markers();
        let count = columns.saturating_mul(rows);
        if count == 0 || self.first_id.saturating_add(count) > num_markers {
            return Err(Failure::usage(format!(
                "{columns} × {rows} markers from number {} on are not in {}, whose markers are 0 to {}",
                self.first_id,
                dictionary.name(),
                num_markers - 1
            )));
        }
        let num_cells = (dictionary.num_bits() + 2) as f64;
        let gap = self.gap_mm.map_or(GAP_RATIO, |gap_mm| gap_mm / side_mm);
        if gap * num_cells < 1.0 {
            return Err(Failure::usage(format!(
                "--gap-mm must be {} at least: a marker is found by the white around it, as wide as one of its bits",
                (100.0 * side_mm / num_cells).ceil() / 100.0
            )));
        }
        let mut sheet = Sheet {
            dictionary,
            drawing: BoardDrawing::default(),
            labels: Vec::new(),
            ids: [self.first_id, self.first_id + count - 1],
            gap_mm: gap * side_mm,
        };
        for place in 0..count {
            let id = self.first_id + place;
            let along = |k: usize| k as f64 * (1.0 + gap);
            let (left, top) = (along(place % columns), along(place / columns));
            let corner = |[i, j]: [usize; 2]| {
                Point2::new(left + i as f64 / num_cells, top + j as f64 / num_cells)
            };
            let cells = dictionary.black_cells(id, 1);
            let rectangles = cells.into_iter().flatten().map(|ends| ends.map(corner));
            sheet.drawing.rectangles.extend(rectangles);
            // In the lower half of the gap, to keep the rim of the marker white.
            (sheet.labels).push(([left, top + 1.0 + 0.9 * gap], id.to_string()));
        }
        Ok(Some(sheet))
    }
}
