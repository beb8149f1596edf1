//! Both photographs with the matches and the lines of F; beside them the singular values, and the
//! residuals of the true matches over the displacement of the wrong one.

use super::fit::{Fit, REACH_PX};
use super::model::{OutlierDrag, State};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, SMALL, TEXT};
use crate::kit::labels::Labels;
use crate::kit::matches::{cameras, line2};
use crate::kit::pair::{Photos, draw_line};
use crate::kit::plot::{self, List, Ruler};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE};
use crate::theme::Role;

const MARKER: f64 = 4.5;
/// Maximum number of true matches with a line; more would hide the photograph.
const NUM_LINES: usize = 8;
const DECADES: [f64; 2] = [-1.2, 2.2];
/// Index of the displacement at which the curves are labeled.
const NAMED: usize = 22;
const MEAN: Role = Role::Series(0);
const WORST: Role = Role::Series(3);

/// Draws [`OutlierDrag`].
#[derive(Default)]
pub(crate) struct OutlierDragView {
    photos: Photos,
}

fn value_rulers() -> [Ruler; 2] {
    [Ruler::things(plot::SIGMAS), Ruler::decades(-3.0, 1.3)]
}

fn led_rulers() -> [Ruler; 2] {
    [
        Ruler::linear(0.0, REACH_PX).shown(1.0, " px"),
        Ruler::decades(DECADES[0], DECADES[1]),
    ]
}

impl View for OutlierDragView {
    type Model = OutlierDrag;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &OutlierDrag, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [first, second, led, values] = grid.photographs_and_two(PHOTO_ASPECT, [[1.0; 2]; 2]);
        let ([x, y], [k, sigma]) = (led_rulers(), value_rulers());
        grid.layout(vec![
            Panel::photograph("first", first, PHOTO_SIZE),
            Panel::photograph("second", second, PHOTO_SIZE),
            plot::panel("led", led, &x, &y),
            plot::panel("values", values, &k, &sigma),
        ])
    }

    fn draw(&mut self, model: &OutlierDrag, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 4] = [
            ("first", &["Photograph 1: the matches", "Photograph 1"]),
            (
                "second",
                &[
                    "Photograph 2: drag the wrong match",
                    "2: drag the wrong one",
                ],
            ),
            (
                "led",
                &[
                    "True matches to their lines, px, as it moves away",
                    "Off their lines, px",
                    "Off, px",
                ],
            ),
            (
                "values",
                &["Singular values of the rows", "Singular values"],
            ),
        ];
        let [first, second, led, values] = grid::open_all(canvas, layout, titles);
        self.photos.draw(canvas, [first, second], &cameras());
        let ([x, y], [k, sigma]) = (led_rulers(), value_rulers());
        plot::draw_axes(canvas, led, &x, &y);
        plot::draw_axes(canvas, values, &k, &sigma);
        let state = match model.state() {
            Ok(state) => state,
            Err(sentence) => return grid::notice(canvas, second.rect, sentence),
        };
        canvas.clipped(first.rect, |canvas| draw_first(state, first, canvas));
        canvas.clipped(second.rect, |canvas| {
            draw_second(model, state, second, canvas)
        });
        draw_led(model, state, led, canvas);
        draw_values(model, state, values, canvas);
    }

    fn prepare(&mut self, _: &OutlierDrag) -> bool {
        self.photos.prepare(&cameras())
    }

    fn refine(&mut self, _: &OutlierDrag) -> bool {
        self.photos.refine(&cameras())
    }
}

fn draw_first(state: &State, panel: &Panel, canvas: &mut Canvas) {
    for (pixel1, _) in &state.truth {
        let place = panel.place_of(pixel1);
        canvas.marker(place, MARKER, Shape::Disk, Role::Inlier, true);
    }
    let place = panel.place_of(&state.wrong.0);
    canvas.marker(place, MARKER + 2.5, Shape::Cross, Role::Outlier, true);
}

fn draw_second(model: &OutlierDrag, state: &State, panel: &Panel, canvas: &mut Canvas) {
    for (index, (pixel1, pixel2)) in state.truth.iter().enumerate() {
        let Some(line) = line2(&state.fit.fundamental, pixel1) else {
            continue;
        };
        if index < NUM_LINES {
            draw_line(canvas, panel, &line, Stroke::solid(MEAN, 1.25).cased());
        }
        // The residual, perpendicular from the match to its line.
        let [from, to] = [*pixel2, line.nearest(pixel2)].map(|pixel| panel.place_of(&pixel));
        canvas.line(from, to, Stroke::solid(WORST, 2.5).cased());
    }
    let mut labels = Labels::new(panel.rect);
    for (_, pixel2) in &state.truth {
        let place = panel.place_of(pixel2);
        canvas.marker(place, MARKER, Shape::Disk, Role::Inlier, true);
        labels.keep_free(place, MARKER + 2.0);
    }
    let stroke = Stroke::solid(Role::Outlier, 2.0).cased();
    if let Some(line) = line2(&state.fit.fundamental, &state.wrong.0) {
        draw_line(canvas, panel, &line, stroke.dashed());
    }
    let [right, place] = [state.right.1, state.wrong.1].map(|pixel| panel.place_of(&pixel));
    if model.away_px() > 1.0 {
        canvas.arrow(right, place, stroke);
        canvas.hollow_marker(right, MARKER, Shape::Diamond, Role::Outlier, true);
    }
    canvas.grip(place, Role::Grip);
    labels.keep_free(place, 10.0);
    labels.keep_free(right, 7.0);
    let ink = (Role::Ink, TEXT);
    labels.name(canvas, (place, 11.0), "wrong match", ink);
    if model.away_px() > 40.0 {
        labels.name(canvas, (right, 8.0), "belongs here", ink);
    }
}

/// Draws mean and worst residual of the true matches over the displacement of the wrong one.
fn draw_led(model: &OutlierDrag, state: &State, panel: &Panel, canvas: &mut Canvas) {
    let away_px = model.away_px().min(REACH_PX);
    let world =
        |away_px: f64, off_px: f64| (away_px, plot::decade(off_px).clamp(DECADES[0], DECADES[1]));
    let curve = |get: fn(&Fit) -> f64| -> Vec<(f64, f64)> {
        let led = state.led().iter();
        led.map(|(away_px, fit)| world(*away_px, get(fit)))
            .collect()
    };
    let curves = [
        (curve(|fit| fit.mean_px), "mean", Stroke::solid(MEAN, 2.5)),
        (
            curve(|fit| fit.worst_px),
            "worst",
            Stroke::solid(WORST, 2.0).dashed(),
        ),
    ];
    for (places, _, stroke) in &curves {
        plot::draw_curve(canvas, panel, places.iter().copied(), *stroke);
    }
    plot::draw_now(canvas, panel, away_px);
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for (off_px, role) in [(state.fit.mean_px, MEAN), (state.fit.worst_px, WORST)] {
        let place = panel.canvas_from_world(world(away_px, off_px));
        canvas.marker(place, 4.5, Shape::Disk, role, true);
        labels.keep_free(place, 7.0);
    }
    for pair in curves.iter().flat_map(|(places, ..)| places.windows(2)) {
        let [from, to] = [pair[0], pair[1]].map(|place| panel.canvas_from_world(place));
        labels.keep_line_free(from, to);
    }
    for (places, name, stroke) in &curves {
        if let Some(place) = places.get(NAMED) {
            let place = panel.canvas_from_world(*place);
            labels.name(canvas, (place, 6.0), name, (stroke.role, SMALL));
        }
    }
}

/// Draws the singular values with and without the wrong match.
fn draw_values(model: &OutlierDrag, state: &State, panel: &Panel, canvas: &mut Canvas) {
    let without = List {
        values: &state.without.singular_values,
        stroke: Stroke::solid(Role::Inlier, 2.0),
        mark: (Shape::Disk, 4.0),
        name: ("without", 8),
    };
    let with = List {
        values: &state.fit.singular_values,
        stroke: Stroke::solid(Role::Outlier, 2.0).dashed(),
        mark: (Shape::Square, 4.0),
        name: ("with it", 8),
    };
    // Both lists are equal if the wrong match is excluded.
    let lists = [without, with];
    let count = if model.is_heard() { 2 } else { 1 };
    plot::draw_lists(canvas, panel, &lists[..count]);
}
