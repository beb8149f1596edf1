//! The photograph, the difference of Gaussians at the current blur, thumbnails of all layers, and
//! the curve.

use super::model::ScaleSpace;
use super::question::{Answer, Layer, NUM_LAYERS, NUM_OCTAVES};
use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::features::SIZE;
use crate::kit::grid::{self, GAP, Grid, SMALL};
use crate::kit::heat::{self, Fill, Heat, Signed};
use crate::kit::labels::Labels;
use crate::kit::plot::{self, Ruler, decade};
use crate::theme::{Role, Theme};
use image::{Rgb, RgbImage};

const COUNT: usize = NUM_OCTAVES * NUM_LAYERS;
/// Difference drawn at full saturation, gray levels.
const STRONG: f64 = 20.0;
const LEGEND: f64 = 24.0;
/// Subsampling of the small maps.
const SMALLER: u32 = 3;
/// Gap between small maps, CSS pixels.
const BETWEEN: f64 = 4.0;

/// Draws [`ScaleSpace`].
#[derive(Default)]
pub(crate) struct ScaleSpaceView {
    /// Map of the current layer, and thumbnails of all layers.
    large: Heat,
    small: Heat<COUNT>,
}

fn rulers(answers: &[(f64, f64)]) -> [Ruler; 2] {
    let most = answers.iter().map(|(_, d)| d.abs()).fold(5.0, f64::max) * 1.15;
    [
        Ruler::decades(decade(1.9), decade(26.5)).named("blur σ, px"),
        Ruler::linear(-most, most),
    ]
}

impl View for ScaleSpaceView {
    type Model = ScaleSpace;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &ScaleSpace, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let [x, y] = rulers(&model.answers());
        let (pictures, curve);
        if grid::is_broad(width) {
            let [first, second, third] = grid.row([aspect, aspect, 0.8], 290.0);
            (pictures, curve) = ([first, second], third);
        } else {
            pictures = grid.row([aspect; 2], 215.0);
            let height = if grid::is_narrow(width) { 100.0 } else { 140.0 };
            [curve] = grid.shares([1.0], height);
        }
        let first = if grid::is_narrow(width) { 37.0 } else { 84.0 };
        let [layers] = grid.shares([1.0], first * aspect + 2.0);
        grid.strip(LEGEND);
        grid.layout(vec![
            Panel::photograph("photograph", pictures[0], SIZE).clickable(),
            Panel::photograph("difference", pictures[1], SIZE),
            plot::panel("curve", curve, &x, &y),
            Panel::photograph("layers", layers, (1, 1)),
        ])
    }

    fn draw(&mut self, model: &ScaleSpace, layout: &Layout, canvas: &mut Canvas) {
        let sigma = format_number(model.sigma_px(), 1);
        let title = format!("Difference of Gaussians, σ = {sigma} px");
        let short = format!("Difference, σ = {sigma}");
        let [photograph, difference] = grid::open_all(
            canvas,
            layout,
            [
                ("photograph", &["Photograph: drag the probe", "Photograph"]),
                ("difference", &[&title, &short]),
            ],
        );
        let (answers, titles) = (
            model.answers(),
            [
                "Difference at the probe, gray levels",
                "Difference, gray levels",
            ],
        );
        let curve = plot::open(canvas, layout, "curve", &titles, &rulers(&answers));
        let layers = layout.panel("layers");
        let titles = [
            "Four octaves of three layers, each octave half as wide",
            "Four octaves",
        ];
        grid::fitting_title(canvas, layers.rect, &titles);
        draw_legend(canvas, layout);
        let Some(answer) = model.asked.answer() else {
            return grid::notice(canvas, photograph.rect, model.asked.stand_in());
        };
        canvas.photograph(photograph.rect, answer.photograph.image());
        let theme = canvas.theme();
        let (version, shown) = (model.asked.version(), model.layer(answer));
        let color = || [colored(&answer.layers[shown], theme, 1)];
        let [map] = (self.large).maps(version * COUNT as u64 + shown as u64, theme, color);
        canvas.photograph(difference.rect, map);
        let color = || std::array::from_fn(|k| colored(&answer.layers[k], theme, SMALLER));
        let maps = self.small.maps(version, theme, color);
        draw_layers(canvas, layers.rect, answer, maps, shown);
        let place = model.probe.place();
        for panel in [photograph, difference] {
            canvas.clipped(panel.rect, |canvas| {
                let at = panel.canvas_from_world(place);
                let radius = |sigma: f64| std::f64::consts::SQRT_2 * sigma * panel.scale_x();
                if let Some(found) = model.extremum() {
                    let stroke = Stroke::solid(Role::Best, 2.0).dashed().cased();
                    canvas.circle(at, radius(found.sigma_px), stroke);
                }
                let stroke = Stroke::solid(Role::Grip, 2.0).cased();
                canvas.circle(at, radius(model.sigma_px()), stroke);
            });
        }
        canvas.grip(photograph.canvas_from_world(place), Role::Grip);
        draw_answers(model, &answers, curve, canvas);
    }
}

/// Colors a layer, warm for positive, cool and striped for negative values, at every `every`-th
/// sample.
fn colored(layer: &Layer, theme: Theme, every: u32) -> RgbImage {
    let colors = Signed::of(theme);
    // Stripes do not fit in small maps.
    let faint = if every == 1 { 0.55 } else { 1.0 };
    let (width, height) = layer.values.dimensions();
    RgbImage::from_fn(width / every, height / every, |u, v| {
        let value = 255.0 * f64::from(layer.values.get_pixel(every * u, every * v).0[0]);
        let strength = (value.abs() / STRONG).min(1.0).sqrt() as f32;
        Rgb(colors.at((u, v), value < 0.0, strength, faint))
    })
}

/// Draws every layer at its own size, the current one framed.
fn draw_layers(canvas: &mut Canvas, rect: Rect, answer: &Answer, maps: &[RgbImage], shown: usize) {
    let height = rect.height - 2.0;
    let first = height * f64::from(SIZE.0) / f64::from(SIZE.1);
    let mut x = rect.x + 1.0;
    for (k, (layer, map)) in answer.layers.iter().zip(maps).enumerate() {
        let (width, height) = (first / layer.step_px, height / layer.step_px);
        let small = Rect::new(x, rect.bottom() - 1.0 - height, width, height);
        canvas.photograph(small, map);
        if k == shown {
            canvas.stroke_rect(small, Stroke::solid(Role::Grip, 2.5));
        }
        let is_last = k % NUM_LAYERS == NUM_LAYERS - 1;
        x = small.right() + if is_last { GAP } else { BETWEEN };
    }
}

/// Draws the curve, the current position on it, and its extremum.
fn draw_answers(model: &ScaleSpace, answers: &[(f64, f64)], panel: &Panel, canvas: &mut Canvas) {
    let world = |(sigma, value): (f64, f64)| (decade(sigma), value);
    let zero = panel.canvas_from_world((0.0, 0.0)).1;
    let (left, right) = (panel.rect.x + 1.0, panel.rect.right() - 1.0);
    canvas.line((left, zero), (right, zero), Stroke::solid(Role::Edge, 1.5));
    let places = answers.iter().map(|answer| world(*answer));
    plot::draw_curve(
        canvas,
        panel,
        places.clone(),
        Stroke::solid(Role::Ink, 1.75),
    );
    let mut labels = Labels::new(panel.rect.inset(3.0));
    for place in places {
        let at = panel.canvas_from_world(place);
        canvas.marker(at, 2.0, Shape::Disk, Role::Ink, false);
        labels.keep_free(at, 4.0);
    }
    plot::draw_now(canvas, panel, decade(model.sigma_px()));
    if let Some(found) = model.extremum() {
        let at = panel.canvas_from_world(world((found.sigma_px, found.value)));
        canvas.marker(at, 5.0, Shape::Diamond, Role::Best, true);
        labels.keep_free(at, 6.0);
        let text = format!("extremum: σ = {} px", format_number(found.sigma_px, 1));
        let style = TextStyle::new(Role::Ink, SMALL).cased();
        // The curve has the same sign around its extremum.
        let away = if found.value < 0.0 { -12.0 } else { 12.0 };
        labels.draw(
            canvas,
            &[((at.0, zero + away), Align::Middle)],
            &text,
            style,
        );
        let stem = Stroke::solid(Role::Best, 1.25).dashed();
        canvas.line(at, (at.0, zero), stem);
    }
    if let Some(now) = model.now() {
        let at = panel.canvas_from_world(world((model.sigma_px(), now)));
        canvas.grip(at, Role::Grip);
    }
}

fn draw_legend(canvas: &mut Canvas, layout: &Layout) {
    let [bright, dark] = match grid::is_narrow(layout.width) {
        true => ["bright", "dark"],
        false => [
            "negative: something bright (striped)",
            "positive: something dark",
        ],
    };
    let entries = [
        (Fill::Role(Role::Candidate, 0.7), bright),
        (Fill::Role(Role::Outlier, 0.9), dark),
    ];
    heat::swatches(canvas, (0.0, layout.height - LEGEND / 2.0), 22.0, &entries);
}
