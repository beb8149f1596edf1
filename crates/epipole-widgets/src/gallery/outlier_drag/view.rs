//! Both photographs with the matches and the lines of F; beside them the singular values, and how far the
//! true matches are from their lines as the wrong one is led away.

use super::fit::{Led, REACH_PX, line2};
use super::model::{OutlierDrag, State};
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, SMALL, TEXT};
use crate::kit::labels::Labels;
use crate::kit::matches::cameras;
use crate::kit::pair::draw_line;
use crate::kit::photo::Photo;
use crate::kit::plot::{self, Ruler};
use crate::kit::scenes::{PHOTO_SIZE, still_life};
use crate::theme::Role;

const MARKER: f64 = 4.5;
/// Height over width of the photographs.
const ASPECT: f64 = 0.75;
/// So many true matches have their line drawn; more would hide the photograph.
const NUM_LINES: usize = 8;
const DECADES: [f64; 2] = [-1.2, 2.2];
const MEAN: Role = Role::Series(0);
const WORST: Role = Role::Series(3);

/// Draws [`OutlierDrag`].
#[derive(Default)]
pub(crate) struct OutlierDragView {
    photos: [Photo; 2],
}

fn value_rulers() -> [Ruler; 2] {
    let names = &["σ₁", "σ₂", "σ₃", "σ₄", "σ₅", "σ₆", "σ₇", "σ₈", "σ₉"];
    [Ruler::things(names), Ruler::decades(-3.0, 1.3)]
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
        let [first, second, led, values] =
            grid.photographs_and_two(ASPECT, [[1.0, 1.0], [1.0, 1.0]]);
        let (columns, rows) = PHOTO_SIZE;
        let ([x, y], [k, sigma]) = (led_rulers(), value_rulers());
        grid.layout(vec![
            Panel::photograph("first", first, (columns, rows)),
            Panel::photograph("second", second, (columns, rows)),
            plot::panel("led", led, &x, &y),
            plot::panel("values", values, &k, &sigma),
        ])
    }

    fn draw(&mut self, model: &OutlierDrag, layout: &Layout, canvas: &mut Canvas) {
        let [first, second, led, values] =
            layout.panels_named(["first", "second", "led", "values"]);
        grid::open(
            canvas,
            first,
            &["Photograph 1: the matches", "Photograph 1"],
        );
        grid::open(
            canvas,
            second,
            &[
                "Photograph 2: drag the wrong match",
                "2: drag the wrong one",
            ],
        );
        let titles = [
            "True matches to their lines, px, as it moves away",
            "Off their lines, px",
            "Off, px",
        ];
        grid::open(canvas, led, &titles);
        grid::open(
            canvas,
            values,
            &["Singular values of the rows", "Singular values"],
        );
        let scene = still_life();
        for ((photo, camera), panel) in self.photos.iter_mut().zip(cameras()).zip([first, second]) {
            match photo.picture(&scene, &camera, [0.0; 3], PHOTO_SIZE) {
                Ok(picture) => canvas.photograph(panel.rect, picture),
                Err(error) => grid::notice(canvas, panel.rect, &error.to_string()),
            }
        }
        let ([x, y], [k, sigma]) = (led_rulers(), value_rulers());
        plot::draw_axes(canvas, led, &x, &y);
        plot::draw_axes(canvas, values, &k, &sigma);
        match model.state() {
            Ok(state) => {
                canvas.clipped(first.rect, |canvas| draw_first(state, first, canvas));
                canvas.clipped(second.rect, |canvas| {
                    draw_second(model, state, second, canvas)
                });
                draw_led(model, state, led, canvas);
                draw_values(model, state, values, canvas);
            }
            Err(sentence) => grid::notice(canvas, second.rect, sentence),
        }
    }

    fn refine(&mut self, _: &OutlierDrag) -> bool {
        let scene = still_life();
        let mut photos = self.photos.iter_mut().zip(cameras());
        photos.any(|(photo, camera)| photo.refine(&scene, &camera, [0.0; 3], PHOTO_SIZE))
    }
}

fn draw_first(state: &State, panel: &Panel, canvas: &mut Canvas) {
    for (pixel1, _) in &state.truth {
        let place = panel.canvas_from_world((pixel1.x, pixel1.y));
        canvas.marker(place, MARKER, Shape::Disk, Role::Inlier, true);
    }
    let place = panel.canvas_from_world((state.wrong.0.x, state.wrong.0.y));
    canvas.marker(place, MARKER + 2.5, Shape::Cross, Role::Outlier, true);
}

fn draw_second(model: &OutlierDrag, state: &State, panel: &Panel, canvas: &mut Canvas) {
    let at = |x: f64, y: f64| panel.canvas_from_world((x, y));
    for (index, (pixel1, pixel2)) in state.truth.iter().enumerate() {
        let Some(line) = line2(&state.fit.fundamental, pixel1) else {
            continue;
        };
        if index < NUM_LINES {
            draw_line(canvas, panel, &line, Stroke::solid(MEAN, 1.25).cased());
        }
        // How far it is off: from the match square to its line.
        let foot = line.nearest(pixel2);
        let off = Stroke::solid(WORST, 2.5).cased();
        canvas.line(at(pixel2.x, pixel2.y), at(foot.x, foot.y), off);
    }
    for (_, pixel2) in &state.truth {
        canvas.marker(
            at(pixel2.x, pixel2.y),
            MARKER,
            Shape::Disk,
            Role::Inlier,
            true,
        );
    }
    let wrong = &state.wrong;
    if let Some(line) = line2(&state.fit.fundamental, &wrong.0) {
        let stroke = Stroke::solid(Role::Outlier, 2.0).dashed().cased();
        draw_line(canvas, panel, &line, stroke);
    }
    let (right, place) = (
        at(state.right.1.x, state.right.1.y),
        at(wrong.1.x, wrong.1.y),
    );
    if model.away_px() > 1.0 {
        canvas.arrow(right, place, Stroke::solid(Role::Outlier, 2.0).cased());
        canvas.hollow_marker(right, MARKER, Shape::Diamond, Role::Outlier, true);
    }
    canvas.grip(place, Role::Grip);
    let mut labels = Labels::new(panel.rect);
    for (_, pixel2) in &state.truth {
        labels.keep_free(at(pixel2.x, pixel2.y), MARKER + 2.0);
    }
    labels.keep_free(place, 10.0);
    labels.keep_free(right, 7.0);
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    labels.draw(canvas, &Labels::around(place, 11.0), "wrong match", style);
    if model.away_px() > 40.0 {
        labels.draw(canvas, &Labels::around(right, 8.0), "belongs here", style);
    }
}

/// Mean and worst distance of the true matches over how far the wrong one is led away.
fn draw_led(model: &OutlierDrag, state: &State, panel: &Panel, canvas: &mut Canvas) {
    let mut labels = Labels::new(panel.rect.inset(2.0));
    let curve = |get: fn(&Led) -> f64| {
        let places = state
            .led
            .iter()
            .map(move |led| (led.away_px, plot::decade(get(led))));
        places.map(|(x, y)| (x, y.clamp(DECADES[0], DECADES[1])))
    };
    let mean: Vec<_> = curve(|led| led.mean_px).collect();
    let worst: Vec<_> = curve(|led| led.worst_px).collect();
    plot::draw_curve(
        canvas,
        panel,
        mean.iter().copied(),
        Stroke::solid(MEAN, 2.5),
    );
    plot::draw_curve(
        canvas,
        panel,
        worst.iter().copied(),
        Stroke::solid(WORST, 2.0).dashed(),
    );
    let away_px = model.away_px().min(REACH_PX);
    plot::draw_now(canvas, panel, away_px);
    for (value, role) in [(state.fit.mean_px, MEAN), (state.fit.worst_px, WORST)] {
        let decade = plot::decade(value).clamp(DECADES[0], DECADES[1]);
        let place = panel.canvas_from_world((away_px, decade));
        canvas.marker(place, 4.5, Shape::Disk, role, true);
        labels.keep_free(place, 7.0);
    }
    let names = [(&mean, "mean", MEAN, 22), (&worst, "worst", WORST, 22)];
    for (places, name, role, index) in names {
        for place in places.iter() {
            labels.keep_free(panel.canvas_from_world(*place), 2.0);
        }
        if let Some(place) = places.get(index) {
            let style = TextStyle::new(role, SMALL).cased();
            let anchor = panel.canvas_from_world(*place);
            labels.draw(canvas, &Labels::around(anchor, 6.0), name, style);
        }
    }
}

/// The singular values with the wrong match and without.
fn draw_values(model: &OutlierDrag, state: &State, panel: &Panel, canvas: &mut Canvas) {
    let lists = [
        (
            &state.without.singular_values,
            Role::Inlier,
            Shape::Disk,
            "without",
        ),
        (
            &state.fit.singular_values,
            Role::Outlier,
            Shape::Square,
            "with it",
        ),
    ];
    let mut labels = Labels::new(panel.rect.inset(2.0));
    let mut texts = Vec::new();
    // Left out, both lists are the same.
    for (values, role, shape, name) in lists.into_iter().take(1 + usize::from(model.is_heard())) {
        let [low, high] = [panel.y_axis.end, panel.y_axis.start];
        let places: Vec<(f64, f64)> = (values.iter().enumerate())
            .map(|(k, value)| (k as f64 + 1.0, plot::decade(*value).clamp(low, high)))
            .collect();
        let stroke = Stroke::solid(role, 2.0);
        let stroke = if role == Role::Inlier {
            stroke
        } else {
            stroke.dashed()
        };
        plot::draw_curve(canvas, panel, places.iter().copied(), stroke);
        for place in &places {
            let (x, y) = panel.canvas_from_world(*place);
            let y = y.min(panel.rect.bottom() - 5.0).max(panel.rect.y + 5.0);
            canvas.marker((x, y), 4.0, shape, role, false);
            labels.keep_free((x, y), 6.0);
        }
        texts.push((panel.canvas_from_world(places[8]), name, role));
    }
    for (anchor, text, role) in texts {
        let style = TextStyle::new(role, SMALL).cased();
        labels.draw(canvas, &Labels::around(anchor, 8.0), text, style);
    }
}
