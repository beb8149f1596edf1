//! Both photographs with the lines of the plane and the distances of p and p′ from them, and beside
//! them the sum of squares over the plane's angle.

use super::model::{Miss, OptimalPlane, REACH_DEG, State};
use super::words::NOTHING;
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::pair::{CAMERAS, Photos, draw_line};
use crate::kit::plot::{self, Ruler};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE};
use crate::theme::Role;
use epipole::math::Line2;

const MARKER: f64 = 5.0;
/// Height of the plot with its track if below the photographs, on a phone and on a page, CSS
/// pixels.
const PLOT: [f64; 2] = [128.0, 156.0];
/// Number of planes drawn faintly to either side, and the angle between them, degrees.
const NUM_FAINT: i32 = 4;
const FAINT_DEG: f64 = 4.0;
/// Number of steps of the curves.
const NUM_STEPS: i32 = 160;
/// Top of the plot, relative to the minimum sum of squares.
const TOP: f64 = 5.0;
const SUM: Stroke = Stroke::solid(Role::Ink, 2.25);
const BEST: Stroke = Stroke::solid(Role::Inlier, 1.75).dashed();
/// Gap between the panels and the legend, CSS pixels.
const LEGEND_GAP: f64 = 4.0;
const LEGEND: [Entry; 4] = [
    (Swatch::Line(squares(0)), "photograph 1"),
    (Swatch::Line(squares(1)), "photograph 2"),
    (Swatch::Line(SUM), "both"),
    (Swatch::Marker(Shape::Diamond, Role::Inlier), "least"),
];

/// Returns the style of the squared distance in a photograph.
const fn squares(index: usize) -> Stroke {
    Stroke::solid(CAMERAS[index].0, 1.75).dashed()
}

/// Draws [`OptimalPlane`].
#[derive(Default)]
pub(crate) struct OptimalPlaneView {
    photos: Photos,
}

fn rulers(state: Option<&State>) -> [Ruler; 2] {
    let least = state.map_or(100.0, |state| state.best.1.sum_sq().max(20.0));
    [
        Ruler::linear(-REACH_DEG, REACH_DEG).shown(1.0, "°"),
        Ruler::linear(0.0, TOP * least),
    ]
}

impl View for OptimalPlaneView {
    type Model = OptimalPlane;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &OptimalPlane, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (first, second, cell);
        if grid::is_broad(width) {
            [first, second, cell] = grid.row([PHOTO_ASPECT, PHOTO_ASPECT, 0.9], 404.0);
        } else {
            [first, second] = grid.row([PHOTO_ASPECT; 2], 254.0);
            [cell] = grid.shares([1.0], PLOT[usize::from(!grid::is_narrow(width))]);
        }
        grid.strip(LEGEND_GAP + legend::height(&LEGEND, width, 0.0));
        let [x, y] = rulers(model.state().as_ref());
        let [plot, track] = plot::panel_and_track("plot", cell, &x, &y);
        grid.layout(vec![
            Panel::photograph("first", first, PHOTO_SIZE),
            Panel::photograph("second", second, PHOTO_SIZE),
            plot,
            track,
        ])
    }

    fn draw(&mut self, model: &OptimalPlane, layout: &Layout, canvas: &mut Canvas) {
        let [first, second, plot, track] =
            layout.panels_named(["first", "second", "plot", "track"]);
        grid::open(canvas, first, &["Photograph 1"]);
        grid::open(canvas, second, &["Photograph 2"]);
        self.photos.draw(canvas, [first, second], &model.cameras());
        let state = model.state();
        let [x, y] = rulers(state.as_ref());
        plot::draw_axes(canvas, plot, &x, &y);
        plot::title_from_left(
            canvas,
            plot,
            &[
                "Squared misses over the plane's angle, px²",
                "Squared misses, px²",
                "px²",
            ],
        );
        match &state {
            Some(state) => {
                for (index, panel) in [first, second].into_iter().enumerate() {
                    canvas.clipped(panel.rect, |canvas| {
                        draw_photograph(model, state, index, panel, canvas);
                    });
                }
                draw_curves(state, plot, canvas);
            }
            None => grid::notice(canvas, second.rect, NOTHING),
        }
        legend::draw_last(canvas, &LEGEND, layout, 0.0, 1.0);
        plot::draw_now(canvas, plot, model.angle_deg());
        plot::draw_track(canvas, track, [-REACH_DEG, REACH_DEG], model.angle_deg());
    }

    fn prepare(&mut self, model: &OptimalPlane) -> bool {
        self.photos.prepare(&model.cameras())
    }

    fn refine(&mut self, model: &OptimalPlane) -> bool {
        self.photos.refine(&model.cameras())
    }
}

/// Draws lines of some planes faintly, those of the best one dashed and of the current one solid,
/// and the distance of the pixel from the latter.
fn draw_photograph(
    model: &OptimalPlane,
    state: &State,
    index: usize,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let line_at = |angle_deg: f64| -> Option<Line2> { Some(state.at(angle_deg)?.0[index]) };
    for step in -NUM_FAINT..=NUM_FAINT {
        if let Some(line) = line_at(f64::from(step) * FAINT_DEG) {
            draw_line(canvas, panel, &line, Stroke::solid(Role::Muted, 0.75));
        }
    }
    let (role, shape) = CAMERAS[index];
    if let Some(best) = line_at(state.best.0) {
        draw_line(canvas, panel, &best, BEST.cased());
    }
    let place = panel.place_of(&state.pixels[index]);
    if let Some(line) = line_at(model.angle_deg()) {
        draw_line(canvas, panel, &line, Stroke::solid(role, 2.0).cased());
        let foot = panel.place_of(&line.nearest(&state.pixels[index]));
        canvas.line(place, foot, Stroke::solid(Role::Outlier, 3.0).cased());
    }
    canvas.marker(place, MARKER, shape, role, true);
    let mut labels = Labels::new(panel.rect);
    labels.name(canvas, (place, 10.0), ["p", "p′"][index], (Role::Ink, TEXT));
}

/// Draws the squared distance in each photograph, their sum, and its minimum.
fn draw_curves(state: &State, panel: &Panel, canvas: &mut Canvas) {
    let curve = |value: &dyn Fn(Miss) -> f64| -> Vec<(f64, f64)> {
        let angles = (0..=NUM_STEPS)
            .map(|step| REACH_DEG * (2.0 * f64::from(step) / f64::from(NUM_STEPS) - 1.0));
        angles
            .filter_map(|angle| Some((angle, value(state.at(angle)?.1))))
            .collect()
    };
    for index in 0..CAMERAS.len() {
        let places = curve(&|miss| miss.px[index] * miss.px[index]);
        plot::draw_curve(canvas, panel, places, squares(index));
    }
    plot::draw_curve(canvas, panel, curve(&|miss| miss.sum_sq()), SUM);
    let (best_deg, best) = state.best;
    let place = panel.canvas_from_world((best_deg, best.sum_sq()));
    canvas.marker(place, 5.0, Shape::Diamond, Role::Inlier, true);
}
