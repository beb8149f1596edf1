//! Two photographs, points in the first, lines in the second.

use super::model::EpipolarClick;
use super::words::NO_BASELINE;
use crate::canvas::{Canvas, Place, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::geometry::Geometry;
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::{Photos, border_arrow, draw_epipole, draw_line, series};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE, Seen};
use crate::theme::Role;
use image::RgbImage;

const MARKER: f64 = 5.5;
/// Radius of the guess, CSS pixels.
const GUESS_RADIUS: f64 = 10.0;
/// Maximum height of a photograph, CSS pixels, to leave room for the rest.
const TALLEST: f64 = 430.0;

/// Draws [`EpipolarClick`].
#[derive(Default)]
pub(crate) struct EpipolarClickView {
    photos: Photos,
}

impl View for EpipolarClickView {
    type Model = EpipolarClick;

    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &EpipolarClick, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [first, second] = grid.row([PHOTO_ASPECT; 2], TALLEST);
        let mut second = Panel::photograph("second", second, PHOTO_SIZE);
        if model.guess().is_some() {
            second = second.clickable();
        }
        grid.layout(vec![
            Panel::photograph("first", first, PHOTO_SIZE).clickable(),
            second,
        ])
    }

    fn photograph(&mut self, model: &EpipolarClick, panel: &str) -> Option<RgbImage> {
        let index = ["first", "second"].iter().position(|&name| name == panel)?;
        let picture = self.photos.picture(index, &model.cameras()[index]);
        picture.ok().cloned()
    }

    fn draw(&mut self, model: &EpipolarClick, layout: &Layout, canvas: &mut Canvas) {
        let [first, second] = layout.panels_named(["first", "second"]);
        let second_titles = match model.shows_lines() {
            true => [
                "Photograph 2: its match is on its line",
                "2: matches on lines",
            ],
            false => ["Photograph 2: guess the match", "2: guess the match"],
        };
        let titles = [
            ["Photograph 1: click or drag a point", "1: click or drag"],
            second_titles,
        ];
        for (panel, titles) in [first, second].into_iter().zip(titles) {
            grid::fitting_title(canvas, panel.rect, &titles);
        }
        self.photos.draw(canvas, [first, second], &model.cameras());
        let geometry = model.geometry();
        let shown = geometry.as_ref().filter(|_| model.shows_lines());
        canvas.clipped(first.rect, |canvas| {
            draw_first(model, shown, first, canvas);
        });
        canvas.clipped(second.rect, |canvas| {
            if model.shows_lines() {
                draw_second(model, shown, second, canvas);
            }
            if let Some(guess) = model.guess() {
                draw_guess(model, second.place_of(&guess), canvas);
            }
        });
        if geometry.is_none() {
            grid::notice(canvas, second.rect, NO_BASELINE);
        }
    }

    fn prepare(&mut self, model: &EpipolarClick) -> bool {
        self.photos.prepare(&model.cameras())
    }

    fn refine(&mut self, model: &EpipolarClick) -> bool {
        self.photos.refine(&model.cameras())
    }
}

/// Draws the points, and through each the faint line of all points with the same epipolar line.
fn draw_first(
    model: &EpipolarClick,
    geometry: Option<&Geometry>,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let mut labels = Labels::new(panel.rect);
    for (index, point) in model.points() {
        if let Some(line) = geometry.and_then(|geometry| geometry.line1(&point)) {
            let stroke = Stroke::solid(series(index).0, 1.25).dotted();
            let (from, to) = draw_line(canvas, panel, &line, stroke);
            labels.keep_line_free(from, to);
        }
    }
    for (index, point) in model.points() {
        let (role, shape) = series(index);
        let place = panel.place_of(&point);
        draw_selection(model, index, place, canvas);
        canvas.marker(place, MARKER, shape, role, true);
        labels.keep_free(place, MARKER + 3.0);
    }
    if let Some(geometry) = geometry {
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole1, "e");
    }
    for (index, point) in model.points() {
        let place = panel.place_of(&point);
        draw_number(canvas, &mut labels, place, index, "");
    }
}

/// Draws the epipolar lines, and on each the match.
fn draw_second(
    model: &EpipolarClick,
    geometry: Option<&Geometry>,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let mut labels = Labels::new(panel.rect);
    for (index, point) in model.points() {
        if let Some(line) = geometry.and_then(|geometry| geometry.line2(&point)) {
            let width = if is_selected(model, index) { 2.5 } else { 1.75 };
            let stroke = Stroke::solid(series(index).0, width).cased();
            let (from, to) = draw_line(canvas, panel, &line, stroke);
            labels.keep_line_free(from, to);
        }
    }
    let mut texts = Vec::new();
    for (index, point) in model.points() {
        let (role, shape) = series(index);
        let found = model.seen(&point);
        let Some(pixel) = found.pixel() else { continue };
        let place = panel.place_of(&pixel);
        if let Seen::Outside(_) = found {
            if let Some((from, to)) = border_arrow(panel.rect, place) {
                canvas.arrow(from, to, Stroke::solid(role, 2.5).cased());
                texts.push((index, from, " is outside".to_owned()));
            }
            continue;
        }
        draw_selection(model, index, place, canvas);
        labels.keep_free(place, MARKER + 3.0);
        if let Seen::Hidden(_, by) = found {
            canvas.hollow_marker(place, MARKER, shape, role, true);
            texts.push((index, place, format!(" hidden by {by}")));
        } else {
            canvas.marker(place, MARKER, shape, role, true);
            texts.push((index, place, String::new()));
        }
    }
    if let Some(geometry) = geometry {
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole2, "e′");
    }
    for (index, place, text) in texts {
        draw_number(canvas, &mut labels, place, index, &text);
    }
}

/// Draws a crosshair in the color of the selected point.
fn draw_guess(model: &EpipolarClick, place: Place, canvas: &mut Canvas) {
    let role = model
        .selected()
        .map_or(Role::Grip, |(index, _)| series(index).0);
    let stroke = Stroke::solid(role, 2.0).cased();
    canvas.circle(place, GUESS_RADIUS, stroke);
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let at = |radius: f64| (place.0 + radius * x, place.1 + radius * y);
        canvas.line(at(0.4 * GUESS_RADIUS), at(1.6 * GUESS_RADIUS), stroke);
    }
}

fn is_selected(model: &EpipolarClick, index: usize) -> bool {
    model.selected().map(|(selected, _)| selected) == Some(index)
}

/// Draws a ring around the point shown in the readouts.
fn draw_selection(model: &EpipolarClick, index: usize, place: Place, canvas: &mut Canvas) {
    if is_selected(model, index) {
        let ring = Stroke::solid(Role::Grip, 2.0).cased();
        canvas.circle(place, MARKER + 5.0, ring);
    }
}

/// Draws the number of a point beside its marker, followed by `words`.
fn draw_number(canvas: &mut Canvas, labels: &mut Labels, place: Place, index: usize, words: &str) {
    let (role, _) = series(index);
    let text = format!("{}{words}", index + 1);
    labels.name(canvas, (place, 11.0), &text, (role, TEXT));
}
