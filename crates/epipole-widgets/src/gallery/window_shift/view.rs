//! The picture with its window, and the squared change as a map and as a surface.

use super::measure::{CHANGE, Found, REACH, SHOWN};
use super::model::WindowShift;
use crate::canvas::{Canvas, Place, Stroke, TextStyle, text_width};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::heat::{self, Fill, Heat};
use crate::kit::terrain::Terrain;
use crate::theme::{Role, Theme, mix};
use image::RgbImage;

const LEGEND: f64 = 26.0;
/// Difference of root mean square changes between neighboring level lines, gray levels.
const LEVEL: f64 = 15.0;
/// Root mean square change drawn at full saturation, gray levels.
const STRONG: f64 = 150.0;
/// Squared change at the top of the surface.
const TOP: f64 = 11_000.0;
/// Height of the surface on a phone, CSS pixels.
const LOW: f64 = 138.0;

/// Draws [`WindowShift`].
#[derive(Default)]
pub struct WindowShiftView {
    map: Heat,
}

impl View for WindowShiftView {
    type Model = WindowShift;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &WindowShift, width: f64) -> Layout {
        let (left, top, width_px, height_px) = SHOWN;
        let aspect = f64::from(height_px) / f64::from(width_px);
        let mut grid = Grid::new(width);
        let (picture, map, surface);
        if grid::is_narrow(width) {
            [picture, map] = grid.row([aspect, 1.0], f64::INFINITY);
            grid.strip(LEGEND);
            [surface] = grid.shares([1.0], LOW);
        } else {
            [picture, map, surface] = grid.row([aspect, 1.0, 1.0], f64::INFINITY);
            grid.strip(LEGEND);
        }
        let axis = |from: u32, size: u32| [from, from + size].map(|edge| f64::from(edge) - 0.5);
        let reach = REACH as f64 + 0.5;
        let around = [-reach, reach];
        let (columns, rows) = (axis(left, width_px), axis(top, height_px));
        grid.layout(vec![
            Panel::new("picture", picture, columns, rows).clickable(),
            Panel::new("map", map, around, around).clickable(),
            Panel::new("surface", surface, around, around),
        ])
    }

    fn draw(&mut self, model: &WindowShift, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 3] = [
            ("picture", &["Image"]),
            ("map", &["Change by shift"]),
            ("surface", &["The same as a surface"]),
        ];
        let [picture, map, surface] = grid::open_all(canvas, layout, titles);
        let found = match model.found() {
            Ok(found) => found,
            Err(problem) => return grid::notice(canvas, picture.rect, &problem),
        };
        canvas.photograph(picture.rect, &model.picture);
        canvas.clipped(picture.rect, |canvas| windows(canvas, picture, model));
        let theme = canvas.theme();
        let height = |shift| found.change(shift);
        let terrain = Terrain {
            reach: REACH,
            height: &height,
        };
        let [colors] = (self.map).maps(model.version, theme, || [colored(&terrain, theme)]);
        canvas.photograph(map.rect, colors);
        canvas.clipped(map.rect, |canvas| ellipse(canvas, map, model, found));
        draw_surface(canvas, surface.rect, &terrain, model);
        draw_legend(canvas, layout, model, found);
    }
}

/// Draws the window at its position and at the shifted one.
fn windows(canvas: &mut Canvas, panel: &Panel, model: &WindowShift) {
    let side = model.window_px() as f64 * panel.scale_x();
    let ((u, v), (du, dv)) = (model.window.place(), model.shift.place());
    let [still, moved] = [(u, v), (u + du, v + dv)].map(|place| panel.canvas_from_world(place));
    let [still_square, moved] = [still, moved].map(|place| Rect::around(place, side / 2.0));
    let stroke = Stroke::solid(Role::Candidate, 2.0).cased();
    canvas.polygon_outline(&moved.corners(), stroke.dashed());
    canvas.stroke_rect(still_square, Stroke::solid(Role::Grip, 2.0).cased());
    canvas.grip(still, Role::Grip);
}

/// Draws the ellipse of Taylor's estimate, its semi-axes, and the tested shift.
fn ellipse(canvas: &mut Canvas, panel: &Panel, model: &WindowShift, found: &Found) {
    let (short, long, angle) = found.ellipse();
    let across = (libm::cos(angle), libm::sin(angle));
    let place = |a: f64, b: f64| {
        panel.canvas_from_world((a * across.0 - b * across.1, a * across.1 + b * across.0))
    };
    const CORNERS: usize = 120;
    let corner = |index: usize| {
        let turn = std::f64::consts::TAU * index as f64 / CORNERS as f64;
        place(short * libm::cos(turn), long * libm::sin(turn))
    };
    let round: Vec<Place> = (0..CORNERS).map(corner).collect();
    let middle = place(0.0, 0.0);
    let reach = REACH as f64;
    let style = TextStyle::new(Role::Ink, SMALL).middle().cased();
    if short > reach * 1.5 {
        let at = (panel.rect.center().0, panel.rect.bottom() - 14.0);
        canvas.label(at, "the ellipse is larger than this", style);
    } else {
        let axis = Stroke::solid(Role::Truth, 1.5).cased();
        canvas.line(middle, place(short, 0.0), axis);
        canvas.line(middle, place(0.0, -long), axis);
        let stroke = Stroke::solid(Role::Truth, 2.0).cased().dashed();
        canvas.polygon_outline(&round, stroke);
        let beyond = |half_axis: f64| (half_axis + 1.4).min(reach - 0.5);
        canvas.label(place(beyond(short), 0.0), "λ₁", style);
        canvas.label(place(0.0, -beyond(long)), "λ₂", style);
    }
    let shift = panel.canvas_from_world(model.shift.place());
    let stroke = Stroke::solid(Role::Grip, 2.0).cased();
    canvas.line(middle, shift, stroke);
    canvas.grip(shift, Role::Grip);
}

/// Colors the map with level lines of the root mean square change, pale below [`CHANGE`].
fn colored(terrain: &Terrain, theme: Theme) -> RgbImage {
    let [pale, strong, line] =
        [Role::Surface, Role::Candidate, Role::Ink].map(|role| theme.color(role));
    let colors = |level: usize| {
        let change = level as f64 * LEVEL;
        let share = match change < CHANGE {
            true => 0.0,
            false => 0.3 + 0.6 * (change / STRONG).min(1.0),
        };
        let color = mix(pale, strong, share as f32);
        [color, mix(color, line, 0.45)]
    };
    terrain.map(|change| (change.sqrt() / LEVEL) as usize, colors)
}

fn draw_surface(canvas: &mut Canvas, rect: Rect, terrain: &Terrain, model: &WindowShift) {
    let [pale, strong] = [Role::Surface, Role::Candidate].map(|role| canvas.theme().color(role));
    let color = |change: f64| {
        let share = (change.sqrt() / STRONG).min(1.0);
        mix(pale, strong, 0.1 + 0.6 * share as f32)
    };
    let place = model.shift.place();
    canvas.clipped(rect, |canvas| {
        terrain.draw_net(canvas, rect, TOP, place, color);
    });
}

/// Draws the window's class and the legend of the map.
fn draw_legend(canvas: &mut Canvas, layout: &Layout, model: &WindowShift, found: &Found) {
    let [picture, map] = ["picture", "map"].map(|id| layout.panel(id).rect);
    let y = picture.bottom().max(map.bottom()) + LEGEND / 2.0 + 2.0;
    let style = TextStyle::new(Role::Ink, SMALL);
    let mut x = 0.0;
    if !grid::is_narrow(layout.width) {
        let (large, small) = found.eigenvalues();
        let [large, small, threshold] =
            [large, small, model.threshold()].map(|value| format_number(value, 0));
        let verdict = model.verdict(found).word();
        let words = format!("{verdict}: λ₁ = {large}, λ₂ = {small}, large above {threshold}");
        canvas.label((picture.x, y), &words, style);
        x = map.x;
    }
    let ellipse = "Taylor's ellipse";
    let stroke = Stroke::solid(Role::Truth, 2.0).dashed();
    canvas.line((x, y), (x + 22.0, y), stroke);
    canvas.label((x + 27.0, y), ellipse, style);
    let x = x + 27.0 + text_width(ellipse, SMALL) + 14.0;
    let words = format!("changes by {} or more", format_number(CHANGE, 0));
    heat::swatch(canvas, (x, y), Fill::Role(Role::Candidate, 0.6), &words);
}
