//! The pixels with the window and the line of each gradient, and beside it a close-up of the steps.

use super::model::{State, SubPixel};
use super::patch::{CORNER, SIZE, enlarged, gradient};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::rectified;
use crate::theme::Role;
use nalgebra::{Point2, Vector2};

/// Pixels per side of a pixel in the enlarged picture.
const TIMES: u32 = 8;
/// Minimum gradient drawn as a line, gray values in [0, 1] per pixel.
const FAINTEST: f64 = 0.14;
/// Half size of the close-up around the true corner, pixels.
const REACH_PX: f64 = 1.5;
/// Between the panels and the legend, CSS pixels.
const LEGEND_GAP: f64 = 4.0;
const LINE: Stroke = Stroke::solid(Role::Candidate, 1.0);
const LEGEND: [Entry; 4] = [
    (Swatch::Line(LINE), "line of a gradient"),
    (Swatch::Marker(Shape::Disk, Role::Grip), "steps"),
    (Swatch::Marker(Shape::Diamond, Role::Best), "corner found"),
    (Swatch::Marker(Shape::Ring, Role::Truth), "truth"),
];

/// Draws [`SubPixel`].
#[derive(Default)]
pub(crate) struct SubPixelView;

impl View for SubPixelView {
    type Model = SubPixel;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &SubPixel, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [patch, close] = match grid::is_narrow(width) {
            true => {
                let [patch] = grid.row([grid::aspect(SIZE)], 166.0);
                let [close] = grid.row([0.5], 96.0);
                [patch, close]
            }
            false => grid.row([grid::aspect(SIZE), 1.0], 380.0),
        };
        grid.strip(LEGEND_GAP + legend::height(&LEGEND, width, 0.0));
        let down = REACH_PX * (close.height / close.width).min(1.0);
        let x = [CORNER.x - REACH_PX, CORNER.x + REACH_PX];
        let y = [CORNER.y - down, CORNER.y + down];
        grid.layout(vec![
            Panel::photograph("patch", patch, SIZE).clickable(),
            Panel::new("close", close, x, y),
        ])
    }

    fn draw(&mut self, model: &SubPixel, layout: &Layout, canvas: &mut Canvas) {
        let [patch, close] = layout.panels_named(["patch", "close"]);
        let state = model.state();
        grid::open(canvas, patch, &["The pixels: drag the start", "The pixels"]);
        canvas.photograph(patch.rect, &enlarged(&state.image, TIMES));
        let center = state.corner().unwrap_or(state.path[0]);
        let half = (model.half() as f64 + 0.5) * patch.scale_x();
        let window = Rect::around(patch.place_of(&center), half);
        canvas.clipped(patch.rect, |canvas| {
            canvas.clipped(window, |canvas| {
                draw_lines(&state, (model.half(), center), patch, canvas)
            });
            rectified::draw_window(canvas, patch.place_of(&center), half);
            draw_path(&state, patch, canvas);
        });
        grid::open(
            canvas,
            close,
            &[
                "Around the true corner, a square a pixel",
                "Around the corner",
            ],
        );
        canvas.clipped(close.rect, |canvas| {
            draw_pixels(close, canvas);
            draw_lines(&state, (model.half(), center), close, canvas);
            draw_path(&state, close, canvas);
        });
        legend::draw_last(canvas, &LEGEND, layout, 0.0, 1.0);
    }
}

/// Draws for each pixel of the window the line on which its gradient constrains the corner.
fn draw_lines(
    state: &State,
    (half, center): (usize, Point2<f64>),
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let reach = half as f64 + 0.5;
    for (u, v) in (0..SIZE.0 * SIZE.1).map(|index| (index % SIZE.0, index / SIZE.0)) {
        let pixel = Point2::new(f64::from(u), f64::from(v));
        let slope = gradient(&state.image, (u, v));
        let is_near = (pixel - center).amax() <= reach;
        if !is_near || slope.norm() < FAINTEST {
            continue;
        }
        let along = Vector2::new(-slope.y, slope.x).normalize() * 60.0;
        let ends = [pixel - along, pixel + along].map(|end| panel.place_of(&end));
        canvas.line(ends[0], ends[1], LINE);
    }
}

/// Draws the borders of the pixels.
fn draw_pixels(panel: &Panel, canvas: &mut Canvas) {
    let stroke = Stroke::solid(Role::Edge, 1.0);
    let borders = |start: f64, end: f64| {
        let first = (start - 0.5).ceil();
        (0..8)
            .map(move |k| first + 0.5 + f64::from(k))
            .filter(move |at| *at < end)
    };
    for u in borders(panel.x_axis.start, panel.x_axis.end) {
        let [from, to] =
            [panel.y_axis.start, panel.y_axis.end].map(|v| panel.canvas_from_world((u, v)));
        canvas.line(from, to, stroke);
    }
    for v in borders(panel.y_axis.start, panel.y_axis.end) {
        let [from, to] =
            [panel.x_axis.start, panel.x_axis.end].map(|u| panel.canvas_from_world((u, v)));
        canvas.line(from, to, stroke);
    }
}

/// Draws the steps, the corner found and the true one.
fn draw_path(state: &State, panel: &Panel, canvas: &mut Canvas) {
    let places: Vec<_> = state
        .path
        .iter()
        .map(|place| panel.place_of(place))
        .collect();
    canvas.polyline(&places, Stroke::solid(Role::Grip, 2.0).cased());
    for place in &places[1..] {
        canvas.marker(*place, 3.0, Shape::Disk, Role::Grip, true);
    }
    canvas.marker(panel.place_of(&CORNER), 6.0, Shape::Ring, Role::Truth, true);
    if let Some(corner) = state.corner() {
        canvas.marker(
            panel.place_of(&corner),
            4.5,
            Shape::Diamond,
            Role::Best,
            true,
        );
    }
    if panel.id == "patch" {
        canvas.grip(places[0], Role::Grip);
        let mut labels = Labels::new(panel.rect);
        labels.name(canvas, (places[0], 10.0), "start", (Role::Grip, SMALL));
    }
}
