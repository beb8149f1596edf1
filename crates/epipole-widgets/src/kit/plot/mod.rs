//! Plots: axes with ticks, linear or logarithmic, curves, and a line at the current value.
//!
//! A panel's world is linear, so the world of an axis in [`Ruler::decades`] is the logarithm to
//! base 10; [`decade`] converts values.

mod ruler;

pub(crate) use self::ruler::{Ruler, SIGMAS, decade};
use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle, text_width};
use crate::contract::{Axis, Layout, Panel, Rect};
use crate::kit::grid::{SMALL, fitting_title};
use crate::kit::labels::Labels;
use crate::theme::Role;

/// Width of the vertical axis's numbers, CSS pixels.
pub(crate) const LEFT: f64 = 42.0;
/// Height of the horizontal axis's numbers, CSS pixels.
const BELOW: f64 = 22.0;
/// Margin to the right of a plot, CSS pixels.
const RIGHT: f64 = 6.0;
/// Height of a handle's track below a plot, CSS pixels.
const TRACK: f64 = 24.0;
/// Height of the horizontal axis's name, CSS pixels.
const NAME: f64 = 17.0;
/// Font size of exponents, CSS pixels.
const RAISED: f64 = 9.0;
/// Minimum spacing of ticks along the horizontal and the vertical axis, CSS pixels.
const ACROSS: f64 = 58.0;
const DOWN: f64 = 30.0;

/// Draws the number of a tick. The text after a "^" is raised, since the font has no superscript
/// minus.
fn draw_number(canvas: &mut Canvas, (x, y): Place, text: &str, style: TextStyle) {
    let (base, raised) = text.split_once('^').unwrap_or((text, ""));
    if raised.is_empty() {
        return canvas.label((x, y), base, style);
    }
    let small = TextStyle {
        size: RAISED,
        align: Align::Start,
        ..style
    };
    let left = match style.align {
        Align::Start => x,
        Align::Middle => x - number_width(text) / 2.0,
        Align::End => x - number_width(text),
    };
    let base_style = TextStyle {
        size: SMALL,
        ..small
    };
    canvas.label((left, y), base, base_style);
    let beside = (left + text_width(base, SMALL) + 1.0, y - 4.0);
    canvas.label(beside, raised, small);
}

fn number_width(text: &str) -> f64 {
    let (base, raised) = text.split_once('^').unwrap_or((text, ""));
    text_width(base, SMALL) + text_width(raised, RAISED) + 1.0
}

/// Creates a plot's panel within a cell, with room for the numbers of its axes.
pub(crate) fn panel(id: &'static str, cell: Rect, x: &Ruler, y: &Ruler) -> Panel {
    let below = if x.name.is_empty() {
        BELOW
    } else {
        BELOW + NAME
    };
    let rect = Rect::new(
        cell.x + LEFT,
        cell.y,
        (cell.width - LEFT - RIGHT).max(1.0),
        (cell.height - below).max(1.0),
    );
    Panel::new(id, rect, [x.from, x.to], [y.to, y.from])
}

/// Creates a plot's panel and below it that of a [`track`](draw_track), with the same horizontal
/// range.
pub(crate) fn panel_and_track(id: &'static str, cell: Rect, x: &Ruler, y: &Ruler) -> [Panel; 2] {
    let above = Rect::new(cell.x, cell.y, cell.width, cell.height - TRACK);
    let plot = panel(id, above, x, y).clickable();
    // Below the numbers, away from the curves.
    let track = Panel {
        id: "track",
        rect: Rect::new(plot.rect.x, above.bottom(), plot.rect.width, TRACK),
        y_axis: Axis {
            start: 1.0,
            end: -1.0,
        },
        ..plot
    };
    [plot, track]
}

/// Draws the track of a handle that moves along a plot's horizontal axis.
///
/// * `ends`: values at the ends of the track
pub(crate) fn draw_track(canvas: &mut Canvas, track: &Panel, ends: [f64; 2], now: f64) {
    let [from, to] = ends.map(|at| track.canvas_from_world((at, 0.0)));
    canvas.line(from, to, Stroke::solid(Role::Muted, 1.5));
    canvas.grip(track.canvas_from_world((now, 0.0)), Role::Grip);
}

/// Draws a plot's axes and title: the first text that fits.
pub(crate) fn open<'a>(
    canvas: &mut Canvas,
    layout: &'a Layout,
    id: &str,
    titles: &[&str],
    [x, y]: &[Ruler; 2],
) -> &'a Panel {
    let panel = layout.panel(id);
    fitting_title(canvas, panel.rect, titles);
    draw_axes(canvas, panel, x, y);
    panel
}

/// Draws the title of a plot, the first text that fits, aligned with the numbers of the vertical
/// axis.
pub(crate) fn title_from_left(canvas: &mut Canvas, panel: &Panel, titles: &[&str]) {
    let Rect { x, width, .. } = panel.rect;
    let above = Rect {
        x: x - LEFT,
        width: width + LEFT,
        ..panel.rect
    };
    fitting_title(canvas, above, titles);
}

/// Draws the background, the ticks and their numbers.
pub(crate) fn draw_axes(canvas: &mut Canvas, panel: &Panel, x: &Ruler, y: &Ruler) {
    let rect = panel.rect;
    canvas.panel(rect);
    let style = TextStyle::new(Role::Muted, SMALL);
    let grid = Stroke::solid(Role::Grid, 1.0);
    for (at, text) in y.ticks(rect.height, DOWN) {
        let v = panel.canvas_from_world((x.from, at)).1;
        canvas.line((rect.x + 1.0, v), (rect.right() - 1.0, v), grid);
        // At the very top, half of a number would overlap the title.
        let beside = v.max(rect.y + 4.0);
        draw_number(canvas, (rect.x - 6.0, beside), &text, style.end());
    }
    for (at, text) in x.ticks(rect.width, ACROSS) {
        let u = panel.canvas_from_world((at, y.from)).0;
        canvas.line((u, rect.y + 1.0), (u, rect.bottom() - 1.0), grid);
        // At the very right, there is no room for half of a number.
        let middle = u.min(rect.right() + RIGHT - number_width(&text) / 2.0);
        draw_number(
            canvas,
            (middle, rect.bottom() + 12.0),
            &text,
            style.middle(),
        );
    }
    if !x.name.is_empty() {
        let place = (rect.center().0, rect.bottom() + BELOW + 7.0);
        canvas.label(place, x.name, style.middle());
    }
}

/// Draws a curve in the panel's world, clipped to the panel.
pub(crate) fn draw_curve(
    canvas: &mut Canvas,
    panel: &Panel,
    places: impl IntoIterator<Item = (f64, f64)>,
    stroke: Stroke,
) {
    let places: Vec<Place> = (places.into_iter())
        .map(|place| panel.canvas_from_world(place))
        .collect();
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        canvas.polyline(&places, stroke)
    });
}

/// A curve with marks over an axis of named items, in decades.
pub(crate) struct List<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) stroke: Stroke,
    /// Shape and radius of the marks, CSS pixels.
    pub(crate) mark: (Shape, f64),
    /// Name, and the index of the value at which it is drawn.
    pub(crate) name: (&'a str, usize),
}

/// Draws lists, and then their names beside them. Values beyond the axis are drawn at its end.
pub(crate) fn draw_lists(canvas: &mut Canvas, panel: &Panel, lists: &[List]) {
    let mut labels = Labels::new(panel.rect.inset(2.0));
    let world = |(k, value): (usize, &f64)| {
        let decade = decade(*value).clamp(panel.y_axis.end, panel.y_axis.start);
        (k as f64 + 1.0, decade)
    };
    for list in lists {
        let places = || list.values.iter().enumerate().map(world);
        draw_curve(canvas, panel, places(), list.stroke);
        for place in places() {
            let (x, y) = panel.canvas_from_world(place);
            let place = (x, y.clamp(panel.rect.y + 5.0, panel.rect.bottom() - 5.0));
            let (shape, radius) = list.mark;
            canvas.marker(place, radius, shape, list.stroke.role, false);
            labels.keep_free(place, 6.0);
        }
    }
    for list in lists {
        let (name, index) = list.name;
        let place = panel.canvas_from_world(world((index, &list.values[index])));
        labels.name(canvas, (place, 8.0), name, (list.stroke.role, SMALL));
    }
}

/// Draws the line at the current value of the horizontal axis.
pub(crate) fn draw_now(canvas: &mut Canvas, panel: &Panel, x: f64) {
    let u = panel.canvas_from_world((x, 0.0)).0;
    let rect = panel.rect;
    let stroke = Stroke::solid(Role::Grip, 1.5).dashed();
    canvas.clipped(rect.inset(1.0), |canvas| {
        canvas.line((u, rect.y), (u, rect.bottom()), stroke);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_leaves_room_for_numbers() {
        let (x, y) = (Ruler::linear(0.0, 10.0), Ruler::decades(-1.0, 3.0));
        let panel = panel("cost", Rect::new(0.0, 24.0, 300.0, 180.0), &x, &y);
        assert_eq!(panel.canvas_from_world((0.0, 3.0)), (LEFT, 24.0));
        assert_eq!(panel.rect.bottom(), 24.0 + 180.0 - BELOW);
    }
}
