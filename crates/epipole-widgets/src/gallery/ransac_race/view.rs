//! The plane with its points and lines, and a legend below.

use super::model::{HEIGHT_PX, RansacRace, WIDTH_PX};
use crate::canvas::{Canvas, Dash, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Layout, Panel, Rect, View};
use crate::legend::{self, Entry, Swatch};
use crate::theme::Role;
use epipole::math::Line2;

const MARGIN: f64 = 8.0;

/// Draws [`RansacRace`].
#[derive(Default)]
pub struct RansacRaceView;

fn legend() -> [Entry; 6] {
    [
        (Swatch::Line(least_squares_stroke()), "least squares"),
        (Swatch::Line(candidate_stroke()), "this sample"),
        (Swatch::Line(best_stroke()), "best so far"),
        (Swatch::Line(truth_stroke()), "hidden truth"),
        (
            Swatch::Marker(Shape::Disk, Role::Inlier),
            "inlier of the best",
        ),
        (Swatch::Marker(Shape::Cross, Role::Outlier), "outlier"),
    ]
}

fn least_squares_stroke() -> Stroke {
    Stroke::solid(Role::Reference, 2.5).dashed()
}

fn candidate_stroke() -> Stroke {
    Stroke::solid(Role::Candidate, 1.75)
}

fn best_stroke() -> Stroke {
    Stroke::solid(Role::Best, 3.5)
}

fn truth_stroke() -> Stroke {
    Stroke::solid(Role::Truth, 2.0).dotted()
}

impl View for RansacRaceView {
    type Model = RansacRace;

    fn layout(&self, _: &RansacRace, width: f64) -> Layout {
        let plane_width = (width - 2.0 * MARGIN).max(1.0);
        let plane_height = plane_width * HEIGHT_PX / WIDTH_PX;
        let legend_height = legend::height(&legend(), width, MARGIN);
        Layout {
            width,
            height: plane_height + legend_height + 2.5 * MARGIN,
            panels: vec![Panel {
                id: "plane",
                rect: Rect::new(MARGIN, MARGIN, plane_width, plane_height),
                x_axis: Axis {
                    start: 0.0,
                    end: WIDTH_PX,
                },
                y_axis: Axis {
                    start: 0.0,
                    end: HEIGHT_PX,
                },
                clickable: true,
            }],
        }
    }

    fn draw(&mut self, model: &RansacRace, layout: &Layout, canvas: &mut Canvas) {
        let plane = layout.panel("plane");
        canvas.panel(plane.rect);
        canvas.clipped(plane.rect.inset(1.0), |canvas| {
            let candidate = model.candidate().and_then(|candidate| candidate.line);
            if let Some(line) = &candidate {
                band(canvas, plane, line, model.epsilon_px());
            }
            draw_line(canvas, plane, model.truth(), truth_stroke());
            if let Some(line) = model.least_squares() {
                draw_line(canvas, plane, line, least_squares_stroke());
            }
            if let Some(line) = &candidate {
                draw_line(canvas, plane, line, candidate_stroke());
            }
            if let Some(best) = model.best() {
                draw_line(canvas, plane, &best.line, best_stroke());
            }
            points(canvas, plane, model);
        });
        status(canvas, plane, model);
        let top = plane.rect.bottom() + 0.75 * MARGIN;
        legend::draw(canvas, &legend(), layout.width, MARGIN, top);
    }
}

/// Both ends of a line, beyond the panel.
fn ends(plane: &Panel, line: &Line2, offset_px: f64) -> [(f64, f64); 2] {
    let foot = (
        -(line.c - offset_px) * line.a,
        -(line.c - offset_px) * line.b,
    );
    let reach = 4.0 * WIDTH_PX;
    [-reach, reach]
        .map(|along| plane.canvas_from_world((foot.0 - along * line.b, foot.1 + along * line.a)))
}

fn draw_line(canvas: &mut Canvas, plane: &Panel, line: &Line2, stroke: Stroke) {
    let [from, to] = ends(plane, line, 0.0);
    canvas.line(from, to, stroke);
}

/// The strip of places within the threshold of the sample's line.
fn band(canvas: &mut Canvas, plane: &Panel, line: &Line2, epsilon_px: f64) {
    let [a, b] = ends(plane, line, -epsilon_px);
    let [d, c] = ends(plane, line, epsilon_px);
    canvas.polygon(&[a, b, c, d], Role::Candidate, 0.13);
    for (from, to) in [(a, b), (d, c)] {
        let edge = Stroke {
            dash: Dash::Dotted,
            ..Stroke::solid(Role::Candidate, 1.0)
        };
        canvas.line(from, to, edge);
    }
}

fn points(canvas: &mut Canvas, plane: &Panel, model: &RansacRace) {
    let radius = (plane.scale_x() * 4.5).clamp(3.0, 4.5);
    for (index, datum) in model.data().iter().enumerate() {
        let place = plane.canvas_from_world((datum.place.x, datum.place.y));
        let best = model.best().map(|best| best.is_inlier[index]);
        let (shape, role) = match best {
            Some(true) => (Shape::Disk, Role::Inlier),
            Some(false) => (Shape::Cross, Role::Outlier),
            None => (Shape::Disk, Role::Muted),
        };
        canvas.marker(place, radius, shape, role, false);
        if let Some(candidate) = model.candidate() {
            if candidate.is_inlier.get(index) == Some(&true) {
                canvas.circle(place, radius + 2.5, Stroke::solid(Role::Candidate, 1.25));
            }
            if candidate.sample.contains(&index) {
                canvas.circle(place, radius + 5.5, Stroke::solid(Role::Candidate, 3.0));
            }
        }
    }
}

/// A word in the corner on where the run stands.
fn status(canvas: &mut Canvas, plane: &Panel, model: &RansacRace) {
    let text = match model.problem() {
        Some(problem) => problem,
        None if model.finished() => "enough samples drawn",
        None if model.candidate().is_none() => "press Run or Step",
        None => return,
    };
    let place = (plane.rect.x + 10.0, plane.rect.y + 20.0);
    canvas.text(place, text, TextStyle::new(Role::Ink, 13.0).cased());
}
