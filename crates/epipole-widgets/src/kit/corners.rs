//! Corners A to D of a rectangle, which the reader drags in the panel `photo`.

use crate::canvas::{Canvas, Place};
use crate::kit::grid::TEXT;
use crate::kit::labels::Labels;
use crate::kit::probe::{Probe, place_words};
use crate::theme::Role;

/// Handles of the corners, in order around the rectangle; a figure sets their ranges and positions.
pub(crate) const CORNERS: [Probe; 4] = [
    corner("a", "Corner A, far left"),
    corner("b", "Corner B, far right"),
    corner("c", "Corner C, near right"),
    corner("d", "Corner D, near left"),
];

const fn corner(id: &'static str, label: &'static str) -> Probe {
    Probe::new(id, "photo", label)
        .digits(1)
        .told(|place| place_words(place, 1))
}

/// Draws the grips of the corners.
pub(crate) fn draw_grips(canvas: &mut Canvas, corners: [Place; 4]) {
    for corner in corners {
        canvas.grip(corner, Role::Grip);
    }
}

/// Draws the letters beside the corners.
pub(crate) fn draw_names(canvas: &mut Canvas, labels: &mut Labels, corners: [Place; 4]) {
    for corner in corners {
        labels.keep_free(corner, 9.0);
    }
    for (corner, name) in corners.into_iter().zip(["A", "B", "C", "D"]) {
        labels.name(canvas, (corner, 11.0), name, (Role::Ink, TEXT));
    }
}
