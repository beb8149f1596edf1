//! The picture with its window, the squared change as a map, and the same as a surface.

mod surface;

use super::measure::{CHANGE, Found, REACH, SHOWN};
use super::model::WindowShift;
use crate::canvas::{Canvas, Place, Stroke, TextStyle, text_width};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::heat::{self, Fill, Heat};
use crate::theme::{Rgb, Role, Theme, mix};
use image::RgbImage;

const LEGEND: f64 = 26.0;
/// Pixels of the map for a pixel of shift.
const FINE: usize = 16;
/// Root mean square change from one level line to the next, gray levels.
const LEVEL: f64 = 15.0;
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
        let [colors] = (self.map).maps(model.version, theme, || [colored(found, theme)]);
        canvas.photograph(map.rect, colors);
        canvas.clipped(map.rect, |canvas| ellipse(canvas, map, model, found));
        canvas.clipped(surface.rect, |canvas| {
            surface::draw(canvas, surface.rect, model.shift, found);
        });
        draw_legend(canvas, layout, model, found);
    }
}

/// The window where it is, and where the shift takes it.
fn windows(canvas: &mut Canvas, panel: &Panel, model: &WindowShift) {
    let side = model.window_px() as f64 * panel.scale_x();
    let place = model.window;
    let shifted = (place.0 + model.shift.0, place.1 + model.shift.1);
    let [still, moved] = [place, shifted].map(|place| panel.canvas_from_world(place));
    let [still_square, moved] = [still, moved].map(|place| Rect::around(place, side / 2.0));
    let stroke = Stroke::solid(Role::Candidate, 2.0).cased();
    canvas.polygon_outline(&moved.corners(), stroke.dashed());
    canvas.stroke_rect(still_square, Stroke::solid(Role::Grip, 2.0).cased());
    canvas.grip(still, Role::Grip);
}

/// Where Taylor expects the change of the legend, its half axes, and the shift to try.
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
    let shift = panel.canvas_from_world(model.shift);
    let stroke = Stroke::solid(Role::Grip, 2.0).cased();
    canvas.line(middle, shift, stroke);
    canvas.grip(shift, Role::Grip);
}

/// Level lines of the root mean square change; pale where it is less than [`CHANGE`].
fn colored(found: &Found, theme: Theme) -> RgbImage {
    let [pale, strong, line] =
        [Role::Surface, Role::Candidate, Role::Ink].map(|role| theme.color(role));
    let reach = REACH as i32;
    let side = (2 * REACH + 1) * FINE;
    let limit = f64::from(reach);
    // The number of the whole shift before each pixel of the map, and how far the pixel is beyond it.
    let places: Vec<(usize, f64)> = (0..side)
        .map(|pixel| {
            let at = (pixel as f64 + 0.5) / FINE as f64 - 0.5 - limit;
            let at = at.clamp(-limit, limit - 1e-9);
            ((at.floor() + limit) as usize, at - at.floor())
        })
        .collect();
    let shifts = || -reach..=reach;
    let changes: Vec<Vec<f64>> = shifts()
        .map(|dv| shifts().map(|du| found.change(du, dv)).collect())
        .collect();
    // Across the columns once for each row of shifts, then down the rows.
    let across: Vec<Vec<f64>> = changes
        .iter()
        .map(|row| {
            let between =
                |&(left, right): &(usize, f64)| row[left] * (1.0 - right) + row[left + 1] * right;
            places.iter().map(between).collect()
        })
        .collect();
    let mut levels = Vec::with_capacity(side * side);
    for &(above, below) in &places {
        let rows = across[above].iter().zip(&across[above + 1]);
        levels.extend(rows.map(|(upper, lower)| {
            ((upper * (1.0 - below) + lower * below).sqrt() / LEVEL) as usize
        }));
    }
    let most = levels.iter().copied().max().unwrap_or(0);
    let colors: Vec<[Rgb; 2]> = (0..=most)
        .map(|level| {
            let change = level as f64 * LEVEL;
            let share = match change < CHANGE {
                true => 0.0,
                false => 0.3 + 0.6 * (change / 150.0).min(1.0),
            };
            let color = mix(pale, strong, share as f32);
            [color, mix(color, line, 0.45)]
        })
        .collect();
    let rows: Vec<&[usize]> = levels.chunks_exact(side).collect();
    let mut map = RgbImage::new(side as u32, side as u32);
    let pixels = map.as_chunks_mut::<3>().0;
    for (v, pixels) in pixels.chunks_exact_mut(side).enumerate() {
        let (row, below) = (rows[v], rows[(v + 1).min(side - 1)]);
        let above = rows[v.saturating_sub(1)];
        for (u, pixel) in pixels.iter_mut().enumerate() {
            let here = row[u];
            let next = row[(u + 1).min(side - 1)].max(below[u]);
            let before = row[u.saturating_sub(1)].max(above[u]);
            *pixel = colors[here][usize::from(here != next || here < before)];
        }
    }
    map
}

/// What the window is on, and what the marks of the map mean.
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
