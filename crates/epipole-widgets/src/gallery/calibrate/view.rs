//! Photographs of the board with their corners, and an error map of the calibrated camera.

use super::model::{Calibrate, VIEW_IDS};
use super::question::{Answer, CELLS, Found, SIZE};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, GAP, Grid};
use crate::kit::heat;
use crate::theme::{Role, Theme};
use image::RgbImage;

/// Returns the number of columns of photographs.
fn columns(width: f64) -> usize {
    if grid::is_narrow(width) { 5 } else { 4 }
}
/// Gap between photographs, CSS pixels.
const BETWEEN: f64 = 6.0;
/// Width of the color bar, CSS pixels.
const LEGEND: f64 = 34.0;
/// Error at the end of the color scale, pixels.
const MOST_PX: f64 = 4.0;
const CORNER: Role = Role::Series(1);

/// Draws [`Calibrate`].
#[derive(Default)]
pub(crate) struct CalibrateView;

impl View for CalibrateView {
    type Model = Calibrate;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &Calibrate, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let (views, map) = match grid::is_narrow(width) {
            true => {
                let side = (width - 4.0 * BETWEEN) / 5.0 * aspect;
                let [views] = grid.shares([1.0], 2.0 * side + BETWEEN);
                let [map] = grid.row([aspect], 170.0);
                (views, map)
            }
            false => {
                let height = (0.36 * width).min(340.0);
                let map_width = height / aspect;
                let [views, map] = grid.shares([width - GAP - map_width, map_width], height);
                (views, map)
            }
        };
        grid.strip(LEGEND);
        let mut panels = vec![Panel::photograph("map", map, SIZE)];
        let columns = columns(width);
        let rows = VIEW_IDS.len().div_ceil(columns);
        let room = |all: f64, count: usize| (all - (count - 1) as f64 * BETWEEN) / count as f64;
        let side = room(views.width, columns).min(room(views.height, rows) / aspect);
        for (index, id) in VIEW_IDS.into_iter().enumerate() {
            let (column, row) = ((index % columns) as f64, (index / columns) as f64);
            let rect = Rect::new(
                views.x + column * (side + BETWEEN),
                views.y + row * (side * aspect + BETWEEN),
                side,
                side * aspect,
            );
            panels.push(Panel::photograph(id, rect, SIZE).clickable());
        }
        grid.layout(panels)
    }

    fn draw(&mut self, model: &Calibrate, layout: &Layout, canvas: &mut Canvas) {
        let map = layout.panel("map");
        grid::open(canvas, map, &["Error of the camera found", "Error"]);
        let first = layout.panel(VIEW_IDS[0]).rect;
        let row = Rect::new(first.x, first.y, 3.0 * first.width, first.height);
        grid::title(canvas, row, "Click to leave out or use");
        draw_legend(canvas, map.rect);
        let Some(answer) = model.asked.answer() else {
            return grid::notice(canvas, map.rect, model.asked.stand_in());
        };
        for (index, id) in VIEW_IDS.into_iter().enumerate() {
            draw_view(model, answer, index, layout.panel(id), canvas);
        }
        match &answer.found {
            Ok(found) => draw_map(model, answer, found, map, canvas),
            Err(sentence) => grid::notice(canvas, map.rect, &format!("No camera: {sentence}.")),
        }
    }
}

/// Draws a photograph with its corners, faint if it is not used.
fn draw_view(model: &Calibrate, answer: &Answer, index: usize, panel: &Panel, canvas: &mut Canvas) {
    let rect = panel.rect;
    canvas.photograph(rect, answer.photographs[index].image());
    if !model.is_used(index) {
        canvas.fill_rect(rect, Role::Background, 0.7);
        canvas.stroke_rect(rect, Stroke::solid(Role::Edge, 1.0).dashed());
        return canvas.marker(rect.center(), 7.0, Shape::Cross, Role::Muted, true);
    }
    for [u, v] in &answer.corners[index] {
        canvas.disk(panel.canvas_from_world((*u, *v)), 1.2, CORNER, 1.0);
    }
    canvas.stroke_rect(rect, Stroke::solid(Role::Ink, 1.5));
}

/// Draws the errors as colors, and the corners of the views used.
fn draw_map(model: &Calibrate, answer: &Answer, found: &Found, panel: &Panel, canvas: &mut Canvas) {
    let theme = canvas.theme();
    let (columns, rows) = CELLS;
    let colors = RgbImage::from_fn(columns, rows, |column, row| {
        let error = found.errors_px[(row * columns + column) as usize];
        image::Rgb(color(theme, f64::from(error) / MOST_PX))
    });
    canvas.photograph(panel.rect.inset(1.0), &colors);
    canvas.clipped(panel.rect, |canvas| {
        let used = answer
            .corners
            .iter()
            .enumerate()
            .filter(|(index, _)| model.is_used(*index));
        for [u, v] in used.flat_map(|(_, corners)| corners) {
            canvas.disk(panel.canvas_from_world((*u, *v)), 1.4, Role::Ink, 0.7);
        }
    });
}

/// Returns the color of an error, as a fraction of [`MOST_PX`].
fn color(theme: Theme, share: f64) -> crate::theme::Rgb {
    let full = theme.color(Role::Outlier);
    crate::theme::mix(
        theme.color(Role::Surface),
        full,
        share.clamp(0.0, 1.0) as f32,
    )
}

fn draw_legend(canvas: &mut Canvas, map: Rect) {
    let bar = Rect::new(map.x, map.bottom() + 6.0, map.width, 9.0);
    let most = format!("{} px and more", format_number(MOST_PX, 0));
    heat::bar(canvas, bar, ["0 px", &most], color);
}
