//! Curves of the number of samples over the inlier ratio, one per sample size, in decades.

use super::guess::PLOT;
use super::model::{GUESSED, RATIOS, RansacBudget, SIZES};
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Layout, Panel, View};
use crate::kit::grid::{Grid, TEXT};
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;

/// Height of the plot with its numbers, CSS pixels.
const HEIGHT: f64 = 420.0;
/// Line spacing of the legend, CSS pixels.
const ROW: f64 = 18.0;
/// Width of the legend from its markers to the right edge, CSS pixels; nine digits fit.
const LEGEND: f64 = 128.0;
/// Number of points per curve.
const NUM_STEPS: u32 = 890;

/// Draws [`RansacBudget`].
#[derive(Default)]
pub struct RansacBudgetView;

fn rulers() -> [Ruler; 2] {
    let ratio = Ruler::linear(0.08, 1.0).shown(100.0, "%");
    [ratio.named("inlier ratio w"), Ruler::decades(-0.2, 6.2)]
}

impl View for RansacBudgetView {
    type Model = RansacBudget;

    fn layout(&self, _: &RansacBudget, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [cell] = grid.shares([1.0], (0.6 * width + 60.0).min(HEIGHT));
        let [x, y] = rulers();
        let plot = plot::panel(PLOT, cell, &x, &y).clickable();
        grid.layout(vec![plot])
    }

    fn draw(&mut self, model: &RansacBudget, layout: &Layout, canvas: &mut Canvas) {
        let plot = plot::open(canvas, layout, PLOT, &["Samples needed, N"], &rulers());
        if model.shows_curves() {
            draw_curves(model, plot, canvas);
        }
        if let Some(guess) = model.guess() {
            guess.draw(canvas, plot);
        }
        if !model.shows_curves() {
            let place = (plot.rect.right() - LEGEND, plot.rect.y + 16.0);
            let text = format!("your guess, s = {GUESSED}");
            canvas.label(place, &text, TextStyle::new(Role::Grip, TEXT).cased());
        }
    }
}

/// Draws the curves, the dashed line and the legend.
fn draw_curves(model: &RansacBudget, plot: &Panel, canvas: &mut Canvas) {
    let ratio = model.inlier_ratio;
    for (index, size) in SIZES.into_iter().enumerate() {
        let places = (0..=NUM_STEPS).filter_map(|step| {
            let share = f64::from(step) / f64::from(NUM_STEPS);
            let w = RATIOS[0] + share * (RATIOS[1] - RATIOS[0]);
            Some((w, plot::decade(model.trials(size, w)? as f64)))
        });
        plot::draw_curve(canvas, plot, places, Stroke::of_series(index, 2.25));
    }
    // Labels go from the highest mark down, since the legend is above it.
    let mark = |trials: u64| plot.canvas_from_world((ratio, plot::decade(trials as f64)));
    let (u, top) = mark(model.now(SIZES[SIZES.len() - 1]));
    let now = Stroke::solid(Role::Grip, 2.0).dashed();
    canvas.line((u, top.max(plot.rect.y)), (u, plot.rect.bottom()), now);
    canvas.grip(plot.canvas_from_world((ratio, 0.0)), Role::Grip);
    // The curves decrease, so the upper right corner is always free; the largest sample has the
    // highest curve.
    let left = plot.rect.right() - LEGEND;
    for (index, size) in SIZES.into_iter().enumerate() {
        let trials = model.now(size);
        let (role, shape) = (Role::Series(index as u8), Shape::of_series(index));
        let y = plot.rect.y + 16.0 + ROW * (SIZES.len() - 1 - index) as f64;
        for place in [mark(trials), (left, y)] {
            if plot.rect.contains(place) {
                canvas.marker(place, 5.0, shape, role, true);
            }
        }
        let text = format!("s = {size}: {trials}");
        canvas.label((left + 12.0, y), &text, TextStyle::new(role, TEXT).cased());
    }
}
