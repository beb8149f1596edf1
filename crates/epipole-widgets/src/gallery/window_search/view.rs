//! Both photographs with the window and its candidate; beside or below them the costs of all
//! candidates, and the lowest one with its neighbors.

use super::model::WindowSearch;
use super::search::{Curve, REACH, Three};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::labels::Labels;
use crate::kit::plot::{self, Ruler};
use crate::kit::rectified::{self, SIZE};
use crate::theme::Role;
use image::RgbImage;

/// Height over width of the photographs.
const ASPECT: f64 = grid::aspect(SIZE);
/// Height of the photographs above the plots, and of the plots, CSS pixels.
const ABOVE: f64 = 254.0;
const BELOW: f64 = 150.0;
/// Range of the close-up to either side of the lowest cost, pixels.
const NEAR_PX: f64 = 1.6;
/// Number of points of a drawn curve.
const NUM_POINTS: usize = 60;
/// Height of the plots relative to the highest cost.
const HEADROOM: f64 = 1.08;

/// Draws [`WindowSearch`].
#[derive(Default)]
pub(crate) struct WindowSearchView;

/// Returns the axes of all costs.
fn cost_rulers(model: &WindowSearch) -> [Ruler; 2] {
    let highest = model.curve().map_or(1.0, Curve::highest);
    [
        Ruler::linear(-1.0, REACH as f64 + 1.0).named("disparity, px"),
        Ruler::linear(0.0, HEADROOM * highest.max(1.0)),
    ]
}

/// Returns the axes of the close-up.
fn near_rulers(model: &WindowSearch) -> [Ruler; 2] {
    let middle = model.curve().map_or(0.0, |curve| curve.winner() as f64);
    let costs = model
        .curve()
        .and_then(Curve::three)
        .map(|three| three.costs);
    let highest = costs.map_or(1.0, |costs| costs.into_iter().fold(0.0, f64::max));
    [
        Ruler::linear(middle - NEAR_PX, middle + NEAR_PX).named("disparity, px"),
        Ruler::linear(0.0, HEADROOM * highest.max(0.1)),
    ]
}

impl View for WindowSearchView {
    type Model = WindowSearch;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &WindowSearch, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (left, right, costs, near);
        if grid::is_broad(width) {
            let side;
            [left, right, side] = grid.row([ASPECT, ASPECT, 1.05], f64::INFINITY);
            [costs, near] = grid::stack(side, [1.0; 2]);
        } else {
            [left, right] = grid.row([ASPECT; 2], ABOVE);
            [costs, near] = grid.shares([1.25, 1.0], BELOW);
        }
        let ([d, cost], [near_d, near_cost]) = (cost_rulers(model), near_rulers(model));
        // The world of the right photograph has the window's disparity along the rows, so that the
        // candidate's handle gives it.
        let (u, v) = model.place.place();
        let from = |place: f64, size: u32| [-0.5 - place, f64::from(size) - 0.5 - place];
        grid.layout(vec![
            Panel::photograph("left", left, SIZE).clickable(),
            Panel::new("right", right, from(u, SIZE.0).map(|x| -x), from(v, SIZE.1)).clickable(),
            plot::panel("costs", costs, &d, &cost),
            plot::panel("near", near, &near_d, &near_cost),
        ])
    }

    fn photograph(&mut self, model: &WindowSearch, panel: &str) -> Option<RgbImage> {
        let pair = model.asked.answer()?;
        (panel == "left").then(|| pair.pictures[0].image().clone())
    }

    fn draw(&mut self, model: &WindowSearch, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 4] = [
            ("left", &["Left: drag the window", "Left"]),
            (
                "right",
                &[
                    "Right: drag the candidate along the row",
                    "Right: drag along",
                ],
            ),
            (
                "costs",
                &[
                    "Mean |difference|, gray levels",
                    "Mean |difference|",
                    "Cost",
                ],
            ),
            (
                "near",
                &[
                    "The lowest cost and its neighbors",
                    "Around the lowest",
                    "Lowest",
                ],
            ),
        ];
        let [left, right, costs, near] = grid::open_all(canvas, layout, titles);
        let ([d, cost], [near_d, near_cost]) = (cost_rulers(model), near_rulers(model));
        plot::draw_axes(canvas, costs, &d, &cost);
        plot::draw_axes(canvas, near, &near_d, &near_cost);
        let (Some(pair), Some(curve)) = (model.asked.answer(), model.curve()) else {
            return grid::notice(canvas, left.rect, model.asked.stand_in());
        };
        for (panel, picture) in [left, right].into_iter().zip(&pair.pictures) {
            canvas.photograph(panel.rect, picture.image());
        }
        let half = (f64::from(model.half_px()) + 0.5) * left.scale_x();
        canvas.clipped(left.rect, |canvas| {
            let place = left.canvas_from_world(model.place.place());
            rectified::draw_window(canvas, place, half);
        });
        canvas.clipped(right.rect, |canvas| {
            draw_right(model, curve, (right, half), canvas);
        });
        draw_costs(model, curve, costs, canvas);
        match curve.three() {
            Some(three) => draw_near(model, &three, near, canvas),
            None => grid::notice(
                canvas,
                near.rect,
                "The lowest cost is at the end of the row.",
            ),
        }
    }
}

/// Draws the row, the candidate, the place of the lowest cost, and the true one.
fn draw_right(
    model: &WindowSearch,
    curve: &Curve,
    (panel, half): (&Panel, f64),
    canvas: &mut Canvas,
) {
    let at = |disparity: f64| panel.canvas_from_world((disparity, 0.0));
    let [from, to] = [curve.costs().len() as f64 - 1.0, 0.0].map(at);
    canvas.line(from, to, Stroke::solid(Role::Grip, 1.25).cased().dotted());
    rectified::draw_window(canvas, at(model.candidate_px() as f64), half);
    canvas.marker(
        at(curve.winner() as f64),
        4.0,
        Shape::Disk,
        Role::Best,
        true,
    );
    if let Some(truth) = model.truth_px() {
        canvas.marker(at(truth), 5.0, Shape::Plus, Role::Truth, true);
    }
}

/// Draws all costs, the candidate's, the lowest one, and the true disparity.
fn draw_costs(model: &WindowSearch, curve: &Curve, panel: &Panel, canvas: &mut Canvas) {
    let places = (curve.costs().iter().enumerate()).map(|(d, cost)| (d as f64, *cost));
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for place in places.clone() {
        labels.keep_free(panel.canvas_from_world(place), 3.0);
    }
    if let Some(truth) = model.truth_px() {
        draw_truth(canvas, panel, truth);
    }
    plot::draw_now(canvas, panel, model.candidate_px() as f64);
    plot::draw_curve(canvas, panel, places, Stroke::solid(Role::Ink, 1.75));
    let marks = [
        (model.candidate_px(), Shape::Square, Role::Grip, "candidate"),
        (curve.winner(), Shape::Disk, Role::Best, "lowest"),
    ];
    let places = marks.map(|(d, ..)| panel.canvas_from_world((d as f64, curve.costs()[d])));
    for (place, (_, shape, role, _)) in places.into_iter().zip(marks) {
        canvas.marker(place, 4.5, shape, role, true);
        labels.keep_free(place, 6.0);
    }
    for (place, (.., role, name)) in places.into_iter().zip(marks) {
        labels.name(canvas, (place, 8.0), name, (role, SMALL));
    }
}

/// Draws the line at the true disparity.
fn draw_truth(canvas: &mut Canvas, panel: &Panel, truth: f64) {
    let x = panel.canvas_from_world((truth, 0.0)).0;
    let rect = panel.rect;
    canvas.clipped(rect.inset(1.0), |canvas| {
        canvas.line(
            (x, rect.y),
            (x, rect.bottom()),
            Stroke::solid(Role::Truth, 2.0),
        );
    });
}

/// Draws three costs, the curve through them, its lowest point, and the true disparity.
fn draw_near(model: &WindowSearch, three: &Three, panel: &Panel, canvas: &mut Canvas) {
    let refinement = model.refinement();
    let at = |x: f64| three.at as f64 + x;
    if let Some(truth) = model.truth_px() {
        draw_truth(canvas, panel, truth);
    }
    let x = |k: usize| NEAR_PX * (2.0 * k as f64 / NUM_POINTS as f64 - 1.0);
    // With the tip of the two lines among the points.
    let offset = three.offset(refinement);
    let mut xs: Vec<f64> = (0..=NUM_POINTS).map(x).chain([offset]).collect();
    xs.sort_by(f64::total_cmp);
    let curve = (xs.into_iter()).map(|x| (at(x), three.height(refinement, at(x))));
    plot::draw_curve(canvas, panel, curve, Stroke::solid(Role::Candidate, 2.0));
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for (x, cost) in [-1.0, 0.0, 1.0].into_iter().zip(three.costs) {
        let place = panel.canvas_from_world((at(x), cost));
        let role = if x == 0.0 { Role::Best } else { Role::Ink };
        canvas.marker(place, 4.5, Shape::Disk, role, true);
        labels.keep_free(place, 6.0);
    }
    let lowest = (at(offset), three.height(refinement, at(offset)));
    let place = panel.canvas_from_world(lowest);
    canvas.marker(place, 5.0, Shape::Diamond, Role::Candidate, true);
    labels.keep_free(place, 6.0);
    labels.name(canvas, (place, 8.0), "minimum", (Role::Candidate, SMALL));
    let Some(truth) = model.truth_px() else {
        return;
    };
    let beside = panel.canvas_from_world((truth, 0.0)).0;
    let rect = panel.rect;
    let text = match truth - three.at as f64 {
        off if off < -NEAR_PX => "← true d",
        off if off > NEAR_PX => "true d →",
        _ => "true d",
    };
    let place = (beside.clamp(rect.x, rect.right()), rect.y + 12.0);
    labels.name(canvas, (place, 5.0), text, (Role::Truth, SMALL));
}
