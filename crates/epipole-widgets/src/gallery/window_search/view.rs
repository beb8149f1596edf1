//! Both photographs with the window and its candidate; beside or below them the costs of all
//! candidates, and a close-up of the lowest one with its neighbors.

use super::model::WindowSearch;
use super::search::{Curve, REACH, Three};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::labels::Labels;
use crate::kit::picture::Picture;
use crate::kit::plot::{self, Ruler};
use crate::kit::rectified::{self, SIZE};
use crate::theme::Role;
use image::imageops::crop_imm;

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
/// Upper end of the axis for low curves, gray levels.
const LOW: f64 = 40.0;
/// Side of an enlarged window relative to the height of its photograph.
const INSET: f64 = 0.3;

/// Draws [`WindowSearch`].
#[derive(Default)]
pub(crate) struct WindowSearchView;

/// Returns the axes of all costs.
fn cost_rulers(model: &WindowSearch) -> [Ruler; 2] {
    let highest = HEADROOM * model.curve().map_or(0.0, Curve::highest).max(LOW);
    [
        Ruler::linear(-1.0, REACH as f64 + 1.0).named("disparity, px"),
        Ruler::linear(-0.06 * highest, highest),
    ]
}

/// Returns the axes of the close-up.
fn near_rulers(model: &WindowSearch) -> [Ruler; 2] {
    let middle = model.curve().map_or(0.0, |curve| curve.winner() as f64);
    let three = model.curve().and_then(Curve::three);
    let highest = three.map_or(1.0, |three| three.costs.into_iter().fold(0.0, f64::max));
    // Two lines may meet below zero.
    let lowest = three.map_or(0.0, |three| three.lowest(model.refinement()).1);
    let highest = HEADROOM * highest.max(0.1);
    let lowest = lowest.min(0.0);
    [
        Ruler::linear(middle - NEAR_PX, middle + NEAR_PX).named("disparity, px"),
        Ruler::linear(lowest - 0.1 * (highest - lowest), highest),
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
        // In the right photograph's panel, x is the window's disparity, so that the candidate's
        // handle gives it.
        let (u, v) = model.place.place();
        let from = |place: f64, size: u32| [-0.5 - place, f64::from(size) - 0.5 - place];
        grid.layout(vec![
            Panel::photograph("left", left, SIZE).clickable(),
            Panel::new("right", right, from(u, SIZE.0).map(|x| -x), from(v, SIZE.1)).clickable(),
            plot::panel("costs", costs, &d, &cost),
            plot::panel("near", near, &near_d, &near_cost),
        ])
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
        let shifts = [0, model.candidate_px() as u32];
        for ((panel, picture), shift) in [left, right].into_iter().zip(&pair.pictures).zip(shifts) {
            draw_inset(model, (panel, picture), shift, canvas);
        }
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

/// Draws the row, the candidate, the position of the lowest cost, and the true one.
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
    let winner = Rect::around(at(curve.winner() as f64), half);
    canvas.stroke_rect(winner, Stroke::solid(Role::Best, 2.0).cased());
    if let Some(truth) = model.truth_px() {
        canvas.marker(at(truth), 5.0, Shape::Plus, Role::Truth, true);
    }
}

/// Draws an enlarged window in a lower corner, shifted to the left by this many pixels.
fn draw_inset(
    model: &WindowSearch,
    (panel, picture): (&Panel, &Picture),
    shift: u32,
    canvas: &mut Canvas,
) {
    let ((u, v), half) = (model.place.pixel(), model.half_px());
    let side = 2 * half + 1;
    let window = crop_imm(picture.image(), u - shift - half, v - half, side, side);
    let (rect, size) = (panel.rect, INSET * panel.rect.height);
    // In the corner away from the window.
    let x = match u < SIZE.0 / 2 && v > SIZE.1 / 2 {
        true => rect.right() - size,
        false => rect.x,
    };
    let inset = Rect::new(x, rect.bottom() - size, size, size).inset(4.0);
    canvas.photograph(inset, &window.to_image());
    canvas.stroke_rect(inset, Stroke::solid(Role::Grip, 2.0).cased());
}

/// Draws all costs, the candidate's, the lowest one, and the true disparity.
fn draw_costs(model: &WindowSearch, curve: &Curve, panel: &Panel, canvas: &mut Canvas) {
    let places = (curve.costs().iter().enumerate()).map(|(d, cost)| (d as f64, *cost));
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for (d, pair) in curve.costs().windows(2).enumerate() {
        let ends = [(d, pair[0]), (d + 1, pair[1])].map(|(d, cost)| (d as f64, cost));
        let [from, to] = ends.map(|place| panel.canvas_from_world(place));
        labels.keep_line_free(from, to);
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
    // The points include the tip of the two lines.
    let x = |k: usize| NEAR_PX * (2.0 * k as f64 / NUM_POINTS as f64 - 1.0);
    let offset = three.offset(refinement);
    let mut xs: Vec<f64> = (0..=NUM_POINTS).map(x).chain([offset]).collect();
    xs.sort_by(f64::total_cmp);
    let curve = (xs.into_iter()).map(|x| (at(x), three.height(refinement, at(x))));
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for place in curve.clone() {
        labels.keep_free(panel.canvas_from_world(place), 2.0);
    }
    plot::draw_curve(canvas, panel, curve, Stroke::solid(Role::Candidate, 2.0));
    for (x, cost) in [-1.0, 0.0, 1.0].into_iter().zip(three.costs) {
        let place = panel.canvas_from_world((at(x), cost));
        let role = if x == 0.0 { Role::Best } else { Role::Ink };
        canvas.marker(place, 4.5, Shape::Disk, role, true);
        labels.keep_free(place, 6.0);
    }
    let place = panel.canvas_from_world(three.lowest(refinement));
    canvas.marker(place, 5.0, Shape::Diamond, Role::Candidate, true);
    labels.keep_free(place, 6.0);
    let Some(truth) = model.truth_px() else {
        return;
    };
    let (beside, rect) = (panel.canvas_from_world((truth, 0.0)).0, panel.rect);
    labels.keep_rect_free(Rect::new(beside - 2.0, rect.y, 4.0, rect.height));
    labels.name(canvas, (place, 8.0), "minimum", (Role::Candidate, SMALL));
    let text = match truth - three.at as f64 {
        off if off < -NEAR_PX => "← true d",
        off if off > NEAR_PX => "true d →",
        _ => "true d",
    };
    let place = (beside.clamp(rect.x, rect.right()), rect.y + 12.0);
    labels.name(canvas, (place, 5.0), text, (Role::Truth, SMALL));
}
