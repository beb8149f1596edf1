//! A top view: x to the right, z away from the reader, in meters or scene units.

use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Panel, Rect, format_number};
use crate::kit::grid::{SMALL, TEXT};
use crate::kit::labels::Labels;
use crate::theme::Role;
use nalgebra::{Point2, Vector2};

/// Minimum length of a scale bar, CSS pixels.
const RULE: f64 = 36.0;
/// Minimum spacing of grid lines, CSS pixels.
const SPACING: f64 = 26.0;

/// Creates a panel around a position, with one scale for both directions.
///
/// * `middle`: (x, z) at the center of the panel
/// * `half_depth`: half of the visible range along z
pub(crate) fn panel(id: &'static str, rect: Rect, middle: (f64, f64), half_depth: f64) -> Panel {
    let half_width = half_depth * rect.width / rect.height.max(1e-9);
    let across = [middle.0 - half_width, middle.0 + half_width];
    let away = [middle.1 + half_depth, middle.1 - half_depth];
    Panel::new(id, rect, across, away)
}

/// Creates a panel that shows these ranges with a margin of `room`, with one scale for both
/// directions.
pub(crate) fn panel_of(id: &'static str, rect: Rect, [x, z]: [[f64; 2]; 2], room: f64) -> Panel {
    let middle = |[low, high]: [f64; 2]| (low + high) / 2.0;
    let half = |[low, high]: [f64; 2]| (high - low) / 2.0 + room;
    let half_depth = half(z).max(half(x) * rect.height / rect.width.max(1e-9));
    panel(id, rect, (middle(x), middle(z)), half_depth)
}

/// A camera in a top view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlanCamera {
    /// Center, (x, z).
    pub(crate) center: Point2<f64>,
    /// Direction of the optical axis: 0 along z, positive to the right, radians.
    pub(crate) heading_rad: f64,
    /// Half the width of the field of view at distance 1.
    pub(crate) half_width: f64,
    /// Hue and shape.
    pub(crate) mark: (Role, Shape),
}

impl PlanCamera {
    /// Returns the directions of the optical axis and of the image's rows.
    fn axes(&self) -> (Vector2<f64>, Vector2<f64>) {
        let (sin, cos) = (libm::sin(self.heading_rad), libm::cos(self.heading_rad));
        (Vector2::new(sin, cos), Vector2::new(cos, -sin))
    }

    /// Returns a point of the image plane `depth` in front of the center; `across` is measured from
    /// the optical axis in units of half the image.
    pub(crate) fn on_image(&self, across: f64, depth: f64) -> Point2<f64> {
        let (forward, right) = self.axes();
        self.center + (forward + right * (across * self.half_width)) * depth
    }

    /// Draws the center, the image plane `depth` in front of it, and the rays to its ends.
    pub(crate) fn draw(&self, canvas: &mut Canvas, panel: &Panel, depth: f64) {
        let (role, shape) = self.mark;
        let at = |point: &Point2<f64>| panel.place_of(point);
        let center = at(&self.center);
        let ends = [-1.0, 1.0].map(|across| at(&self.on_image(across, depth)));
        for end in ends {
            canvas.line(center, end, Stroke::solid(role, 1.25));
        }
        canvas.line(ends[0], ends[1], Stroke::solid(role, 3.0));
        canvas.marker(center, 5.5, shape, role, true);
    }

    /// Draws the edges of the field of view, clipped to the panel.
    pub(crate) fn draw_view(&self, canvas: &mut Canvas, panel: &Panel) {
        for across in [-1.0, 1.0] {
            let towards = self.on_image(across, 1.0) - self.center;
            draw_ray(
                canvas,
                panel,
                &self.center,
                &towards,
                Stroke::solid(Role::Edge, 1.0),
            );
        }
    }
}

impl PlanCamera {
    /// Draws the camera with its field of view, its image plane `depth` in front of it, a viewing
    /// ray with its pixel, and its name beside the center.
    pub(crate) fn draw_sight(
        &self,
        canvas: &mut Canvas,
        panel: &Panel,
        labels: &mut Labels,
        (name, side): (&str, Align),
        depth: f64,
        towards: &Vector2<f64>,
    ) {
        let (role, shape) = self.mark;
        self.draw_view(canvas, panel);
        draw_ray(
            canvas,
            panel,
            &self.center,
            towards,
            Stroke::solid(role, 1.75),
        );
        self.draw(canvas, panel, depth);
        let at = |point: Point2<f64>| panel.place_of(&point);
        let ahead = towards.dot(&self.axes().0);
        if ahead > 1e-9 {
            let pixel = self.center + towards * (depth / ahead);
            canvas.marker(at(pixel), 4.5, shape, role, true);
        }
        let (x, y) = at(self.center);
        labels.keep_free((x, y), 8.0);
        let place = match side {
            Align::Start => (x + 13.0, y),
            Align::Middle => (x, y - 20.0),
            Align::End => (x - 13.0, y),
        };
        let style = TextStyle::new(role, TEXT).cased();
        labels.draw(canvas, &[(place, side)], name, style);
    }
}

/// Draws a ray from a point to outside of the panel.
pub(crate) fn draw_ray(
    canvas: &mut Canvas,
    panel: &Panel,
    from: &Point2<f64>,
    towards: &Vector2<f64>,
    stroke: Stroke,
) {
    let Some(direction) = towards.try_normalize(1e-12) else {
        return;
    };
    let extent = |axis: Axis| (axis.end - axis.start).abs();
    let reach = |place: f64, axis: Axis| (place - axis.start).abs() + (place - axis.end).abs();
    // Farther than any corner of the panel.
    let far = extent(panel.x_axis)
        + extent(panel.y_axis)
        + reach(from.x, panel.x_axis)
        + reach(from.y, panel.y_axis);
    let to = from + direction * far;
    let at = |point: &Point2<f64>| panel.place_of(point);
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        canvas.line(at(from), at(&to), stroke)
    });
}

/// Draws horizontal lines at round distances with their numbers, such as "2 m".
pub(crate) fn draw_distances(canvas: &mut Canvas, panel: &Panel, unit: &str) {
    let rect = panel.rect;
    for z in round_distances(panel).1 {
        let y = panel.canvas_from_world((0.0, z)).1;
        canvas.line(
            (rect.x + 1.0, y),
            (rect.right() - 1.0, y),
            Stroke::solid(Role::Grid, 1.0),
        );
    }
    draw_numbers(canvas, panel, unit);
}

/// Draws only the numbers of [`draw_distances`] once more, above a ray that would cross them.
pub(crate) fn draw_numbers(canvas: &mut Canvas, panel: &Panel, unit: &str) {
    let (spacing, distances) = round_distances(panel);
    let digits = if spacing < 1.0 { 1 } else { 0 };
    let rect = panel.rect;
    let style = TextStyle::new(Role::Muted, SMALL).cased();
    for z in distances {
        let y = panel.canvas_from_world((0.0, z)).1;
        if z > 0.0 && y > rect.y + 8.0 {
            let text = format!("{} {unit}", format_number(z, digits));
            canvas.label((rect.x + 8.0, y), &text, style);
        }
    }
}

/// Returns the spacing and the round distances within a top view.
fn round_distances(panel: &Panel) -> (f64, impl Iterator<Item = f64>) {
    let (near, far) = (panel.y_axis.end, panel.y_axis.start);
    let pixels = panel.rect.height / (far - near).abs().max(1e-9);
    let spacing = round_length(SPACING / pixels);
    let first = (near / spacing).ceil().max(0.0);
    let distances = (0..)
        .map(move |index| (first + f64::from(index)) * spacing)
        .take_while(move |z| *z < far);
    (spacing, distances)
}

/// Draws a scale bar of a round length with its label, at the lower left.
pub(crate) fn draw_rule(canvas: &mut Canvas, panel: &Panel, words: impl Fn(f64) -> String) {
    let length = round_length(RULE / panel.scale_x());
    let left: Place = (panel.rect.x + 12.0, panel.rect.bottom() - 12.0);
    let right = (left.0 + length * panel.scale_x(), left.1);
    draw_span(canvas, left, right, Stroke::solid(Role::Muted, 1.5));
    let style = TextStyle::new(Role::Muted, SMALL).cased();
    canvas.label((right.0 + 7.0, right.1), &words(length), style);
}

/// Draws a horizontal line with a short stroke across each end.
pub(crate) fn draw_span(canvas: &mut Canvas, left: Place, right: Place, stroke: Stroke) {
    canvas.line(left, right, stroke);
    for end in [left, right] {
        canvas.line((end.0, end.1 - 4.0), (end.0, end.1 + 4.0), stroke);
    }
}

/// Rounds up to 0.1, 0.2, 0.5, 1, 2, 5, 10 …
fn round_length(length: f64) -> f64 {
    let mut power = 1e-3;
    while power < 1e6 {
        if let Some(times) = [1.0, 2.0, 5.0].into_iter().find(|n| n * power >= length) {
            return times * power;
        }
        power *= 10.0;
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_scale_for_both_directions() {
        let panel = panel("top", Rect::new(0.0, 0.0, 400.0, 200.0), (1.0, 2.0), 2.0);
        assert_eq!(panel.canvas_from_world((1.0, 2.0)), (200.0, 100.0));
        assert_eq!(panel.canvas_from_world((2.0, 3.0)), (250.0, 50.0));
    }

    #[test]
    fn all_ranges_are_shown() {
        let ranges = [[-1.0, 2.0], [0.0, 3.0]];
        for (width, height) in [(400.0, 100.0), (100.0, 400.0)] {
            let panel = panel_of("top", Rect::new(0.0, 0.0, width, height), ranges, 0.1);
            for (x, z) in [(-1.0, 0.0), (2.0, 3.0)] {
                assert!(panel.rect.contains(panel.canvas_from_world((x, z))));
            }
        }
    }

    #[test]
    fn a_camera_that_looks_to_the_right_has_its_image_there() {
        let camera = PlanCamera {
            center: Point2::new(1.0, 0.0),
            heading_rad: std::f64::consts::FRAC_PI_2,
            half_width: 0.5,
            mark: (Role::Ink, Shape::Disk),
        };
        let middle = camera.on_image(0.0, 2.0);
        assert!((middle - Point2::new(3.0, 0.0)).norm() < 1e-12);
        // Its right end is closer to the reader.
        let right = camera.on_image(1.0, 2.0);
        assert!((right - Point2::new(3.0, -1.0)).norm() < 1e-12);
    }

    #[test]
    fn rules_have_round_lengths() {
        assert_eq!(
            [0.7, 1.0, 3.1, 61.0].map(round_length),
            [1.0, 1.0, 5.0, 100.0]
        );
    }
}
