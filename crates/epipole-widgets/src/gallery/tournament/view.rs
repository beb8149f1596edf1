//! The success rate of each rival over the outlier ratio.

use super::model::Tournament;
use super::question::{NUM_RATIOS, outlier_ratio};
use super::rivals::{NUM_RIVALS, RIVALS};
use super::words::success;
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Layout, View};
use crate::kit::grid::{self, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::pair::series;
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;

/// Height of the plot with its numbers, CSS pixels.
const HEIGHT: f64 = 380.0;

/// Draws [`Tournament`].
#[derive(Default)]
pub(crate) struct TournamentView;

fn rulers() -> [Ruler; 2] {
    let ratio = Ruler::linear(-0.02, 0.82).shown(100.0, "%");
    let share = Ruler::linear(-0.03, 1.03).shown(100.0, "%");
    [ratio.named("outliers among the data"), share]
}

/// Returns a rival's color, shape and stroke, each unique.
fn look(rival: usize) -> (Role, Shape, Stroke) {
    let (role, shape) = series(rival);
    (role, shape, Stroke::of_series(rival, 2.25))
}

fn entries() -> Vec<Entry> {
    let swatch = |(role, shape, _)| Swatch::Marker(shape, role);
    let names = RIVALS.iter().enumerate();
    names
        .map(|(rival, (_, name, _))| (swatch(look(rival)), *name))
        .collect()
}

impl View for TournamentView {
    type Model = Tournament;

    fn layout(&self, _: &Tournament, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        // The legend is above the plot, since the runs' progress would cover it below.
        grid.strip(legend::height(&entries(), width, plot::LEFT));
        let [cell] = grid.shares([1.0], (0.42 * width + 90.0).min(HEIGHT));
        let [x, y] = rulers();
        grid.layout(vec![plot::panel("plot", cell, &x, &y).clickable()])
    }

    fn draw(&mut self, model: &Tournament, layout: &Layout, canvas: &mut Canvas) {
        let runs = format!("{} runs", model.num_runs());
        let full = format!("{runs}: fits {}", success(model.subject()));
        let titles = [&*full, &format!("Successes, {runs}")];
        let plot = plot::open(canvas, layout, "plot", &titles, &rulers());
        let (_, ratio) = model.ratio();
        plot::draw_now(canvas, plot, ratio);
        for rival in 0..NUM_RIVALS {
            let (role, shape, stroke) = look(rival);
            let places: Vec<(f64, f64)> = (0..NUM_RATIOS)
                .filter_map(|index| Some((outlier_ratio(index), model.share(rival, index)?)))
                .collect();
            plot::draw_curve(canvas, plot, places.iter().copied(), stroke);
            for place in places {
                canvas.marker(plot.canvas_from_world(place), 4.0, shape, role, true);
            }
        }
        legend::draw(canvas, &entries(), layout.width, plot::LEFT, 0.0);
        if let Some(problem) = model.asked.problem() {
            grid::notice(canvas, plot.rect, problem);
        }
    }
}
