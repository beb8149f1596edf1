//! A top view of the block with three paths, and beside it the scale of each frame.

mod map;
mod style;

use self::style::{AFTER, BEFORE, TRUTH};
use super::model::ScaleDrift;
use crate::canvas::{Canvas, Shape};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::plot::{self, Ruler, decade};
use crate::theme::Role;

/// Scale up to which the plot's axis extends at least, starting from 1/2.
const LEAST: f64 = 2.0;
/// Margin above and below the curves, in powers of ten.
const MARGIN: f64 = 0.06;
/// Gap between the panels and the legend, CSS pixels.
const LEGEND_GAP: f64 = 4.0;

/// Draws [`ScaleDrift`].
#[derive(Default)]
pub(crate) struct ScaleDriftView;

const LEGEND: [Entry; 3] = [
    (Swatch::Line(TRUTH), "truth"),
    (Swatch::Line(BEFORE), "odometry"),
    (Swatch::Line(AFTER), "loop closed"),
];

/// Returns the axes of the plot: frames, and the scale in powers of ten, in which uniform drift is
/// a straight line.
fn rulers(model: &ScaleDrift) -> [Ruler; 2] {
    // The whole drive, so that the axes do not change while the camera moves.
    let scales = model.drive.scale.iter();
    let closed = model.after().into_iter().flat_map(|after| &after.scale);
    let least = decade(LEAST);
    let (low, high) = (scales.chain(closed).map(|scale| decade(*scale)))
        .fold((-least, least), |(low, high), at| {
            (low.min(at), high.max(at))
        });
    let steps = model.num_steps() as f64;
    [
        Ruler::linear(-0.03 * steps, 1.06 * steps).named("frame"),
        Ruler::decades(low - MARGIN, high + MARGIN),
    ]
}

impl View for ScaleDriftView {
    type Model = ScaleDrift;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &ScaleDrift, width: f64) -> Layout {
        let (shares, height) = match width {
            width if grid::is_narrow(width) => ([1.3, 1.0], 268.0),
            width if grid::is_broad(width) => ([1.5, 1.0], 412.0),
            _ => ([1.3, 1.0], 358.0),
        };
        let mut grid = Grid::new(width);
        let [left, right] = grid.shares(shares, height);
        grid.strip(LEGEND_GAP + legend::height(&LEGEND, width, 0.0));
        let [x, y] = rulers(model);
        let [plot, track] = plot::panel_and_track("plot", right, &x, &y);
        grid.layout(vec![map::panel(model, left), plot, track])
    }

    fn draw(&mut self, model: &ScaleDrift, layout: &Layout, canvas: &mut Canvas) {
        let [map, plot, track] = layout.panels_named(["map", "plot", "track"]);
        canvas.panel(map.rect);
        grid::fitting_title(
            canvas,
            map.rect,
            &["Around a block, seen from above", "From above"],
        );
        map::draw(model, map, canvas);
        draw_plot(model, [plot, track], canvas);
        let top = map.rect.bottom() + LEGEND_GAP;
        legend::draw(canvas, &LEGEND, layout.width, 0.0, top);
        if let Some(problem) = model.asked.problem() {
            grid::notice(canvas, map.rect, problem);
        }
    }
}

fn draw_plot(model: &ScaleDrift, [plot, track]: [&Panel; 2], canvas: &mut Canvas) {
    let [x, y] = rulers(model);
    plot::draw_axes(canvas, plot, &x, &y);
    plot::title_from_left(canvas, plot, &["Scale of each frame", "Scale"]);
    let places = |scales: &[f64]| -> Vec<(f64, f64)> {
        let scales = scales.iter().enumerate();
        scales
            .map(|(frame, scale)| (frame as f64, decade(*scale)))
            .collect()
    };
    let traveled = model.traveled() as f64;
    plot::draw_now(canvas, plot, traveled);
    if let Some(after) = model.after() {
        plot::draw_curve(canvas, plot, places(&after.scale), AFTER);
    }
    let before = places(&model.before.scale);
    let end = before.last().copied();
    plot::draw_curve(canvas, plot, before, BEFORE);
    plot::draw_curve(canvas, plot, [(0.0, 0.0), (plot.x_axis.end, 0.0)], TRUTH);
    if let Some(end) = end {
        canvas.marker(
            plot.canvas_from_world(end),
            5.0,
            Shape::Square,
            Role::Series(1),
            true,
        );
    }
    plot::draw_track(canvas, track, [0.0, model.num_steps() as f64], traveled);
}
