//! Drawing of `epipolar-click`: two photographs, points in the first, lines in the second.

use super::model::{EpipolarClick, Geometry, Match};
use super::words;
use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle, paragraph_height};
use crate::contract::{Layout, Panel, Rect, View, format_number};
use crate::labels::Labels;
use crate::photo::Photo;
use crate::scenes::{self, PHOTO_HEIGHT, PHOTO_SIZE, PHOTO_WIDTH, in_picture};
use crate::theme::Role;
use epipole::epipolar::Epipole;
use epipole::math::Line2;
use nalgebra::{Point2, Vector2};

const TEXT: f64 = 13.0;
/// Height of a line of text above a photograph.
const TITLE: f64 = 24.0;
/// Pages narrower than this have the photographs below each other.
const STACKED_BELOW: f64 = 560.0;
const MARKER: f64 = 5.5;
/// Farther than any pixel from the middle of the picture, so that a line's ends are outside.
const FAR_PX: f64 = 2000.0;

/// The two photographs, kept between drawings.
#[derive(Default)]
pub(crate) struct EpipolarClickView {
    photos: [Photo; 2],
}

impl View for EpipolarClickView {
    type Model = EpipolarClick;

    fn layout(&self, _model: &EpipolarClick, width: f64) -> Layout {
        let aspect = f64::from(PHOTO_HEIGHT) / f64::from(PHOTO_WIDTH);
        let is_stacked = width < STACKED_BELOW;
        let gap = 12.0;
        let photo_width = if is_stacked {
            width
        } else {
            (width - gap) / 2.0
        };
        let photo_height = photo_width * aspect;
        let (second_x, second_y) = if is_stacked {
            (0.0, TITLE + photo_height + gap + TITLE)
        } else {
            (photo_width + gap, TITLE)
        };
        let photo = |id, x, y| {
            let rect = Rect::new(x, y, photo_width, photo_height);
            Panel::photograph(id, rect, PHOTO_WIDTH, PHOTO_HEIGHT)
        };
        Layout {
            width,
            height: second_y + photo_height,
            panels: vec![
                Panel {
                    clickable: true,
                    ..photo("first", 0.0, TITLE)
                },
                photo("second", second_x, second_y),
            ],
        }
    }

    fn draw(&mut self, model: &EpipolarClick, layout: &Layout, canvas: &mut Canvas) {
        let (first, second) = (layout.panel("first"), layout.panel("second"));
        self.draw_photographs(model, [first, second], canvas);
        let geometry = model.geometry();
        canvas.clipped(first.rect, |canvas| {
            draw_first(model, geometry.as_ref(), first, canvas);
        });
        canvas.clipped(second.rect, |canvas| {
            draw_second(model, geometry.as_ref(), second, canvas);
        });
        if geometry.is_none() {
            draw_notice(canvas, second.rect, words::NO_BASELINE);
        }
    }

    fn refine(&mut self, model: &EpipolarClick) -> bool {
        let (cameras, scene) = (model.cameras(), scenes::still_life());
        let mut photos = self.photos.iter_mut().zip(&cameras);
        photos.any(|(photo, camera)| photo.refine(&scene, camera, [0.0; 3], PHOTO_SIZE))
    }
}

impl EpipolarClickView {
    fn draw_photographs(
        &mut self,
        model: &EpipolarClick,
        panels: [&Panel; 2],
        canvas: &mut Canvas,
    ) {
        let (cameras, scene) = (model.cameras(), scenes::still_life());
        let titles = [
            "Photograph 1: click or drag a point",
            "Photograph 2: its match is on its line",
        ];
        for index in 0..2 {
            let rect = panels[index].rect;
            let place = (rect.x, rect.y - TITLE / 2.0);
            canvas.label(place, titles[index], TextStyle::new(Role::Ink, TEXT));
            let picture = self.photos[index].picture(&scene, &cameras[index], [0.0; 3], PHOTO_SIZE);
            match picture {
                Ok(picture) => canvas.photograph(rect, picture),
                Err(error) => {
                    canvas.panel(rect);
                    draw_notice(canvas, rect, &error.to_string());
                }
            }
        }
    }
}

fn series(index: usize) -> (Role, Shape) {
    (Role::Series(index as u8), Shape::of_series(index))
}

/// The points, and through each the faint line of all points that share its epipolar line.
fn draw_first(
    model: &EpipolarClick,
    geometry: Option<&Geometry>,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let mut labels = Labels::new(panel.rect);
    if let Some(geometry) = geometry {
        for (index, point) in model.points() {
            if let Some(line) = model.line1(geometry, &point) {
                let (role, _) = series(index);
                let stroke = Stroke::solid(role, 1.25).dotted();
                let (from, to) = draw_line(canvas, panel, &line, stroke);
                labels.keep_line_free(from, to);
            }
        }
    }
    for (index, point) in model.points() {
        let (role, shape) = series(index);
        let place = panel.canvas_from_world((point.x, point.y));
        draw_selection(model, index, place, canvas);
        canvas.marker(place, MARKER, shape, role, true);
        labels.keep_free(place, MARKER + 3.0);
    }
    if let Some(geometry) = geometry {
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole1, "e₁");
    }
    for (index, point) in model.points() {
        let place = panel.canvas_from_world((point.x, point.y));
        draw_number(canvas, &mut labels, place, index, "");
    }
}

/// The epipolar lines, and on each the match.
fn draw_second(
    model: &EpipolarClick,
    geometry: Option<&Geometry>,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let mut labels = Labels::new(panel.rect);
    if let Some(geometry) = geometry {
        let selected = model.selected();
        for (index, point) in model.points() {
            if let Some(line) = model.line2(geometry, &point) {
                let (role, _) = series(index);
                let width = if selected == Some(index) { 2.5 } else { 1.75 };
                let stroke = Stroke::solid(role, width).cased();
                let (from, to) = draw_line(canvas, panel, &line, stroke);
                labels.keep_line_free(from, to);
            }
        }
    }
    let mut texts = Vec::new();
    for (index, point) in model.points() {
        let (role, shape) = series(index);
        let found = model.find_match(&point);
        let Some(pixel) = found.pixel() else { continue };
        let place = panel.canvas_from_world((pixel.x, pixel.y));
        match found {
            Match::Visible(_) | Match::Hidden(..) => {
                draw_selection(model, index, place, canvas);
                labels.keep_free(place, MARKER + 3.0);
                if let Match::Hidden(_, by) = found {
                    canvas.hollow_marker(place, MARKER, shape, role, true);
                    texts.push((index, place, format!(" hidden by {by}")));
                } else {
                    canvas.marker(place, MARKER, shape, role, true);
                    texts.push((index, place, String::new()));
                }
            }
            Match::Outside(_) => {
                if let Some((from, to)) = border_arrow(panel.rect, place) {
                    canvas.arrow(from, to, Stroke::solid(role, 2.5).cased());
                    texts.push((index, from, " is outside".to_owned()));
                }
            }
            Match::Behind | Match::Nothing => {}
        }
    }
    if let Some(geometry) = geometry {
        draw_epipole(canvas, panel, &mut labels, &geometry.epipole2, "e₂");
    }
    for (index, place, text) in texts {
        draw_number(canvas, &mut labels, place, index, &text);
    }
}

/// A ring around the point that the readouts speak of.
fn draw_selection(model: &EpipolarClick, index: usize, place: Place, canvas: &mut Canvas) {
    if model.selected() == Some(index) {
        let ring = Stroke::solid(Role::Grip, 2.0).cased();
        canvas.circle(place, MARKER + 5.0, ring);
    }
}

/// Draws a line of the image plane, and says from where to where.
fn draw_line(canvas: &mut Canvas, panel: &Panel, line: &Line2, stroke: Stroke) -> (Place, Place) {
    let center = Point2::new(f64::from(PHOTO_WIDTH), f64::from(PHOTO_HEIGHT)) * 0.5;
    let foot = line.nearest(&center);
    let end = |sign: f64| {
        panel.canvas_from_world((
            foot.x - sign * FAR_PX * line.b,
            foot.y + sign * FAR_PX * line.a,
        ))
    };
    canvas.line(end(-1.0), end(1.0), stroke);
    (end(-1.0), end(1.0))
}

/// The number of a point beside its marker, perhaps with words.
fn draw_number(canvas: &mut Canvas, labels: &mut Labels, place: Place, index: usize, words: &str) {
    let (role, _) = series(index);
    let text = format!("{}{words}", index + 1);
    let style = TextStyle::new(role, TEXT).cased();
    labels.draw(canvas, &Labels::around(place, 11.0), &text, style);
}

/// From inside the border to the border, towards a place outside.
fn border_arrow(rect: Rect, place: Place) -> Option<(Place, Place)> {
    const LENGTH: f64 = 26.0;
    let inner = rect.inset(3.0);
    let to = (
        place.0.clamp(inner.x, inner.right()),
        place.1.clamp(inner.y, inner.bottom()),
    );
    let direction = Vector2::new(place.0 - to.0, place.1 - to.1).try_normalize(1e-9)?;
    let from = (to.0 - LENGTH * direction.x, to.1 - LENGTH * direction.y);
    Some((from, to))
}

/// The epipole, or at the border an arrow towards it.
fn draw_epipole(
    canvas: &mut Canvas,
    panel: &Panel,
    labels: &mut Labels,
    epipole: &Epipole,
    name: &str,
) {
    let rect = panel.rect;
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    let stroke = Stroke::solid(Role::Ink, 2.5).cased();
    match epipole {
        Epipole::Finite(pixel) if in_picture(pixel) => {
            let place = panel.canvas_from_world((pixel.x, pixel.y));
            canvas.marker(place, 7.0, Shape::Ring, Role::Ink, true);
            canvas.marker(place, 2.0, Shape::Disk, Role::Ink, false);
            labels.keep_free(place, 9.0);
            let text = format!("epipole {name}");
            labels.draw(canvas, &Labels::around(place, 13.0), &text, style);
        }
        Epipole::Finite(pixel) => {
            let place = panel.canvas_from_world((pixel.x, pixel.y));
            let Some((from, to)) = border_arrow(rect, place) else {
                return;
            };
            canvas.arrow(from, to, stroke);
            let distance = libm::hypot(place.0 - to.0, place.1 - to.1) / panel.scale_x();
            let text = format!("epipole {name}, {} px away", format_number(distance, 0));
            labels.draw(canvas, &beside_arrow(from, to), &text, style);
        }
        Epipole::AtInfinity(direction) => {
            let center = rect.center();
            for sign in [-1.0, 1.0] {
                // Far beyond the border, along the line through the middle.
                let far = 1e3 * (rect.width + rect.height) * sign;
                let (x, y) = (center.0 + far * direction.x, center.1 + far * direction.y);
                let to_border = |start: f64, size: f64| start.abs() / (size / 2.0).max(1e-9);
                let times = to_border(x - center.0, rect.width)
                    .max(to_border(y - center.1, rect.height))
                    .max(1.0);
                let border = (
                    center.0 + (x - center.0) / times,
                    center.1 + (y - center.1) / times,
                );
                let unit = Vector2::new(sign * direction.x, sign * direction.y);
                let from = (border.0 - 26.0 * unit.x, border.1 - 26.0 * unit.y);
                let to = (border.0 - 3.0 * unit.x, border.1 - 3.0 * unit.y);
                canvas.arrow(from, to, stroke);
                if sign < 0.0 {
                    let text = format!("epipole {name} at infinity");
                    labels.draw(canvas, &beside_arrow(from, to), &text, style);
                }
            }
        }
    }
}

/// Places for the label of an arrow at the border.
fn beside_arrow(from: Place, to: Place) -> [(Place, Align); 4] {
    let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
    let leans_left = to.0 < from.0;
    let align = if leans_left { Align::Start } else { Align::End };
    let x = if leans_left { to.0 + 4.0 } else { to.0 - 4.0 };
    [
        ((x, middle.1 - 15.0), align),
        ((x, middle.1 + 16.0), align),
        ((x, middle.1 - 30.0), align),
        ((x, middle.1 + 31.0), align),
    ]
}

/// Words over a photograph.
fn draw_notice(canvas: &mut Canvas, rect: Rect, text: &str) {
    let width = rect.inset(12.0).width;
    let height = paragraph_height(text, TEXT, width) + 16.0;
    let plate = Rect::new(rect.x, rect.bottom() - height, rect.width, height);
    canvas.fill_rect(plate, Role::Background, 0.92);
    let inside = Rect::new(rect.x + 12.0, plate.y + 8.0, width, height);
    canvas.paragraph(inside, text, TextStyle::new(Role::Ink, TEXT));
}
