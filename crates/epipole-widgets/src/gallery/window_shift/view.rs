//! The picture with its window, the squared change as a map, and the same as a surface.

use super::measure::{CHANGE, Found, REACH, SHOWN, Verdict};
use super::model::WindowShift;
use crate::canvas::{Canvas, Place, Stroke, TextStyle, text_width};
use crate::contract::{Axis, Layout, Panel, Rect, View, format_number};
use crate::theme::{Rgb, Role, Theme};
use image::RgbImage;

const GAP: f64 = 12.0;
const TITLE: f64 = 24.0;
const LEGEND: f64 = 26.0;
const SMALL: f64 = 12.0;
/// Below this width the picture stands above the two others.
const STACKED_BELOW: f64 = 560.0;
/// Pixels of the map for a pixel of shift.
const FINE: usize = 16;
/// Root mean square change from one level line to the next, gray levels.
const LEVEL: f64 = 15.0;
/// Squared change at the top of the surface, gray levels squared.
const TOP: f64 = 11_000.0;

/// Draws [`WindowShift`].
#[derive(Default)]
pub struct WindowShiftView {
    map: Option<(u64, Theme, RgbImage)>,
}

impl View for WindowShiftView {
    type Model = WindowShift;

    fn layout(&self, _: &WindowShift, width: f64) -> Layout {
        let (left, top, width_px, height_px) = SHOWN;
        let shape = f64::from(width_px) / f64::from(height_px);
        let stacked = width < STACKED_BELOW;
        let (picture, side) = if stacked {
            let rect = Rect::new(0.0, TITLE, width, width / shape);
            (rect, ((width - GAP) / 2.0).max(1.0))
        } else {
            let side = (width - 2.0 * GAP) / (shape + 2.0);
            (Rect::new(0.0, TITLE, side * shape, side), side)
        };
        let (x, y) = if stacked {
            (0.0, picture.bottom() + LEGEND + TITLE)
        } else {
            (picture.right() + GAP, TITLE)
        };
        let axis = |from: u32, size: u32| Axis {
            start: f64::from(from) - 0.5,
            end: f64::from(from + size) - 0.5,
        };
        let reach = REACH as f64 + 0.5;
        let around = Axis {
            start: -reach,
            end: reach,
        };
        let panel = |id, rect, clickable| Panel {
            id,
            rect,
            x_axis: around,
            y_axis: around,
            clickable,
        };
        let map = panel("map", Rect::new(x, y, side, side), true);
        let rect = Rect::new(map.rect.right() + GAP, y, side, side);
        let surface = panel("surface", rect, false);
        Layout {
            width,
            height: map.rect.bottom() + LEGEND,
            panels: vec![
                Panel {
                    id: "picture",
                    rect: picture,
                    x_axis: axis(left, width_px),
                    y_axis: axis(top, height_px),
                    clickable: true,
                },
                map,
                surface,
            ],
        }
    }

    fn draw(&mut self, model: &WindowShift, layout: &Layout, canvas: &mut Canvas) {
        let panels = ["picture", "map", "surface"].map(|id| layout.panel(id));
        let titles = ["Picture", "Change by shift", "The same as a surface"];
        for (panel, text) in panels.into_iter().zip(titles) {
            let place = (panel.rect.x, panel.rect.y - 8.0);
            canvas.text(place, text, TextStyle::new(Role::Ink, 13.0));
            canvas.panel(panel.rect);
        }
        let [picture, map, surface] = panels;
        let found = match model.found() {
            Ok(found) => found,
            Err(problem) => {
                let style = TextStyle::new(Role::Muted, 13.0);
                canvas.paragraph(picture.rect.inset(8.0), &problem, style);
                return;
            }
        };
        canvas.photograph(picture.rect, model.picture());
        canvas.clipped(picture.rect, |canvas| windows(canvas, picture, model));
        canvas.photograph(map.rect, self.map(model.version(), found, canvas.theme()));
        canvas.clipped(map.rect, |canvas| ellipse(canvas, map, model, found));
        canvas.clipped(surface.rect, |canvas| {
            mesh(canvas, surface.rect, model, found)
        });
        legend(canvas, picture.rect, map.rect, model.verdict(found), found);
    }
}

impl WindowShiftView {
    fn map(&mut self, version: u64, found: &Found, theme: Theme) -> &RgbImage {
        let key = (version, theme);
        let fresh = self.map.take().filter(|(v, t, _)| (*v, *t) == key);
        let (_, _, map) = self
            .map
            .insert(fresh.unwrap_or_else(|| (key.0, key.1, colored(found, theme))));
        map
    }
}

/// The window where it is, and where the shift takes it.
fn windows(canvas: &mut Canvas, panel: &Panel, model: &WindowShift) {
    let side = model.window_px() as f64 * panel.scale_x();
    let place = model.window();
    let shifted = (place.0 + model.shift().0, place.1 + model.shift().1);
    let [still, moved] = [place, shifted].map(|place| panel.canvas_from_world(place));
    let square = |(x, y): Place| Rect::new(x - side / 2.0, y - side / 2.0, side, side);
    let stroke = Stroke::solid(Role::Candidate, 2.0).cased();
    canvas.polygon_outline(&outline(square(moved)), stroke.dashed());
    canvas.stroke_rect(square(still), Stroke::solid(Role::Grip, 2.0).cased());
    canvas.grip(still, Role::Grip);
}

fn outline(rect: Rect) -> [Place; 4] {
    let (left, top, right, bottom) = (rect.x, rect.y, rect.right(), rect.bottom());
    [(left, top), (right, top), (right, bottom), (left, bottom)]
}

/// Where Taylor expects the change of the legend, its half axes, and the shift to try.
fn ellipse(canvas: &mut Canvas, panel: &Panel, model: &WindowShift, found: &Found) {
    let (short, long, angle) = found.ellipse();
    let across = (libm::cos(angle), libm::sin(angle));
    let place = |a: f64, b: f64| {
        panel.canvas_from_world((a * across.0 - b * across.1, a * across.1 + b * across.0))
    };
    const CORNERS: usize = 120;
    let round: Vec<Place> = (0..CORNERS)
        .map(|corner| {
            let turn = std::f64::consts::TAU * corner as f64 / CORNERS as f64;
            place(short * libm::cos(turn), long * libm::sin(turn))
        })
        .collect();
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
    let shift = panel.canvas_from_world(model.shift());
    let stroke = Stroke::solid(Role::Grip, 2.0).cased();
    canvas.line(middle, shift, stroke);
    canvas.grip(shift, Role::Grip);
}

/// The squared change as a net over the shifts, seen from above and in front.
fn mesh(canvas: &mut Canvas, rect: Rect, model: &WindowShift, found: &Found) {
    let reach = REACH as i32;
    let (half_width, half_depth) = (rect.width * 0.47, rect.height * 0.2);
    let ground = rect.bottom() - half_depth - 10.0;
    let height = ground - half_depth - rect.y - 4.0;
    let project = |du: f64, dv: f64, change: f64| -> Place {
        let (x, y) = (du / f64::from(reach), dv / f64::from(reach));
        (
            rect.center().0 + 0.5 * (x - y) * half_width,
            ground + 0.5 * (x + y) * half_depth - (change / TOP).min(1.05) * height,
        )
    };
    let corner = |du: i32, dv: i32| project(f64::from(du), f64::from(dv), found.change(du, dv));
    let [surface, change] = [Role::Surface, Role::Candidate].map(|role| canvas.theme().color(role));
    // Far cells first, so that near ones cover them.
    for diagonal in -2 * reach..2 * reach {
        for du in (-reach).max(diagonal - reach + 1)..reach.min(diagonal + reach + 1) {
            let dv = diagonal - du;
            let cell = [(0, 0), (1, 0), (1, 1), (0, 1)];
            let places = cell.map(|(x, y)| corner(du + x, dv + y));
            let changes = cell.map(|(x, y)| found.change(du + x, dv + y));
            let mean = changes.iter().sum::<f64>() / 4.0;
            let share = (mean.sqrt() / 150.0).min(1.0);
            canvas.polygon_color(&places, mix(surface, change, 0.1 + 0.6 * share));
            // The sides towards the viewer are drawn with the cells that lie there.
            let [back, right, front, left] = places;
            let mut sides = vec![left, back, right];
            if du == reach - 1 {
                sides.push(front);
            }
            if dv == reach - 1 {
                sides.insert(0, front);
            }
            canvas.polyline(&sides, Stroke::solid(Role::Ink, 0.5));
        }
    }
    let style = TextStyle::new(Role::Ink, SMALL);
    let edge = f64::from(reach);
    let (right, down) = (project(edge, 0.0, 0.0), project(0.0, edge, 0.0));
    canvas.label((right.0 + 6.0, rect.bottom() - 10.0), "right", style);
    canvas.label((down.0 - 6.0, rect.bottom() - 10.0), "down", style.end());
    let (du, dv) = model.shift();
    let change = found.change(du as i32, dv as i32);
    let place = project(du, dv, change);
    canvas.line(
        project(du, dv, 0.0),
        place,
        Stroke::solid(Role::Grip, 2.0).cased(),
    );
    canvas.disk(place, 4.5, Role::Halo, 1.0);
    canvas.disk(place, 3.5, Role::Grip, 1.0);
}

/// Level lines of the root mean square change; pale where it is less than [`CHANGE`].
fn colored(found: &Found, theme: Theme) -> RgbImage {
    let [pale, strong, line] =
        [Role::Surface, Role::Candidate, Role::Ink].map(|role| theme.color(role));
    let reach = REACH as i32;
    let side = (2 * REACH + 1) * FINE;
    let limit = f64::from(reach);
    // The whole shift before each pixel of the map, and how far the pixel is beyond it.
    let places: Vec<(i32, f64)> = (0..side)
        .map(|pixel| {
            let at = (pixel as f64 + 0.5) / FINE as f64 - 0.5 - limit;
            let at = at.clamp(-limit, limit - 1e-9);
            (at.floor() as i32, at - at.floor())
        })
        .collect();
    let level = |u: usize, v: usize| {
        let ((left, right), (above, below)) = (places[u], places[v]);
        let corner = |x: i32, y: i32| found.change(left + x, above + y);
        let upper = corner(0, 0) * (1.0 - right) + corner(1, 0) * right;
        let lower = corner(0, 1) * (1.0 - right) + corner(1, 1) * right;
        ((upper * (1.0 - below) + lower * below).sqrt() / LEVEL) as usize
    };
    let levels: Vec<usize> = (0..side * side)
        .map(|index| level(index % side, index / side))
        .collect();
    let most = levels.iter().copied().max().unwrap_or(0);
    let colors: Vec<[Rgb; 2]> = (0..=most)
        .map(|level| {
            let change = level as f64 * LEVEL;
            let share = if change < CHANGE {
                0.0
            } else {
                0.3 + 0.6 * (change / 150.0).min(1.0)
            };
            let color = mix(pale, strong, share);
            [color, mix(color, line, 0.45)]
        })
        .collect();
    let at = |u: usize, v: usize| levels[v * side + u];
    RgbImage::from_fn(side as u32, side as u32, |u, v| {
        let (u, v) = (u as usize, v as usize);
        let here = at(u, v);
        let next = at((u + 1).min(side - 1), v).max(at(u, (v + 1).min(side - 1)));
        let before = at(u.saturating_sub(1), v).max(at(u, v.saturating_sub(1)));
        image::Rgb(colors[here][usize::from(here != next || here < before)])
    })
}

fn mix(from: Rgb, to: Rgb, share: f64) -> Rgb {
    std::array::from_fn(|channel| {
        let (a, b) = (f64::from(from[channel]), f64::from(to[channel]));
        (a + (b - a) * share).round() as u8
    })
}

fn legend(canvas: &mut Canvas, picture: Rect, map: Rect, verdict: Verdict, found: &Found) {
    let style = TextStyle::new(Role::Ink, SMALL);
    let verdict = match verdict {
        Verdict::Flat => "Flat",
        Verdict::Edge => "Edge",
        Verdict::Corner => "Corner",
    };
    let (large, small) = found.eigenvalues();
    let words = format!(
        "{verdict}: λ₁ = {}, λ₂ = {} per pixel",
        format_number(large, 0),
        format_number(small, 0)
    );
    canvas.label((picture.x, picture.bottom() + 14.0), &words, style);
    let y = map.bottom() + 14.0;
    let dashed = "Taylor's ellipse";
    canvas.line(
        (map.x, y),
        (map.x + 22.0, y),
        Stroke::solid(Role::Truth, 2.0).dashed(),
    );
    canvas.label((map.x + 27.0, y), dashed, style);
    let x = map.x + 27.0 + text_width(dashed, SMALL) + 14.0;
    let swatch = Rect::new(x, y - 7.0, 14.0, 14.0);
    canvas.fill_rect(swatch, Role::Candidate, 0.6);
    canvas.stroke_rect(swatch, Stroke::solid(Role::Edge, 1.0));
    let words = format!("changes by {} or more", format_number(CHANGE, 0));
    canvas.label((x + 19.0, y), &words, style);
}
