//! The pair, its true and computed disparity, the error, and a legend for the colors.

use super::model::DisparityMap;
use super::question::{Answer, BAD_PX};
use crate::canvas::{Canvas, Stroke, text_width};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::heat::{self, Fill, Heat};
use crate::kit::rectified::{self, SIZE};
use crate::theme::{Rgb, Role, Theme, mix};
use image::RgbImage;

/// Height over width of the photographs.
const ASPECT: f64 = grid::aspect(SIZE);
/// Height of the legend below all panels on a phone, CSS pixels: color bar and two rows of
/// swatches.
const LEGEND: f64 = 84.0;
/// Height of the smaller panels relative to the larger ones.
const SMALLER: f64 = 0.53;
const ROW: f64 = 18.5;
/// Id of each panel, with its long and its short title.
const NAMES: [(&str, &str, &str); 5] = [
    ("left", "Left photograph", "Left"),
    ("found", "Disparity found", "Found"),
    ("error", "How far it is off", "Off by"),
    ("right", "Right photograph", "Right"),
    ("truth", "True disparity", "Truth"),
];
/// Meaning of the colors in the error map.
const SWATCHES: [(Fill, &str); 5] = [
    (Fill::Role(Role::Surface, 1.0), "exact"),
    (Fill::Role(Role::Candidate, 1.0), "off by up to 2 px"),
    (Fill::Role(Role::Outlier, 1.0), "off by more: bad"),
    (Fill::Role(Role::Reference, 1.0), "hidden on the right"),
    (Fill::Stripes, "no answer"),
];

/// Draws [`DisparityMap`].
#[derive(Default)]
pub(crate) struct DisparityMapView {
    maps: Heat<3>,
}

impl View for DisparityMapView {
    type Model = DisparityMap;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &DisparityMap, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (left, found, error, right, truth);
        if grid::is_narrow(width) {
            [left, found] = grid.row([ASPECT; 2], f64::INFINITY);
            [error, right, truth] = grid.row([ASPECT; 3], f64::INFINITY);
            grid.strip(LEGEND);
        } else {
            [left, found, error] = grid.row([ASPECT; 3], f64::INFINITY);
            let [row] = grid.shares([1.0], SMALLER * left.height);
            let small = Rect {
                width: row.height / ASPECT,
                ..row
            };
            right = small;
            truth = Rect {
                x: small.right() + grid::GAP,
                ..small
            };
        }
        let rects = [left, found, error, right, truth];
        let panels = NAMES.into_iter().zip(rects).map(|((id, ..), rect)| {
            let mut panel = Panel::photograph(id, rect, SIZE);
            panel.clickable = id == "left";
            panel
        });
        grid.layout(panels.collect())
    }

    fn photograph(&mut self, model: &DisparityMap, panel: &str) -> Option<RgbImage> {
        let index = ["left", "right"].iter().position(|&name| name == panel)?;
        Some(model.asked.answer()?.pair.pictures[index].image().clone())
    }

    fn draw(&mut self, model: &DisparityMap, layout: &Layout, canvas: &mut Canvas) {
        for (id, name, short) in NAMES {
            grid::open(canvas, layout.panel(id), &[name, short]);
        }
        let asked = &model.asked;
        let found = layout.panel("found").rect;
        let Some(answer) = asked.answer() else {
            let words = asked.stand_in();
            grid::notice(canvas, layout.panel("left").rect, words);
            return draw_legend(canvas, layout, None);
        };
        let [left, right] = &answer.pair.pictures;
        canvas.photograph(layout.panel("left").rect, left.image());
        canvas.photograph(layout.panel("right").rect, right.image());
        let theme = canvas.theme();
        let maps = (self.maps).maps(asked.version(), theme, || colored(answer, theme));
        for (id, map) in ["truth", "found", "error"].into_iter().zip(maps) {
            canvas.photograph(layout.panel(id).rect, map);
        }
        draw_probe(model, answer, layout, canvas);
        draw_legend(canvas, layout, Some(answer));
        if let Some(problem) = asked.problem() {
            grid::notice(canvas, found, problem);
        }
    }
}

/// Returns the colored maps: true disparity, computed disparity, error.
fn colored(answer: &Answer, theme: Theme) -> [RgbImage; 3] {
    let full = answer.scale_px();
    let scale = |d: f32| theme.scale(f64::from(d / full));
    let map = |color: &dyn Fn(u32, u32) -> Rgb| {
        RgbImage::from_fn(SIZE.0, SIZE.1, |u, v| image::Rgb(color(u, v)))
    };
    let none = |u: u32, v: u32| heat::nothing(theme, u, v);
    [
        map(&|u, v| {
            answer
                .pair
                .truth
                .get(u, v)
                .map_or_else(|| none(u, v), scale)
        }),
        map(&|u, v| answer.found.get(u, v).map_or_else(|| none(u, v), scale)),
        map(&|u, v| match answer.error_px(u, v) {
            None => none(u, v),
            Some(_) if answer.pair.is_hidden(u, v) => theme.color(Role::Reference),
            Some(error_px) => error_color(theme, error_px),
        }),
    ]
}

/// Returns the color of an error: a ramp up to [`BAD_PX`], then the color of bad disparities.
fn error_color(theme: Theme, error_px: f32) -> Rgb {
    let share = error_px.abs() / BAD_PX;
    let [exact, off, bad] =
        [Role::Surface, Role::Candidate, Role::Outlier].map(|role| theme.color(role));
    if share > 1.0 {
        bad
    } else {
        mix(exact, off, share)
    }
}

/// Draws the probe, its match in the right photograph, and the matching window.
fn draw_probe(model: &DisparityMap, answer: &Answer, layout: &Layout, canvas: &mut Canvas) {
    let (u, v) = model.probe.place();
    let found = answer.found.get(u as u32, v as u32);
    for (id, ..) in NAMES {
        let panel = layout.panel(id);
        let shift = match id {
            "right" => found,
            _ => Some(0.0),
        };
        let Some(shift) = shift else { continue };
        let place = panel.canvas_from_world((u - f64::from(shift), v));
        let is_compared = ["left", "right"].contains(&id);
        let window = model.window_px().filter(|_| is_compared);
        canvas.clipped(panel.rect, |canvas| match window {
            Some(window_px) => {
                let half = 0.5 * f64::from(window_px) * panel.scale_x();
                rectified::draw_window(canvas, place, half.max(3.0));
            }
            None if id == "left" => canvas.grip(place, Role::Grip),
            None => canvas.circle(place, 5.0, Stroke::solid(Role::Grip, 2.0).cased()),
        });
    }
}

/// Draws the legend beside the small panels, or below all panels on a phone.
fn draw_legend(canvas: &mut Canvas, layout: &Layout, answer: Option<&Answer>) {
    let truth = layout.panel("truth").rect;
    let is_below = grid::is_narrow(layout.width);
    let (x, y) = match is_below {
        true => (0.0, truth.bottom() + 10.0),
        false => (truth.right() + 2.0 * grid::GAP, truth.y + 1.0),
    };
    let room = layout.width - x;
    let most = answer.map(|answer| format_number(answer.scale_px().into(), 0));
    let most = most.map_or("near".to_owned(), |px| format!("{px} px, near"));
    let bar = Rect::new(x, y, room.min(240.0), 11.0);
    heat::bar(canvas, bar, ["0 px, far", &most], Theme::scale);
    // Beside the bar where there is room, below it in columns of two on a phone.
    let (mut left, top, rows) = match is_below {
        true => (x, bar.bottom() + 2.0 * ROW, 2),
        false => (bar.right() + 40.0, y + 8.0, SWATCHES.len()),
    };
    let mut widest = 0.0_f64;
    for (index, (fill, words)) in SWATCHES.into_iter().enumerate() {
        let row = index % rows;
        if index > 0 && row == 0 {
            left += widest + 32.0;
            widest = 0.0;
        }
        heat::swatch(canvas, (left, top + row as f64 * ROW), fill, words);
        widest = widest.max(text_width(words, SMALL));
    }
}
