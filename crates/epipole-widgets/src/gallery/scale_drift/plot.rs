//! The scale of each frame on a logarithmic axis, where an even drift is a straight line, above the
//! track of the grip that says how far the camera has come.

use super::model::ScaleDrift;
use super::view::{after_stroke, before_stroke, truth_stroke};
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Panel, Rect};
use crate::theme::Role;

const TEXT: f64 = 13.0;
const SMALL: f64 = 12.0;
/// Room for the labels of the vertical axis and of the horizontal one.
const LEFT: f64 = 36.0;
const BELOW: f64 = 38.0;
/// Height of the track of the grip, which runs between the plot and the numbers of the frames.
const TRACK: f64 = 22.0;
const TITLE: f64 = 24.0;
/// Room for the number of a frame.
const LABEL: f64 = 30.0;
/// Scales that are labeled, if the plot shows them.
const TICKS: [(f64, &str); 9] = [
    (0.05, "0.05"),
    (0.1, "0.1"),
    (0.2, "0.2"),
    (0.5, "0.5"),
    (1.0, "1"),
    (2.0, "2"),
    (5.0, "5"),
    (10.0, "10"),
    (20.0, "20"),
];
/// The plot shows at least the scales from half to double.
const LEAST: f64 = 2.0;
/// Space above and below the curves, in powers of ten.
const MARGIN: f64 = 0.06;

/// The plot within `rect`, and below it the track on which the grip runs, out of the way of the curves.
/// The vertical axis of the plot is the logarithm of the scale to base 10.
pub(super) fn panels(model: &ScaleDrift, rect: Rect) -> [Panel; 2] {
    let answer = model.answer();
    // All of the drive, so that the axes stay while the camera moves.
    let scales = answer.drive.scale.iter().copied();
    let closed = answer.after.iter().flatten().flat_map(|after| &after.scale);
    let decades = scales.chain(closed.copied()).map(decade);
    let least = libm::log10(LEAST);
    let (low, high) = decades.fold((-least, least), |(low, high), decade| {
        (low.min(decade), high.max(decade))
    });
    let steps = model.num_steps() as f64;
    let plot = Panel {
        id: "plot",
        rect: Rect::new(
            rect.x + LEFT,
            rect.y + TITLE,
            (rect.width - LEFT - 8.0).max(1.0),
            (rect.height - TITLE - TRACK - BELOW).max(1.0),
        ),
        x_axis: Axis {
            start: -0.03 * steps,
            end: 1.06 * steps,
        },
        y_axis: Axis {
            start: high + MARGIN,
            end: low - MARGIN,
        },
        clickable: true,
    };
    let track = Panel {
        id: "track",
        rect: Rect::new(plot.rect.x, plot.rect.bottom(), plot.rect.width, TRACK),
        x_axis: plot.x_axis,
        y_axis: Axis {
            start: 1.0,
            end: -1.0,
        },
        clickable: true,
    };
    [plot, track]
}

fn decade(scale: f64) -> f64 {
    libm::log10(scale.max(1e-9))
}

pub(super) fn draw(model: &ScaleDrift, [plot, track]: [&Panel; 2], canvas: &mut Canvas) {
    let answer = model.answer();
    draw_axes(model, [plot, track], canvas);
    let places = |scales: &[f64]| -> Vec<Place> {
        let place =
            |(frame, scale): (usize, &f64)| plot.canvas_from_world((frame as f64, decade(*scale)));
        scales.iter().enumerate().map(place).collect()
    };
    let traveled = model.traveled() as f64;
    canvas.clipped(plot.rect.inset(1.0), |canvas| {
        let x = plot.canvas_from_world((traveled, 0.0)).0;
        let now = Stroke::solid(Role::Grip, 1.5).dashed();
        canvas.line((x, plot.rect.y), (x, plot.rect.bottom()), now);
        if let Some(Ok(after)) = &answer.after {
            canvas.polyline(&places(&after.scale), after_stroke());
        }
        let before = places(&answer.before.scale);
        canvas.polyline(&before, before_stroke());
        let ends = [0.0, plot.x_axis.end];
        let ends = ends.map(|frame| plot.canvas_from_world((frame, 0.0)));
        canvas.line(ends[0], ends[1], truth_stroke());
        if let Some(end) = before.last() {
            canvas.marker(*end, 5.0, Shape::Square, Role::Series(1), true);
        }
    });
    let way = [0.0, model.num_steps() as f64];
    let [from, to] = way.map(|frame| track.canvas_from_world((frame, 0.0)));
    canvas.line(from, to, Stroke::solid(Role::Muted, 1.5));
    canvas.grip(track.canvas_from_world((traveled, 0.0)), Role::Grip);
}

fn draw_axes(model: &ScaleDrift, [plot, track]: [&Panel; 2], canvas: &mut Canvas) {
    let rect = plot.rect;
    canvas.panel(rect);
    let ink = TextStyle::new(Role::Ink, TEXT);
    let place = (rect.x - LEFT + 2.0, rect.y - TITLE / 2.0);
    canvas.label(place, "Scale of each frame", ink);
    let muted = TextStyle::new(Role::Muted, SMALL);
    let grid = Stroke::solid(Role::Grid, 1.0);
    for (scale, text) in TICKS {
        let y = plot.canvas_from_world((0.0, decade(scale))).1;
        if (rect.y + 4.0..rect.bottom() - 4.0).contains(&y) {
            canvas.line((rect.x + 1.0, y), (rect.right() - 1.0, y), grid);
            canvas.label((rect.x - 6.0, y), text, muted.end());
        }
    }
    let room = plot.scale_x() * 20.0;
    let stride = if room < LABEL { 40 } else { 20 };
    for frame in (0..=model.num_steps()).step_by(stride) {
        let x = plot.canvas_from_world((frame as f64, 0.0)).0;
        let text = frame.to_string();
        canvas.label((x, track.rect.bottom() + 11.0), &text, muted.middle());
    }
    let place = (rect.center().0, track.rect.bottom() + 27.0);
    canvas.label(place, "frame", muted.middle());
}
