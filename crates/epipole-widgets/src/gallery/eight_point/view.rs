//! Both photographs with the matches and their lines; below, an enlarged view of the lines'
//! intersection, and the singular values.

use super::estimate::Estimate;
use super::model::EightPoint;
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, SMALL, TEXT};
use crate::kit::labels::Labels;
use crate::kit::matches::line2;
use crate::kit::pair::{border_arrow, draw_line, series};
use crate::kit::plan;
use crate::kit::plot::{self, List, Ruler};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE};
use crate::theme::Role;
use epipole::epipolar::Epipole;
use image::RgbImage;
use nalgebra::Point2;

const MARKER: f64 = 5.0;
/// Maximum number of matches with a line; more would hide the photograph.
const NUM_LINES: usize = 10;
/// Half widths of the enlarged view, pixels of photograph 2; the first one that suffices is used.
const NEAR_PX: [f64; 6] = [5.0, 10.0, 20.0, 50.0, 100.0, 200.0];

/// Draws [`EightPoint`].
#[derive(Default)]
pub struct EightPointView;

fn rulers() -> [Ruler; 2] {
    [Ruler::things(plot::SIGMAS), Ruler::decades(-3.2, 6.6)]
}

impl View for EightPointView {
    type Model = EightPoint;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &EightPoint, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let shares = [[1.0, 1.15], [0.8, 1.0]];
        let [first, second, meeting, values] = grid.photographs_and_two(PHOTO_ASPECT, shares);
        let (place, half_width) = enlarged(model);
        // The same scale along the rows as along the columns.
        let half_height = half_width * meeting.height / meeting.width;
        let around = |middle: f64, half: f64| [middle - half, middle + half];
        let (columns, rows) = (around(place.x, half_width), around(place.y, half_height));
        let [x, y] = rulers();
        grid.layout(vec![
            Panel::photograph("first", first, PHOTO_SIZE).clickable(),
            Panel::photograph("second", second, PHOTO_SIZE),
            Panel::new("meeting", meeting, columns, rows),
            plot::panel("values", values, &x, &y),
        ])
    }

    fn photograph(&mut self, model: &EightPoint, panel: &str) -> Option<RgbImage> {
        let index = ["first", "second"].iter().position(|&name| name == panel)?;
        Some(model.photographs().ok()?[index].image().clone())
    }

    fn draw(&mut self, model: &EightPoint, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 4] = [
            ("first", &["Photograph 1: drag the probe", "Photograph 1"]),
            (
                "second",
                &["Photograph 2: lines by the F found", "Photograph 2"],
            ),
            (
                "meeting",
                &[
                    "Where the lines meet, enlarged",
                    "Where lines meet",
                    "Meeting",
                ],
            ),
            (
                "values",
                &["Singular values of the rows", "Singular values", "Values"],
            ),
        ];
        let [first, second, meeting, values] = grid::open_all(canvas, layout, titles);
        let [x, y] = rulers();
        plot::draw_axes(canvas, values, &x, &y);
        let problem = match model.photographs() {
            Ok(photographs) => {
                canvas.photograph(first.rect, photographs[0].image());
                canvas.photograph(second.rect, photographs[1].image());
                None
            }
            Err(problem) => Some(problem),
        };
        match model.estimate() {
            Ok(estimate) => {
                canvas.clipped(first.rect, |canvas| {
                    draw_first(model, estimate, first, canvas)
                });
                canvas.clipped(second.rect, |canvas| {
                    draw_second(model, estimate, second, canvas)
                });
                canvas.clipped(meeting.rect.inset(1.0), |canvas| {
                    draw_meeting(model, estimate, meeting, canvas);
                });
                draw_values(model, estimate, values, canvas);
            }
            Err(sentence) => grid::notice(canvas, second.rect, sentence),
        }
        if let Some(problem) = problem {
            grid::notice(canvas, first.rect, problem);
        }
    }
}

/// Returns center and half width of the enlarged view in photograph 2, pixels.
fn enlarged(model: &EightPoint) -> (Point2<f64>, f64) {
    let estimate = model.estimate().ok();
    let Some(meeting) = estimate.and_then(|estimate| estimate.meeting) else {
        return (Point2::origin(), NEAR_PX[0]);
    };
    let enough = NEAR_PX.iter().find(|&&near| near >= 3.0 * meeting.miss_px);
    (
        meeting.place,
        *enough.unwrap_or(&NEAR_PX[NEAR_PX.len() - 1]),
    )
}

fn draw_first(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    for (index, (pixel1, _)) in estimate.used.iter().enumerate().rev() {
        draw_match(canvas, panel.place_of(pixel1), index);
    }
    let probe = model.probe();
    canvas.grip(panel.place_of(&probe), Role::Grip);
}

/// Draws a match, smaller if it has no line.
fn draw_match(canvas: &mut Canvas, place: Place, index: usize) {
    if index < NUM_LINES {
        let (role, shape) = series(index);
        canvas.marker(place, MARKER, shape, role, true);
    } else {
        canvas.marker(place, 2.5, Shape::Disk, Role::Ink, true);
    }
}

fn draw_second(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    draw_lines(estimate, panel, canvas, true);
    for (index, (_, pixel2)) in estimate.used.iter().enumerate().rev() {
        draw_match(canvas, panel.place_of(pixel2), index);
    }
    let probe = model.probe();
    if let Some(line) = line2(&estimate.fundamental, &probe) {
        draw_line(canvas, panel, &line, Stroke::solid(Role::Grip, 3.0).cased());
    }
    if let Some(pixel2) = model.probe_match() {
        let place = panel.place_of(&pixel2);
        canvas.marker(place, 6.5, Shape::Ring, Role::Grip, true);
        canvas.marker(place, 2.0, Shape::Disk, Role::Grip, true);
        let mut labels = Labels::new(panel.rect);
        labels.keep_free(place, 9.0);
        labels.name(canvas, (place, 11.0), "true match", (Role::Ink, TEXT));
    }
}

fn draw_lines(estimate: &Estimate, panel: &Panel, canvas: &mut Canvas, cased: bool) {
    for (index, (pixel1, _)) in estimate.used.iter().take(NUM_LINES).enumerate() {
        if let Some(line) = line2(&estimate.fundamental, pixel1) {
            let stroke = Stroke {
                cased,
                ..Stroke::solid(series(index).0, 1.5)
            };
            draw_line(canvas, panel, &line, stroke);
        }
    }
}

/// Draws the lines around their intersection, and the true epipole.
fn draw_meeting(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    if estimate.meeting.is_none() {
        return grid::notice(canvas, panel.rect, "The lines are nearly parallel.");
    }
    draw_lines(estimate, panel, canvas, false);
    let mut labels = Labels::new(panel.rect.inset(2.0));
    plan::draw_rule(canvas, panel, |length| {
        format!("{} px", format_number(length, usize::from(length < 1.0)))
    });
    let lower = panel.rect.bottom() - 24.0;
    labels.keep_rect_free(Rect::new(panel.rect.x, lower, panel.rect.width, 24.0));
    let style = TextStyle::new(Role::Ink, SMALL).cased();
    if let Some(Epipole::Finite(truth)) = model.true_epipole2() {
        let place = panel.place_of(&truth);
        if panel.rect.contains(place) {
            canvas.marker(place, 6.0, Shape::Plus, Role::Truth, true);
            labels.keep_free(place, 8.0);
            labels.name(canvas, (place, 9.0), "true epipole", (Role::Ink, SMALL));
        } else if let Some((from, to)) = border_arrow(panel.rect, place) {
            canvas.arrow(from, to, Stroke::solid(Role::Truth, 2.5).cased());
            let away_px = libm::hypot(place.0 - to.0, place.1 - to.1) / panel.scale_x();
            let text = format!("truth: {} px", format_number(away_px, 0));
            labels.keep_free(from, 6.0);
            // Beside the arrow, or farther away if the scale bar is there.
            let places = [9.0, 26.0].map(|distance| Labels::around(from, distance));
            labels.draw(canvas, places.as_flattened(), &text, style);
        }
    }
}

/// Draws both lists of singular values on a logarithmic axis.
fn draw_values(model: &EightPoint, estimate: &Estimate, panel: &Panel, canvas: &mut Canvas) {
    let [raw, normalized] = estimate.singular_values();
    // The list in use is drawn thicker.
    let list = |values, is_chosen: bool, role, shape, name| List {
        values,
        stroke: Stroke::solid(role, if is_chosen { 2.5 } else { 1.25 }),
        mark: (shape, if is_chosen { 4.5 } else { 3.5 }),
        name,
    };
    let is_normalized = model.is_normalized();
    let mut lists = [
        list(
            raw,
            !is_normalized,
            Role::Outlier,
            Shape::Square,
            ("raw pixels", 3),
        ),
        list(
            normalized,
            is_normalized,
            Role::Inlier,
            Shape::Disk,
            ("normalized", 4),
        ),
    ];
    lists[0].stroke = lists[0].stroke.dashed();
    plot::draw_lists(canvas, panel, &lists);
}
