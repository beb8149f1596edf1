//! Image 1 with p; beside it image 2, or image 1 through the homography, with prediction and match.

use super::model::{Parallax, PlaneOrNot};
use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, View, format_number};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::{CAMERAS, Photos, draw_epipole, draw_line};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE};
use crate::kit::warped;
use crate::theme::Role;
use image::RgbImage;

/// Maximum height of a photograph, CSS pixels.
const TALLEST: f64 = 430.0;
const MARKER: f64 = 6.0;
const LINE: Role = Role::Series(2);
const PREDICTED: Role = Role::Candidate;
/// Parallax below which no arrow is drawn, CSS pixels.
const SHORT: f64 = 2.5;

/// Draws [`PlaneOrNot`].
#[derive(Default)]
pub(crate) struct PlaneOrNotView {
    photos: Photos,
}

impl View for PlaneOrNotView {
    type Model = PlaneOrNot;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &PlaneOrNot, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [first, second] = match grid::is_narrow(width) {
            true => [
                grid.row([PHOTO_ASPECT], 158.0),
                grid.row([PHOTO_ASPECT], 158.0),
            ]
            .map(|[cell]| cell),
            false => grid.row([PHOTO_ASPECT; 2], TALLEST),
        };
        grid.layout(vec![
            Panel::photograph("first", first, PHOTO_SIZE).clickable(),
            Panel::photograph("second", second, PHOTO_SIZE),
        ])
    }

    fn photograph(&mut self, model: &PlaneOrNot, panel: &str) -> Option<RgbImage> {
        let index = ["first", "second"].iter().position(|&name| name == panel)?;
        let picture = self.photos.picture(index, &model.cameras()[index]);
        picture.ok().cloned()
    }

    fn draw(&mut self, model: &PlaneOrNot, layout: &Layout, canvas: &mut Canvas) {
        let titles: [&[&str]; 2] = match model.is_warped() {
            false => [&["Image 1: drag p", "Image 1"], &["Image 2"]],
            true => [
                &["Image 1: drag p", "Image 1"],
                &["Image 1, drawn through H", "Image 1 by H"],
            ],
        };
        let [first, second] = layout.panels_named(["first", "second"]);
        for (panel, titles) in [first, second].into_iter().zip(titles) {
            grid::open(canvas, panel, titles);
        }
        match (self.photos.pictures(&model.cameras()), model.is_warped()) {
            (Ok([one, two]), false) => {
                canvas.photograph(first.rect, one);
                canvas.photograph(second.rect, two);
            }
            (Ok([one, _]), true) => {
                canvas.photograph(first.rect, one);
                canvas.clipped(second.rect.inset(1.0), |canvas| {
                    warped::draw(canvas, second, &model.homography(), one);
                });
            }
            (Err(error), _) => grid::notice(canvas, second.rect, &error.to_string()),
        }
        canvas.clipped(first.rect, |canvas| {
            let place = first.place_of(&model.point());
            canvas.marker(place, MARKER, CAMERAS[0].1, CAMERAS[0].0, true);
            canvas.circle(place, MARKER + 5.0, Stroke::solid(Role::Grip, 2.0).cased());
            Labels::new(first.rect).name(canvas, (place, 12.0), "p", (Role::Ink, TEXT));
        });
        canvas.clipped(second.rect.inset(1.0), |canvas| {
            draw_second(model, second, canvas)
        });
    }

    fn prepare(&mut self, model: &PlaneOrNot) -> bool {
        self.photos.prepare(&model.cameras())
    }

    fn refine(&mut self, model: &PlaneOrNot) -> bool {
        self.photos.refine(&model.cameras())
    }
}

/// Draws the epipolar line of p, its prediction, its match and the parallax between them.
fn draw_second(model: &PlaneOrNot, panel: &Panel, canvas: &mut Canvas) {
    let mut labels = Labels::new(panel.rect.inset(3.0));
    for parallax in model.many() {
        draw_parallax(
            canvas,
            panel,
            &parallax,
            Stroke::solid(PREDICTED, 1.75).cased(),
        );
    }
    if let Some(geometry) = model.geometry() {
        if let Some(line) = geometry.line2(&model.point()) {
            let (from, to) = draw_line(canvas, panel, &line, Stroke::solid(LINE, 1.75).cased());
            labels.keep_line_free(from, to);
        }
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole2, "e′");
    }
    let Some(parallax) = model.parallax(&model.point()) else {
        return grid::notice(canvas, panel.rect, "Camera 2 has this place behind it.");
    };
    draw_parallax(
        canvas,
        panel,
        &parallax,
        Stroke::solid(PREDICTED, 3.0).cased(),
    );
    let (role, shape) = CAMERAS[1];
    let [predicted, place] = [parallax.predicted, parallax.pixel2].map(|p| panel.place_of(&p));
    canvas.marker(predicted, MARKER - 1.0, Shape::Diamond, PREDICTED, true);
    match parallax.is_seen {
        true => canvas.marker(place, MARKER, shape, role, true),
        false => canvas.hollow_marker(place, MARKER, shape, role, true),
    }
    for mark in [predicted, place] {
        labels.keep_free(mark, MARKER + 2.0);
    }
    if libm::hypot(predicted.0 - place.0, predicted.1 - place.1) < 2.0 * MARKER {
        return labels.name(canvas, (place, 12.0), "p′ = H p", (Role::Ink, TEXT));
    }
    labels.name(canvas, (predicted, 10.0), "H p", (Role::Ink, TEXT));
    labels.name(canvas, (place, 12.0), "p′", (Role::Ink, TEXT));
    let (x, y) = ((predicted.0 + place.0) / 2.0, (predicted.1 + place.1) / 2.0);
    let text = format!("{} px", format_number(parallax.length_px(), 0));
    let beside = [
        ((x, y - 16.0), Align::Middle),
        ((x, y + 16.0), Align::Middle),
    ];
    labels.draw(
        canvas,
        &beside,
        &text,
        TextStyle::new(Role::Ink, TEXT).cased(),
    );
}

/// Draws an arrow from a prediction to its match, or a dot if it would be too short.
fn draw_parallax(canvas: &mut Canvas, panel: &Panel, parallax: &Parallax, stroke: Stroke) {
    let [from, to] = [parallax.predicted, parallax.pixel2].map(|pixel| panel.place_of(&pixel));
    match libm::hypot(from.0 - to.0, from.1 - to.1) >= SHORT {
        true => canvas.arrow(from, to, stroke),
        false => canvas.marker(to, 2.0, Shape::Disk, PREDICTED, true),
    }
}
