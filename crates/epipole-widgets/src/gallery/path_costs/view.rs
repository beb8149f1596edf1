//! The left photograph with the paths in the colors of their disparities; beside it the raw cost
//! of the pixel, and below that the path costs with their mean.

use super::costs::{Costs, NUM_DISPARITIES, path_winner_px, pixels};
use super::model::PathCostsModel;
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::heat::{self, Heat};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::plot::{self, Ruler};
use crate::kit::rectified::SIZE;
use crate::theme::{Role, Theme, mix};
use epipole::stereo::PathCosts;
use image::{GrayImage, RgbImage};

/// Height over width of the photograph.
const ASPECT: f64 = grid::aspect(SIZE);
/// Heights on a phone, CSS pixels: of the path costs, and of the color bar below the legend.
const LOW: f64 = 128.0;
const BAR: f64 = 38.0;
/// Left end of the legend if it is beside the plots, CSS pixels.
const LEGEND_LEFT: f64 = 292.0;
/// Heights of the two plots relative to each other.
const HEIGHTS: [f64; 2] = [0.4, 0.6];
/// Height of the axis, relative to the highest cost.
const HEADROOM: f64 = 1.08;
const FOOTROOM: f64 = 0.18;
/// Weight of the page's color in the photograph, to make the paths stand out.
const FADED: f32 = 0.4;
/// End of the color scale of the paths, pixels: nearly the largest true disparity.
const SCALE_PX: f64 = 40.0;
/// Distances of an arrow's ends from the pixel, CSS pixels: in a small photograph, and others.
const ARROWS: [[f64; 2]; 2] = [[29.0, 12.0], [44.0, 15.0]];
/// Width below which a panel is too small for names, CSS pixels.
const SMALL_PANEL: f64 = 200.0;

const PATH: Stroke = Stroke::solid(Role::Reference, 1.0);
const MARKED: Stroke = Stroke::solid(Role::Candidate, 2.0).dashed();
const MEAN: Stroke = Stroke::solid(Role::Best, 2.5);
const TRUE_D: Stroke = Stroke::solid(Role::Truth, 2.0);
const LEGEND: [Entry; 4] = [
    (Swatch::Line(PATH), "a path's L"),
    (Swatch::Line(MARKED), "marked"),
    (Swatch::Line(MEAN), "mean L"),
    (Swatch::Line(TRUE_D), "true d"),
];

/// Draws [`PathCostsModel`].
#[derive(Default)]
pub(crate) struct PathCostsView {
    faded: Heat,
}

/// Returns the axes of the raw cost and of the path costs.
fn rulers(model: &PathCostsModel) -> [[Ruler; 2]; 2] {
    let highest = |values: Vec<f64>| values.into_iter().fold(10.0, f64::max);
    let (mut raw, mut path) = (10.0, 10.0);
    if let Some(costs) = model.costs() {
        raw = highest(costs.raw());
        let all = costs.paths().flat_map(|(_, path)| &path.costs);
        path = highest(all.map(|&cost| cost.into()).collect());
    }
    let disparity = || Ruler::linear(-1.0, f64::from(NUM_DISPARITIES));
    let cost = |highest: f64| Ruler::linear(-FOOTROOM * highest, HEADROOM * highest);
    [
        [disparity(), cost(raw)],
        [disparity().named("disparity d, px"), cost(path)],
    ]
}

impl View for PathCostsView {
    type Model = PathCostsModel;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &PathCostsModel, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (left, raw, paths);
        if grid::is_narrow(width) {
            [left, raw] = grid.row([ASPECT; 2], f64::INFINITY);
            [paths] = grid.shares([1.0], LOW);
            grid.strip(legend::height(&LEGEND, width, 0.0));
            grid.strip(BAR);
        } else {
            let beside = if grid::is_broad(width) { ASPECT } else { 1.0 };
            let side;
            [left, side] = grid.row([ASPECT, beside], f64::INFINITY);
            [raw, paths] = grid::stack(side, HEIGHTS);
            grid.strip(BAR);
        }
        let [[raw_d, raw_cost], [path_d, path_cost]] = rulers(model);
        grid.layout(vec![
            Panel::photograph("left", left, SIZE).clickable(),
            plot::panel("raw", raw, &raw_d, &raw_cost),
            plot::panel("paths", paths, &path_d, &path_cost),
        ])
    }

    fn photograph(&mut self, model: &PathCostsModel, panel: &str) -> Option<RgbImage> {
        let pictures = &model.asked.answer().filter(|_| panel == "left")?.pictures;
        Some(pictures[0].image().clone())
    }

    fn draw(&mut self, model: &PathCostsModel, layout: &Layout, canvas: &mut Canvas) {
        let [left, raw, paths] = layout.panels_named(["left", "raw", "paths"]);
        grid::open(
            canvas,
            left,
            &[
                "Each path in the color of its best disparity",
                "Paths to the pixel",
                "Paths",
            ],
        );
        let [raw_rulers, path_rulers] = rulers(model);
        plot::open(
            canvas,
            layout,
            "raw",
            &["Raw cost C of the pixel", "Raw cost C"],
            &raw_rulers,
        );
        let titles = ["Path costs L, and their mean", "Path costs L"];
        plot::open(canvas, layout, "paths", &titles, &path_rulers);
        draw_legend(canvas, layout);
        let (Some(costs), Some(gray)) = (model.costs(), model.gray()) else {
            return grid::notice(canvas, left.rect, model.asked.stand_in());
        };
        let theme = canvas.theme();
        let [faded] = (self.faded).maps(model.asked.version(), theme, || [faded(gray, theme)]);
        canvas.photograph(left.rect, faded);
        canvas.clipped(left.rect, |canvas| draw_paths(model, costs, left, canvas));
        draw_raw(model, costs, raw, canvas);
        draw_costs(model, costs, paths, canvas);
    }
}

/// Returns the photograph in gray, blended with the panel.
fn faded(gray: &GrayImage, theme: Theme) -> RgbImage {
    let surface = theme.color(Role::Surface);
    RgbImage::from_fn(SIZE.0, SIZE.1, |u, v| {
        let [level] = gray.get_pixel(u, v).0;
        image::Rgb(mix([level; 3], surface, FADED))
    })
}

/// Draws each path in the colors of its lowest-cost disparities, with an arrow.
fn draw_paths(model: &PathCostsModel, costs: &Costs, panel: &Panel, canvas: &mut Canvas) {
    let theme = canvas.theme();
    let side = (2.2 * panel.scale_x()).clamp(2.0, 4.0);
    let at = model.place.pixel();
    let width = |index: usize| match Some(index) == model.marked() {
        true => 2.0 * side,
        false => side,
    };
    let places = |index: usize| pixels(index, at).map(|place| panel.canvas_from_world(place));
    for (index, path) in costs.paths() {
        let casing = width(index) + 2.0;
        for (place, _) in places(index).zip(&path.winners_px) {
            canvas.speck(place, casing, theme.color(Role::Halo));
        }
    }
    for (index, path) in costs.paths() {
        for (place, &winner_px) in places(index).zip(path.winners_px.iter().rev()) {
            let color = theme.scale(f64::from(winner_px) / SCALE_PX);
            canvas.speck(place, width(index), color);
        }
    }
    let (x, y) = panel.canvas_from_world(model.place.place());
    let is_small = panel.rect.width < SMALL_PANEL;
    let [far, near] = ARROWS[usize::from(!is_small)];
    for (index, path) in costs.paths() {
        let mut back = pixels(index, (0, 0)).skip(1);
        let (du, dv) = back.next().unwrap_or_default();
        let length = libm::hypot(du, dv);
        let from_pixel = |distance: f64| (x + distance * du / length, y + distance * dv / length);
        let steps = path.winners_px.len() as f64 - 1.0;
        let room = steps * length * panel.scale_x();
        if room > far {
            let role = match Some(index) == model.marked() {
                true => Role::Candidate,
                false => Role::Ink,
            };
            let stroke = Stroke::solid(role, if is_small { 1.5 } else { 2.0 }).cased();
            canvas.arrow(from_pixel(far), from_pixel(near), stroke);
        }
    }
    canvas.grip((x, y), Role::Grip);
}

/// Draws the line at the true disparity.
fn draw_truth(model: &PathCostsModel, panel: &Panel, canvas: &mut Canvas) {
    let Some(truth) = model.truth_px() else {
        return;
    };
    let x = panel.canvas_from_world((truth, 0.0)).0;
    let rect = panel.rect;
    canvas.clipped(rect.inset(1.0), |canvas| {
        canvas.line((x, rect.y), (x, rect.bottom()), TRUE_D);
    });
}

fn curve(values: &[f64]) -> impl Iterator<Item = (f64, f64)> {
    values.iter().enumerate().map(|(d, cost)| (d as f64, *cost))
}

/// Draws the raw cost with its minimum.
fn draw_raw(model: &PathCostsModel, costs: &Costs, panel: &Panel, canvas: &mut Canvas) {
    draw_truth(model, panel, canvas);
    let raw = costs.raw();
    plot::draw_curve(canvas, panel, curve(&raw), Stroke::solid(Role::Ink, 1.75));
    let winner = costs.raw_winner_px();
    let mark = (winner, raw[winner], Shape::Square, Role::Outlier);
    draw_minimum(panel, &[raw], mark, canvas);
}

/// Draws the path costs, the marked one above the others, and their mean with its minimum.
fn draw_costs(model: &PathCostsModel, costs: &Costs, panel: &Panel, canvas: &mut Canvas) {
    draw_truth(model, panel, canvas);
    let values = |path: &PathCosts| path.costs.iter().map(|&cost| cost.into()).collect();
    let mut curves: Vec<Vec<f64>> = costs.paths().map(|(_, path)| values(path)).collect();
    for path in &curves {
        plot::draw_curve(canvas, panel, curve(path), PATH);
    }
    let means = costs.means();
    plot::draw_curve(canvas, panel, curve(&means), MEAN);
    if let Some(path) = model.marked_path() {
        let values: Vec<f64> = values(path);
        plot::draw_curve(canvas, panel, curve(&values), MARKED);
        let winner = path_winner_px(path);
        let place = panel.canvas_from_world((winner as f64, values[winner]));
        canvas.marker(place, 4.5, Shape::Diamond, Role::Candidate, true);
    }
    let winner = costs.winner_px();
    let mark = (winner, means[winner], Shape::Disk, Role::Best);
    curves.push(means);
    draw_minimum(panel, &curves, mark, canvas);
}

/// Draws the mark of a minimum, and its name at a position that covers no curve.
fn draw_minimum(
    panel: &Panel,
    curves: &[Vec<f64>],
    (d, cost, shape, role): (usize, f64, Shape, Role),
    canvas: &mut Canvas,
) {
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for values in curves {
        for pair in curve(values).collect::<Vec<_>>().windows(2) {
            let [from, to] = [pair[0], pair[1]].map(|place| panel.canvas_from_world(place));
            labels.keep_line_free(from, to);
        }
    }
    let place = panel.canvas_from_world((d as f64, cost));
    canvas.marker(place, 4.5, shape, role, true);
    if panel.rect.width < SMALL_PANEL {
        return;
    }
    labels.keep_free(place, 6.0);
    labels.name(canvas, (place, 8.0), "minimum", (role, SMALL));
}

/// Draws the colors of the paths, and the legend of the plots' lines.
fn draw_legend(canvas: &mut Canvas, layout: &Layout) {
    let top = layout.height - BAR;
    let words = "disparity of a path";
    canvas.label((0.0, top + 12.0), words, TextStyle::new(Role::Ink, SMALL));
    let bar = Rect::new(124.0, top + 6.0, 150.0, 11.0);
    heat::bar(canvas, bar, ["0 px, far", "40 px, near"], Theme::scale);
    if grid::is_narrow(layout.width) {
        return legend::draw_last(canvas, &LEGEND, layout, 0.0, BAR);
    }
    let side = match grid::is_broad(layout.width) {
        true => layout.panel("raw").rect.x - plot::LEFT,
        false => LEGEND_LEFT,
    };
    // The margin is the same on both sides.
    legend::draw(canvas, &LEGEND, layout.width + side, side, top + 2.0);
}
