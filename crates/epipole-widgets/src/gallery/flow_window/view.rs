//! The photograph with the window, the window in both frames, and the plane of motions, in which
//! each pixel is a line.

use super::flow::{Equation, Flow, REACH};
use super::model::{FlowWindow, Shown};
use super::question::SIZE;
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::heat::Heat;
use crate::kit::labels::Labels;
use crate::kit::rectified;
use crate::kit::terrain::Terrain;
use crate::theme::{Role, Theme, mix};
use image::RgbImage;
use nalgebra::Vector2;

/// Height over width of the photograph.
const ASPECT: f64 = grid::aspect(SIZE);
/// Difference of the windows between neighboring level lines, and at full saturation, gray values
/// in [0, 1].
const LEVEL: f64 = 0.025;
const STRONG: f64 = 0.35;
/// Height of the windows' names, CSS pixels.
const NAMES: f64 = 18.0;

/// Draws [`FlowWindow`].
#[derive(Default)]
pub(crate) struct FlowWindowView {
    map: Heat,
}

impl View for FlowWindowView {
    type Model = FlowWindow;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &FlowWindow, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (photo, windows, plane);
        if grid::is_narrow(width) {
            [photo, windows] = grid.row([ASPECT, 1.05], 156.0);
            [plane] = grid.row([1.0], 172.0);
        } else {
            let [left, right] = grid.row([1.14, 1.0], 392.0);
            let photo_height = ASPECT * left.width;
            photo = Rect::new(left.x, left.y, left.width, photo_height);
            let top = photo.bottom() + grid::GAP + grid::TITLE;
            windows = Rect::new(left.x, top, left.width, left.bottom() - top);
            plane = right;
        }
        let reach = REACH as f64 + 0.5;
        grid.layout(vec![
            Panel::photograph("photo", photo, SIZE).clickable(),
            Panel::new("windows", windows, [0.0, 1.0], [0.0, 1.0]),
            Panel::new("plane", plane, [-reach, reach], [-reach, reach]).clickable(),
        ])
    }

    fn draw(&mut self, model: &FlowWindow, layout: &Layout, canvas: &mut Canvas) {
        let [photo, windows, plane] = layout.panels_named(["photo", "windows", "plane"]);
        grid::open(canvas, photo, &["Frame 1: drag the window", "Frame 1"]);
        let titles: &[&str] = match model.shown() {
            Shown::Equations => &[
                "Motions up to 6 px: a line per pixel",
                "Motions: a line per pixel",
            ],
            Shown::Difference => &["Difference by motion, up to 6 px", "Difference by motion"],
        };
        grid::open(canvas, plane, titles);
        grid::fitting_title(
            canvas,
            windows.rect,
            &["The window in both frames", "The window"],
        );
        if let Some(photograph) = model.asked.answer() {
            canvas.photograph(photo.rect, photograph.image());
        }
        let flow = match model.flow() {
            Ok(flow) => flow,
            Err(sentence) => return grid::notice(canvas, photo.rect, sentence),
        };
        canvas.clipped(photo.rect, |canvas| draw_places(model, photo, canvas));
        draw_windows(model, flow, windows.rect, canvas);
        let height = |(du, dv): (f64, f64)| flow.difference(Vector2::new(du, dv));
        if model.shown() == Shown::Difference {
            let terrain = Terrain {
                reach: REACH,
                height: &height,
            };
            let theme = canvas.theme();
            let [map] = (self.map).maps(model.version, theme, || [colored(&terrain, theme)]);
            canvas.photograph(plane.rect, map);
        }
        draw_plane(model, flow, plane, canvas);
    }
}

/// Draws the window, and its position found in frame 2.
fn draw_places(model: &FlowWindow, panel: &Panel, canvas: &mut Canvas) {
    let half = (f64::from(model.setup().half) + 0.5) * panel.scale_x();
    let place = model.place.place();
    let center = panel.canvas_from_world(place);
    if let Some(found) = model.found() {
        let there = panel.canvas_from_world((place.0 + found.x, place.1 + found.y));
        let stroke = Stroke::solid(Role::Best, 2.0).cased().dashed();
        canvas.stroke_rect(Rect::around(there, half), stroke);
    }
    rectified::draw_window(canvas, center, half);
}

/// Draws the window of frame 1, and those of frame 2 at the same position and at the one found.
fn draw_windows(model: &FlowWindow, flow: &Flow, rect: Rect, canvas: &mut Canvas) {
    let found = model.found().unwrap_or_else(Vector2::zeros);
    let [before, there] = flow.windows(found);
    let [_, same] = flow.windows(Vector2::zeros());
    let windows = [
        (before, "frame 1", Role::Grip),
        (same, "2, same place", Role::Muted),
        (there, "2, as found", Role::Best),
    ];
    let is_row = rect.width > rect.height;
    let side = match is_row {
        true => (rect.width / 3.0 - grid::GAP).min(rect.height - NAMES),
        false => rect.height / 3.0 - 6.0,
    };
    for (index, (window, name, role)) in windows.into_iter().enumerate() {
        let index = index as f64;
        let corner = match is_row {
            true => (rect.x + index * rect.width / 3.0, rect.y),
            false => (rect.x, rect.y + index * rect.height / 3.0),
        };
        let square = Rect::new(corner.0, corner.1, side.max(1.0), side.max(1.0));
        canvas.photograph(square, &gray_picture(&window));
        canvas.stroke_rect(square, Stroke::solid(role, 2.0));
        let style = TextStyle::new(Role::Ink, SMALL);
        let place = match is_row {
            true => (square.x, square.bottom() + NAMES / 2.0 + 2.0),
            false => (square.right() + 8.0, square.center().1),
        };
        canvas.label(place, name, style);
    }
}

fn gray_picture(window: &epipole::imaging::GrayImage32) -> RgbImage {
    RgbImage::from_fn(window.width(), window.height(), |u, v| {
        let level = (255.0 * window.get_pixel(u, v).0[0])
            .round()
            .clamp(0.0, 255.0);
        image::Rgb([level as u8; 3])
    })
}

/// Colors the differences, with level lines.
fn colored(terrain: &Terrain, theme: Theme) -> RgbImage {
    let [pale, strong, line] =
        [Role::Surface, Role::Candidate, Role::Ink].map(|role| theme.color(role));
    let colors = |level: usize| {
        let share = (level as f64 * LEVEL / STRONG).min(1.0);
        let color = mix(pale, strong, 0.8 * share as f32);
        [color, mix(color, line, 0.45)]
    };
    terrain.map(|difference| (difference / LEVEL) as usize, colors)
}

/// Draws the axes, the equations, the steps, and the true motion.
fn draw_plane(model: &FlowWindow, flow: &Flow, panel: &Panel, canvas: &mut Canvas) {
    let reach = REACH as f64 + 0.5;
    let at = |motion: Vector2<f64>| panel.canvas_from_world((motion.x, motion.y));
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let axis = Stroke::solid(Role::Grid, 1.0);
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        for (from, to) in [((-reach, 0.0), (reach, 0.0)), ((0.0, -reach), (0.0, reach))] {
            canvas.line(
                panel.canvas_from_world(from),
                panel.canvas_from_world(to),
                axis,
            );
        }
        if model.shown() == Shown::Equations {
            for equation in &flow.equations {
                if let Some([from, to]) = line_of(equation, panel) {
                    canvas.line(from, to, Stroke::solid(Role::Candidate, 0.75));
                }
            }
        }
    });
    let small = TextStyle::new(Role::Muted, SMALL).cased();
    let rect = panel.rect;
    let (x, y) = at(Vector2::zeros());
    canvas.label((rect.right() - 6.0, y - 10.0), "right", small.end());
    canvas.label((x + 6.0, rect.bottom() - 12.0), "down", small);
    let steps: Vec<Place> = flow.path.iter().map(|motion| at(*motion)).collect();
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        canvas.polyline(&steps, Stroke::solid(Role::Best, 2.0).cased());
        for place in &steps {
            canvas.marker(*place, 3.0, Shape::Disk, Role::Best, true);
            labels.keep_free(*place, 5.0);
        }
    });
    let truth = at(model.setup().motion);
    canvas.grip(truth, Role::Truth);
    labels.keep_free(truth, 9.0);
    labels.name(canvas, (truth, 10.0), "true", (Role::Truth, SMALL));
    if let Some(found) = model.found().map(at) {
        canvas.marker(found, 5.0, Shape::Diamond, Role::Best, true);
        if rect.contains(found) {
            labels.name(canvas, (found, 10.0), "found", (Role::Best, SMALL));
        }
    }
}

/// Returns the ends of an equation's line, beyond the panel on both sides.
fn line_of(equation: &Equation, panel: &Panel) -> Option<[Place; 2]> {
    let Equation { gradient, change } = equation;
    let squared = gradient.norm_squared();
    if squared <= 1e-8 {
        return None;
    }
    let foot = -gradient * (change / squared);
    let along = Vector2::new(-gradient.y, gradient.x) * (4.0 * REACH as f64 / squared.sqrt());
    let is_near = foot.norm() < 2.0 * REACH as f64;
    let ends = [foot - along, foot + along].map(|end| panel.canvas_from_world((end.x, end.y)));
    is_near.then_some(ends)
}
