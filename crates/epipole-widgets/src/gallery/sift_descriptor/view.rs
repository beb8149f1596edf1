//! The photograph; the window before and after, each beside its histogram; and three ratios.

use super::comparison::{Look, SHOWN_PX};
use super::model::SiftDescriptor;
use super::prints::{SIGMA_PX, WAYS};
use super::question::Question;
use crate::canvas::{Canvas, Stroke, TextStyle, text_width};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::changed::MIDDLE;
use crate::kit::features::SIZE;
use crate::kit::grid::{self, Grid, SMALL, TEXT};
use crate::kit::heat::Heat;
use crate::kit::patch::{self, Spot};
use crate::kit::question::Question as _;
use crate::theme::Role;

/// Ratio at the end of the bars, and maximum ratio of an accepted match.
const MOST: f64 = 1.25;
const BELIEVED: f64 = 0.8;
/// Histogram entry drawn at full length. Entries of a descriptor of norm 512 are clamped at 0.2 ·
/// 512.
const LONGEST: f64 = 0.25 * 512.0;
const TITLES: [[&[&str]; 2]; 2] = [
    [&["Before"], &["Its descriptor", "Descriptor"]],
    [&["After"], &["Its descriptor", "Descriptor"]],
];

/// Draws [`SiftDescriptor`].
#[derive(Default)]
pub(crate) struct SiftDescriptorView {
    pieces: Heat<2>,
}

impl View for SiftDescriptorView {
    type Model = SiftDescriptor;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &SiftDescriptor, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let (photograph, ratios, squares);
        if grid::is_broad(width) {
            let [left, middle, right] = grid.row([aspect, 1.12, 2.1], 390.0);
            let rows = grid::stack(middle, [1.0; 2]).map(|row| grid::columns(row, [1.0; 2]));
            (photograph, ratios) = (left, right);
            squares = [rows[0][0], rows[0][1], rows[1][0], rows[1][1]];
        } else {
            let [left, right] = grid.row([aspect; 2], 300.0);
            (photograph, ratios) = (left, right);
            squares = grid.row([1.0; 4], 200.0);
        }
        let photograph = Panel::photograph("photograph", photograph, SIZE).clickable();
        let mut panels = vec![photograph];
        let around = f64::from(SHOWN_PX) + 0.5;
        for (id, rect) in ["before", "before-sift", "after", "after-sift"]
            .into_iter()
            .zip(squares)
        {
            let side = rect.width.min(rect.height);
            let square = Rect::new(rect.x, rect.y, side, side);
            let axis = match id {
                "before" | "after" => [MIDDLE - around, MIDDLE + around],
                _ => [-1.0, 1.0],
            };
            panels.push(Panel::new(id, square, axis, axis));
        }
        panels.push(Panel::photograph("ratios", ratios, (1, 1)));
        grid.layout(panels)
    }

    fn draw(&mut self, model: &SiftDescriptor, layout: &Layout, canvas: &mut Canvas) {
        let photograph = layout.panel("photograph");
        let wordings = [
            "Photograph: drag the keypoint",
            "Drag the keypoint",
            "Photograph",
        ];
        grid::open(canvas, photograph, &wordings);
        match model.photograph() {
            Ok(picture) => canvas.photograph(photograph.rect, picture),
            Err(notice) => return grid::notice(canvas, photograph.rect, notice),
        }
        let (u, v) = model.keypoint.place();
        let Some(compared) = model.compared() else {
            canvas.grip(photograph.canvas_from_world((u, v)), Role::Grip);
            let notice = model.problem().unwrap_or(Question::LABEL);
            return grid::notice(canvas, layout.panel("ratios").rect, notice);
        };
        let spot = Spot {
            place: [u, v],
            scale_px: SIGMA_PX,
            angle_rad: compared.looks[0].angle_rad,
        };
        patch::draw_window(
            canvas,
            photograph,
            &spot,
            Stroke::solid(Role::Grip, 2.0).cased(),
        );
        canvas.grip(photograph.canvas_from_world((u, v)), Role::Grip);
        let color = || compared.looks.each_ref().map(Look::picture);
        let pieces = self.pieces.maps(model.version(), canvas.theme(), color);
        let ids = [["before", "before-sift"], ["after", "after-sift"]];
        for (k, look) in compared.looks.iter().enumerate() {
            let [piece, histogram] = layout.panels_named(ids[k]);
            for (panel, wordings) in [piece, histogram].into_iter().zip(TITLES[k]) {
                grid::open(canvas, panel, wordings);
            }
            canvas.photograph(piece.rect, &pieces[k]);
            draw_cells(canvas, piece, &look.spot());
            draw_histogram(canvas, histogram, &look.histogram);
        }
        let ratios = compared.distances.map(|distance| distance.ratio());
        draw_ratios(canvas, layout.panel("ratios").rect, ratios);
    }
}

/// Draws the window with its 4 × 4 cells and its orientation.
fn draw_cells(canvas: &mut Canvas, panel: &Panel, spot: &Spot) {
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        let at = |along, across| panel.canvas_from_world(spot.at(along, across));
        let is_small = panel.rect.width < 120.0;
        let thin = Stroke::solid(Role::Grip, 1.0);
        let thin = if is_small { thin } else { thin.cased() };
        for k in [-0.5, 0.0, 0.5] {
            canvas.line(at(k, -1.0), at(k, 1.0), thin);
            canvas.line(at(-1.0, k), at(1.0, k), thin);
        }
        patch::draw_window(canvas, panel, spot, Stroke::solid(Role::Grip, 2.0).cased());
    });
}

/// Draws a star of eight rays in each cell, with lengths from the histogram.
fn draw_histogram(canvas: &mut Canvas, panel: &Panel, histogram: &[f32]) {
    let grid = Stroke::solid(Role::Grid, 1.0);
    for k in [-0.5, 0.0, 0.5] {
        let at = |x, y| panel.canvas_from_world((x, y));
        canvas.line(at(k, -1.0), at(k, 1.0), grid);
        canvas.line(at(-1.0, k), at(1.0, k), grid);
    }
    for (index, value) in histogram.iter().enumerate() {
        let (row, column, bin) = (index / 32, index / 8 % 4, index % 8);
        let center = (0.5 * column as f64 - 0.75, 0.5 * row as f64 - 0.75);
        let angle = bin as f64 * std::f64::consts::FRAC_PI_4;
        let length = 0.24 * (f64::from(*value) / LONGEST).min(1.0);
        let end = (
            center.0 + length * libm::cos(angle),
            center.1 + length * libm::sin(angle),
        );
        let [from, to] = [center, end].map(|place| panel.canvas_from_world(place));
        canvas.line(from, to, Stroke::solid(Role::Best, 2.0));
    }
}

/// Draws the three ratios as bars, and the acceptance threshold.
fn draw_ratios(canvas: &mut Canvas, rect: Rect, ratios: [f64; 3]) {
    let wordings = [
        "Distance ratio to the nearest other",
        "Distance ratio d₁/d₂",
        "d₁/d₂",
    ];
    grid::fitting_title(canvas, rect, &wordings);
    canvas.panel(rect);
    let inside = rect.inset(10.0);
    let x = |ratio: f64| inside.x + inside.width * (ratio / MOST).min(1.0);
    let legend = 30.0_f64.min(inside.height / 4.0);
    let step = ((inside.height - legend) / 3.0).min(76.0);
    let height = (step - 28.0).clamp(4.0, 26.0);
    for (k, (ratio, name)) in ratios.into_iter().zip(WAYS).enumerate() {
        let top = inside.y + step * k as f64;
        let is_believed = ratio < BELIEVED;
        let role = if is_believed {
            Role::Inlier
        } else {
            Role::Outlier
        };
        let verdict = if is_believed { "recognized" } else { "lost" };
        let number = format_number(ratio, 2);
        let text = format!("{name}: {number}, {verdict}");
        let text = match text_width(&text, TEXT) <= inside.width {
            true => text,
            false => format!("{}: {number}", name.split(' ').next().unwrap_or(name)),
        };
        canvas.label(
            (inside.x, top + 9.0),
            &text,
            TextStyle::new(Role::Ink, TEXT),
        );
        let bar = Rect::new(inside.x, top + 20.0, x(ratio) - inside.x, height);
        canvas.fill_rect(bar, role, 0.85);
        let all = Rect::new(inside.x, top + 20.0, inside.width, height);
        canvas.stroke_rect(all, Stroke::solid(Role::Edge, 1.0));
        let tick = Stroke::solid(Role::Ink, 2.0).cased();
        canvas.line(
            (x(BELIEVED), top + 18.0),
            (x(BELIEVED), bar.bottom() + 2.0),
            tick,
        );
    }
    let style = TextStyle::new(Role::Ink, SMALL).middle();
    let below = inside.y + 2.0 * step + 20.0 + height + 14.0;
    canvas.label((x(BELIEVED), below), "τ = 0.8", style);
}
