//! The plane of points near a line: its panel, lines, and the band around one.

use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Panel, Rect};
use crate::kit::legend::Swatch;
use crate::kit::line_points::{HEIGHT_PX, WIDTH_PX};
use crate::theme::Role;
use epipole::math::Line2;

/// Legend entries of a point that votes for a line, and of one that does not.
pub(crate) const INLIER: Swatch = Swatch::Marker(Shape::Disk, Role::Inlier);
pub(crate) const OUTLIER: Swatch = Swatch::Marker(Shape::Cross, Role::Outlier);

/// Creates the panel of the plane.
pub(crate) fn panel(id: &'static str, rect: Rect) -> Panel {
    Panel::new(id, rect, [0.0, WIDTH_PX], [0.0, HEIGHT_PX])
}

/// Returns two points of a line outside of the panel.
fn ends(plane: &Panel, line: &Line2, offset_px: f64) -> [(f64, f64); 2] {
    let foot = (
        -(line.c - offset_px) * line.a,
        -(line.c - offset_px) * line.b,
    );
    let reach = 4.0 * WIDTH_PX;
    [-reach, reach]
        .map(|along| plane.canvas_from_world((foot.0 - along * line.b, foot.1 + along * line.a)))
}

pub(crate) fn draw_line(canvas: &mut Canvas, plane: &Panel, line: &Line2, stroke: Stroke) {
    let [from, to] = ends(plane, line, 0.0);
    canvas.line(from, to, stroke);
}

/// Draws a point, colored by its vote; `None` while there is no line.
pub(crate) fn draw_point(canvas: &mut Canvas, place: (f64, f64), radius: f64, votes: Option<bool>) {
    let (shape, role) = match votes {
        Some(true) => (Shape::Disk, Role::Inlier),
        Some(false) => (Shape::Cross, Role::Outlier),
        None => (Shape::Disk, Role::Muted),
    };
    canvas.marker(place, radius, shape, role, false);
}

/// Draws the band within the threshold of the sample's line.
pub(crate) fn band(canvas: &mut Canvas, plane: &Panel, line: &Line2, epsilon_px: f64) {
    let [a, b] = ends(plane, line, -epsilon_px);
    let [d, c] = ends(plane, line, epsilon_px);
    canvas.polygon(&[a, b, c, d], Role::Candidate, 0.13);
    for (from, to) in [(a, b), (d, c)] {
        canvas.line(from, to, Stroke::solid(Role::Candidate, 1.0).dotted());
    }
}
