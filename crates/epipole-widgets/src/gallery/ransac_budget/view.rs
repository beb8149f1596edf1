//! The curves of the sample sizes over the share of inliers, the number of samples on a logarithmic
//! scale.

use super::model::{RansacBudget, SHARES, SIZES};
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Layout, Panel, Rect, View};
use crate::theme::Role;

const TEXT: f64 = 13.0;
const SMALL: f64 = 12.0;
/// From one line of the legend to the next.
const ROW: f64 = 18.0;
/// From the legend's markers to the right edge: nine digits fit.
const LEGEND: f64 = 128.0;
/// Decades of N that the plot spans.
const DECADES: (f64, f64) = (-0.2, 6.2);
const TICKS: [(f64, &str); 7] = [
    (0.0, "1"),
    (1.0, "10"),
    (2.0, "100"),
    (3.0, "1000"),
    (4.0, "10⁴"),
    (5.0, "10⁵"),
    (6.0, "10⁶"),
];

/// Draws [`RansacBudget`].
#[derive(Default)]
pub struct RansacBudgetView;

impl View for RansacBudgetView {
    type Model = RansacBudget;

    fn layout(&self, _: &RansacBudget, width: f64) -> Layout {
        let left = 48.0_f64.min(width / 4.0);
        let height = (width * 0.5).clamp(240.0, 340.0);
        let rect = Rect::new(left, 26.0, (width - left - 10.0).max(1.0), height);
        Layout {
            width,
            height: rect.bottom() + 44.0,
            panels: vec![Panel {
                id: "plot",
                rect,
                x_axis: Axis {
                    start: 0.08,
                    end: 1.0,
                },
                y_axis: Axis {
                    start: DECADES.1,
                    end: DECADES.0,
                },
                clickable: true,
            }],
        }
    }

    fn draw(&mut self, model: &RansacBudget, layout: &Layout, canvas: &mut Canvas) {
        let plot = layout.panel("plot");
        canvas.panel(plot.rect);
        draw_axes(plot, canvas);
        let share = model.share();
        let x = plot.canvas_from_world((share, 0.0)).0;
        let marker = Stroke::solid(Role::Grip, 2.0).dashed();
        // From the highest mark down: above it is the legend.
        let mark = |trials: u64| plot.canvas_from_world((share, libm::log10(trials as f64)));
        let largest = model.trials(SIZES[SIZES.len() - 1].0, share);
        let top = largest.map_or(plot.rect.y, |trials| mark(trials).1.max(plot.rect.y));
        canvas.line((x, top), (x, plot.rect.bottom()), marker);
        let grip = plot.canvas_from_world((share, 0.0));
        canvas.marker(grip, 6.0, Shape::Disk, Role::Grip, true);
        canvas.clipped(plot.rect.inset(1.0), |canvas| {
            for (index, (size, _)) in SIZES.iter().enumerate() {
                canvas.polyline(&curve(model, plot, *size), stroke(index));
            }
        });
        // The curves fall: the corner at the top right is always free, and the largest sample is the
        // highest curve.
        let left = plot.rect.right() - LEGEND;
        for (index, (size, _)) in SIZES.iter().enumerate() {
            let Some(trials) = model.trials(*size, share) else {
                continue;
            };
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
}

/// Curves differ in dash as well as in hue.
fn stroke(index: usize) -> Stroke {
    let stroke = Stroke::solid(Role::Series(index as u8), 2.25);
    match index % 3 {
        0 => stroke,
        1 => stroke.dashed(),
        _ => stroke.dotted(),
    }
}

fn curve(model: &RansacBudget, plot: &Panel, size: usize) -> Vec<Place> {
    let steps = 0..=890;
    let shares = steps.map(|step| SHARES[0] + 0.001 * f64::from(step));
    let places = shares.filter_map(|share| {
        let trials = model.trials(size, share)?;
        Some(plot.canvas_from_world((share, libm::log10(trials as f64))))
    });
    places.collect()
}

fn draw_axes(plot: &Panel, canvas: &mut Canvas) {
    let rect = plot.rect;
    let muted = TextStyle::new(Role::Muted, SMALL);
    let grid = Stroke::solid(Role::Grid, 1.0);
    for (decade, text) in TICKS {
        let y = plot.canvas_from_world((0.5, decade)).1;
        canvas.line((rect.x + 1.0, y), (rect.right() - 1.0, y), grid);
        canvas.label((rect.x - 7.0, y), text, muted.end());
    }
    for percent in [20, 40, 60, 80] {
        let share = f64::from(percent) / 100.0;
        let x = plot.canvas_from_world((share, 0.0)).0;
        canvas.line((x, rect.y + 1.0), (x, rect.bottom() - 1.0), grid);
        let text = format!("{percent} %");
        canvas.label((x, rect.bottom() + 12.0), &text, muted.middle());
    }
    let ink = TextStyle::new(Role::Ink, TEXT);
    canvas.label((0.0, 12.0), "Samples needed, N", ink);
    let place = (rect.center().0, rect.bottom() + 32.0);
    canvas.label(place, "share of inliers, w", ink.middle());
}
