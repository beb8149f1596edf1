//! The pair, the truth, what is found and how far it is off; a legend for the colors.

use super::answer::{Answer, BAD_PX, SIZE};
use super::model::DisparityMap;
use crate::canvas::{Canvas, Stroke, TextStyle};
use crate::contract::{Layout, Panel, Rect, View, format_number};
use crate::theme::{Rgb, Role, Theme, mix};
use image::RgbImage;

const GAP: f64 = 10.0;
const TITLE: f64 = 22.0;
const TEXT: f64 = 13.0;
/// Below this width there are two pictures in a row, not three.
const TWO_COLUMNS_BELOW: f64 = 520.0;
/// Period of the stripes where there is no answer, pixels of the photograph.
const STRIPE_PX: u32 = 6;
const NAMES: [(&str, &str); 5] = [
    ("left", "Left photograph"),
    ("right", "Right photograph"),
    ("truth", "True disparity"),
    ("found", "Disparity found"),
    ("error", "How far it is off"),
];

/// Draws [`DisparityMap`].
#[derive(Default)]
pub(crate) struct DisparityMapView {
    maps: Option<(u64, Theme, [RgbImage; 3])>,
}

impl View for DisparityMapView {
    type Model = DisparityMap;

    fn layout(&self, _: &DisparityMap, width: f64) -> Layout {
        let columns = if width < TWO_COLUMNS_BELOW { 2 } else { 3 };
        let (cell_width, cell_height) = cell(width, columns);
        let panel = |(index, (id, _)): (usize, &(&'static str, &str))| {
            let (row, column) = (index / columns, index % columns);
            let x = column as f64 * (cell_width + GAP);
            let y = TITLE + row as f64 * (cell_height + TITLE + 6.0);
            let rect = Rect::new(x, y, cell_width, cell_height);
            let mut panel = Panel::photograph(id, rect, SIZE.0, SIZE.1);
            panel.clickable = *id == "left";
            panel
        };
        let panels: Vec<Panel> = NAMES.iter().enumerate().map(panel).collect();
        let height = panels
            .iter()
            .map(|panel| panel.rect.bottom())
            .fold(0.0, f64::max)
            + 2.0;
        Layout {
            width,
            height,
            panels,
        }
    }

    fn draw(&mut self, model: &DisparityMap, layout: &Layout, canvas: &mut Canvas) {
        for (id, name) in NAMES {
            let rect = layout.panel(id).rect;
            let style = TextStyle::new(Role::Ink, TEXT);
            canvas.text((rect.x, rect.y - 7.0), name, style);
            canvas.panel(rect);
        }
        let Some(answer) = model.answer() else {
            let words = model.problem().unwrap_or("computing …");
            let rect = layout.panel("left").rect.inset(10.0);
            canvas.paragraph(rect, words, TextStyle::new(Role::Ink, TEXT));
            return;
        };
        let [left, right] = &answer.pictures;
        canvas.photograph(layout.panel("left").rect, left);
        canvas.photograph(layout.panel("right").rect, right);
        let maps = self.maps(model.version(), canvas.theme(), answer);
        for (id, map) in ["truth", "found", "error"].into_iter().zip(maps) {
            canvas.photograph(layout.panel(id).rect, map);
        }
        draw_probe(model, answer, layout, canvas);
        let error = layout.panel("error").rect;
        let below = layout.width < TWO_COLUMNS_BELOW;
        let legend_rect = Rect::new(error.right() + GAP, error.y, error.width, error.height);
        legend(canvas, legend_rect, answer, below);
        if model.is_waiting() || model.problem().is_some() {
            let words = model.problem().unwrap_or("computing …");
            let rect = layout.panel("found").rect.inset(8.0);
            canvas.paragraph(rect, words, TextStyle::new(Role::Ink, TEXT).cased());
        }
    }
}

/// Width and height of one picture.
fn cell(width: f64, columns: usize) -> (f64, f64) {
    let width = ((width - GAP * (columns - 1) as f64) / columns as f64).max(1.0);
    (width, width * f64::from(SIZE.1) / f64::from(SIZE.0))
}

impl DisparityMapView {
    fn maps(&mut self, version: u64, theme: Theme, answer: &Answer) -> &[RgbImage; 3] {
        let fresh = (self.maps.take()).filter(|(v, t, _)| (*v, *t) == (version, theme));
        let make = || (version, theme, colored(answer, theme));
        &self.maps.insert(fresh.unwrap_or_else(make)).2
    }
}

/// True disparity, disparity found, error.
fn colored(answer: &Answer, theme: Theme) -> [RgbImage; 3] {
    let full = answer.scale_px();
    let scale = |d: f32| theme.scale(f64::from(d / full));
    let map = |color: &dyn Fn(u32, u32) -> Rgb| {
        RgbImage::from_fn(SIZE.0, SIZE.1, |u, v| image::Rgb(color(u, v)))
    };
    let none = |u: u32, v: u32| stripes(theme, u, v);
    [
        map(&|u, v| answer.truth.get(u, v).map_or_else(|| none(u, v), scale)),
        map(&|u, v| answer.found.get(u, v).map_or_else(|| none(u, v), scale)),
        map(&|u, v| match answer.error_px(u, v) {
            None => none(u, v),
            Some(_) if answer.is_hidden(u, v) => theme.color(Role::Reference),
            Some(error_px) => error_color(theme, error_px),
        }),
    ]
}

/// From nothing at no error to full at a bad one; bad answers stand out at once.
fn error_color(theme: Theme, error_px: f32) -> Rgb {
    let share = error_px.abs() / BAD_PX;
    match share > 1.0 {
        true => theme.color(Role::Outlier),
        false => mix(
            theme.color(Role::Surface),
            theme.color(Role::Candidate),
            share,
        ),
    }
}

/// What stands for "no answer".
fn stripes(theme: Theme, u: u32, v: u32) -> Rgb {
    let role = match (u + v) % STRIPE_PX < STRIPE_PX / 2 {
        true => Role::Surface,
        false => Role::Edge,
    };
    theme.color(role)
}

/// The probe, its match in the right photograph, and the window that is compared.
fn draw_probe(model: &DisparityMap, answer: &Answer, layout: &Layout, canvas: &mut Canvas) {
    let (u, v) = model.probe();
    let found = answer.found.get(u as u32, v as u32);
    for (id, _) in NAMES {
        let panel = layout.panel(id);
        let shift = match id {
            "right" => found,
            _ => Some(0.0),
        };
        let Some(shift) = shift else { continue };
        let place = panel.canvas_from_world((u - f64::from(shift), v));
        canvas.clipped(panel.rect, |canvas| {
            if let (Some(window_px), "left" | "right") = (model.window_px(), id) {
                let half = 0.5 * f64::from(window_px) * panel.scale_x();
                let window = Rect::new(place.0 - half, place.1 - half, 2.0 * half, 2.0 * half);
                canvas.stroke_rect(window, Stroke::solid(Role::Grip, 1.5).cased());
            }
            match id {
                "left" => canvas.grip(place, Role::Grip),
                _ => canvas.circle(place, 5.0, Stroke::solid(Role::Grip, 2.0).cased()),
            }
        });
    }
}

/// What the colors mean, in the empty cell of the grid.
fn legend(canvas: &mut Canvas, rect: Rect, answer: &Answer, is_small: bool) {
    let style = TextStyle::new(Role::Ink, 12.0);
    let line = if is_small { 17.0 } else { 22.0 };
    let bar = Rect::new(rect.x, rect.y + 2.0, rect.width.min(200.0), 12.0);
    let num_steps = 40;
    for step in 0..num_steps {
        let (from, to) = (f64::from(step), f64::from(step + 1));
        let x = |at: f64| bar.x + bar.width * at / f64::from(num_steps);
        let color = canvas.theme().scale((from + 0.5) / f64::from(num_steps));
        canvas.fill_color(
            Rect::new(x(from), bar.y, x(to) - x(from), bar.height),
            color,
        );
    }
    canvas.stroke_rect(bar, Stroke::solid(Role::Edge, 1.0));
    let y = bar.bottom() + 0.6 * line;
    canvas.label((bar.x, y), "0 px, far", style);
    let most = format!("{} px, near", format_number(answer.scale_px().into(), 0));
    canvas.label((bar.right(), y), &most, style.end());
    let theme = canvas.theme();
    let rows = [
        (Role::Surface, "exact"),
        (Role::Candidate, "off by up to 2 px"),
        (Role::Outlier, "off by more: bad"),
        (Role::Reference, "hidden on the right"),
    ];
    let mut y = y + line;
    let swatch = |y: f64| Rect::new(rect.x, y - 7.0, 14.0, 14.0);
    for (role, words) in rows {
        canvas.fill_color(swatch(y), theme.color(role));
        canvas.stroke_rect(swatch(y), Stroke::solid(Role::Edge, 1.0));
        canvas.label((rect.x + 20.0, y), words, style);
        y += line;
    }
    let stripe = |index: f64| Rect::new(rect.x + 4.0 * index, y - 7.0, 2.0, 14.0);
    canvas.fill_color(swatch(y), theme.color(Role::Surface));
    for index in 0..4 {
        canvas.fill_color(stripe(f64::from(index)), theme.color(Role::Edge));
    }
    canvas.stroke_rect(swatch(y), Stroke::solid(Role::Edge, 1.0));
    canvas.label((rect.x + 20.0, y), "no answer", style);
}
