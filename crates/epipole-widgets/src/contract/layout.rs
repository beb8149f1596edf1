//! Layout of the picture, with the only transform between world units and the page.

use epipole_canvas::Rect;
use nalgebra::Point2;
use serde::Serialize;

/// Mapping of one world coordinate along one side of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Axis {
    /// World value at the panel's left or top edge.
    pub start: f64,
    /// World value at the panel's right or bottom edge; smaller than `start` for an axis that runs
    /// up.
    pub end: f64,
}

/// A part of the picture with its own world: a photograph, a plot, a view from above.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Panel {
    /// Permanent name.
    pub id: &'static str,
    /// Rectangle on the page, CSS pixels.
    #[cfg_attr(
        test,
        ts(type = "{ x: number; y: number; width: number; height: number }")
    )]
    pub rect: Rect,
    /// World units from left to right.
    pub x_axis: Axis,
    /// World units from top to bottom.
    pub y_axis: Axis,
    /// Whether a click away from handles has an effect here.
    pub clickable: bool,
}

impl Panel {
    /// Creates a panel from the world values at its left and right edge, and at its top and bottom.
    pub fn new(id: &'static str, rect: Rect, x: [f64; 2], y: [f64; 2]) -> Self {
        let axis = |[start, end]: [f64; 2]| Axis { start, end };
        Self {
            id,
            rect,
            x_axis: axis(x),
            y_axis: axis(y),
            clickable: false,
        }
    }

    /// Creates a panel of a photograph: world units are its pixels, centers at integers.
    pub fn photograph(id: &'static str, rect: Rect, size_px: (u32, u32)) -> Self {
        let axis = |size_px: u32| [-0.5, f64::from(size_px) - 0.5];
        Self::new(id, rect, axis(size_px.0), axis(size_px.1))
    }

    /// Makes the panel clickable.
    #[must_use]
    pub fn clickable(self) -> Self {
        let clickable = true;
        Self { clickable, ..self }
    }

    /// Converts a position from world units to CSS pixels of the page.
    pub fn canvas_from_world(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let along = |value: f64, axis: Axis| (value - axis.start) / (axis.end - axis.start);
        (
            self.rect.x + along(x, self.x_axis) * self.rect.width,
            self.rect.y + along(y, self.y_axis) * self.rect.height,
        )
    }

    /// Converts a point of the panel's world, such as a pixel, to CSS pixels of the page.
    pub fn place_of(&self, point: &Point2<f64>) -> (f64, f64) {
        self.canvas_from_world((point.x, point.y))
    }

    /// Returns the rectangle on the page between two world positions: upper left and lower right.
    pub fn rect_between(&self, from: (f64, f64), to: (f64, f64)) -> Rect {
        let (x, y) = self.canvas_from_world(from);
        let (right, bottom) = self.canvas_from_world(to);
        Rect::new(x, y, right - x, bottom - y)
    }

    /// Converts a position from CSS pixels of the page to world units.
    pub fn world_from_canvas(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let at = |axis: Axis, share: f64| axis.start + share * (axis.end - axis.start);
        (
            at(self.x_axis, (x - self.rect.x) / self.rect.width.max(1e-9)),
            at(self.y_axis, (y - self.rect.y) / self.rect.height.max(1e-9)),
        )
    }

    /// Returns the CSS pixels per world unit along x.
    pub fn scale_x(&self) -> f64 {
        self.rect.width / (self.x_axis.end - self.x_axis.start).abs()
    }
}

/// Widths for which pictures are laid out, CSS pixels: a phone, a column, a wide page. Other widths
/// scale the picture of the next smaller one, so a poster has exactly the shape of the interactive
/// picture.
pub const WIDTHS: [f64; 3] = [360.0, 720.0, 1088.0];

/// The picture's size and its panels, for one width of the page.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Layout {
    /// Width, CSS pixels.
    pub width: f64,
    /// Height, CSS pixels.
    pub height: f64,
    /// The panels; none overlap.
    pub panels: Vec<Panel>,
}

impl Layout {
    /// Returns the panel with this id.
    ///
    /// # Panics
    /// If the view has no panel with this id; views name their own panels, and tests draw
    /// every view.
    pub fn panel(&self, id: &str) -> &Panel {
        self.panels
            .iter()
            .find(|panel| panel.id == id)
            .expect("the view lays out this panel")
    }

    /// Returns the panels with these ids, as [`Layout::panel`].
    pub fn panels_named<const N: usize>(&self, ids: [&str; N]) -> [&Panel; N] {
        ids.map(|id| self.panel(id))
    }

    /// Returns the panel under a position on the page.
    pub fn panel_at(&self, place: (f64, f64)) -> Option<&Panel> {
        self.panels.iter().find(|panel| panel.rect.contains(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_returns_from_the_world() {
        let rect = Rect::new(10.0, 20.0, 300.0, 200.0);
        let panel = Panel::new("top", rect, [-1.0, 1.0], [5.0, 0.0]);
        assert_eq!(panel.canvas_from_world((0.0, 5.0)), (160.0, 20.0));
        let (x, y) = panel.world_from_canvas(panel.canvas_from_world((0.3, 1.7)));
        assert!((x - 0.3).abs() < 1e-12 && (y - 1.7).abs() < 1e-12);
    }

    #[test]
    fn pixel_centers_of_a_photograph_are_inside_their_pixels() {
        let panel = Panel::photograph("left", Rect::new(0.0, 0.0, 640.0, 480.0), (320, 240));
        assert_eq!(panel.canvas_from_world((0.0, 0.0)), (1.0, 1.0));
        assert_eq!(panel.canvas_from_world((319.0, 239.0)), (639.0, 479.0));
    }
}
