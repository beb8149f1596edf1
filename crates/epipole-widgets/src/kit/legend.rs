//! Legends of lines and markers, in several rows if needed.

use crate::canvas::{Canvas, Shape, Stroke, TextStyle, text_width};
use crate::contract::Layout;
use crate::theme::Role;

const SIZE: f64 = 13.0;
const ROW: f64 = 22.0;
const SWATCH: f64 = 26.0;

/// A line or a marker.
pub(crate) enum Swatch {
    Line(Stroke),
    Marker(Shape, Role),
}

/// A swatch and its meaning.
pub(crate) type Entry = (Swatch, &'static str);

/// Returns the position of each entry and the height of all rows, CSS pixels.
fn places(entries: &[Entry], width: f64, margin: f64) -> (Vec<(f64, f64)>, f64) {
    let (mut x, mut y) = (margin, 0.0);
    let mut places = Vec::new();
    for (_, label) in entries {
        let entry_width = SWATCH + 6.0 + text_width(label, SIZE);
        if x > margin && x + entry_width > width - margin {
            (x, y) = (margin, y + ROW);
        }
        places.push((x, y));
        x += entry_width + 18.0;
    }
    (places, y + ROW)
}

/// Returns the height of a legend, CSS pixels.
pub(crate) fn height(entries: &[Entry], width: f64, margin: f64) -> f64 {
    places(entries, width, margin).1
}

/// Draws a legend at the bottom of a picture, `below` CSS pixels above its edge.
pub(crate) fn draw_last(
    canvas: &mut Canvas,
    entries: &[Entry],
    layout: &Layout,
    margin: f64,
    below: f64,
) {
    let top = layout.height - below - height(entries, layout.width, margin);
    draw(canvas, entries, layout.width, margin, top);
}

/// Draws a legend from `top` down.
pub(crate) fn draw(canvas: &mut Canvas, entries: &[Entry], width: f64, margin: f64, top: f64) {
    let (places, _) = places(entries, width, margin);
    for ((swatch, label), (x, y)) in entries.iter().zip(places) {
        let middle = top + y + ROW / 2.0;
        match swatch {
            Swatch::Line(stroke) => {
                canvas.line((x, middle), (x + SWATCH - 2.0, middle), *stroke);
            }
            Swatch::Marker(shape, role) => {
                canvas.marker((x + SWATCH / 2.0, middle), 4.5, *shape, *role, false);
            }
        }
        let style = TextStyle::new(Role::Ink, SIZE);
        canvas.label((x + SWATCH + 6.0, middle), label, style);
    }
}
