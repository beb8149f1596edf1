//! Drawing of `epipolar-click`: two photographs, points in the first, lines in the second.

use super::model::{EpipolarClick, Geometry, Match};
use super::words;
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle, text_width};
use crate::contract::{Layout, Panel, Rect, View, format_number};
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
        if let Some(geometry) = &geometry {
            draw_epipole(canvas, first, &geometry.epipole1, "e₁");
            draw_epipole(canvas, second, &geometry.epipole2, "e₂");
        } else {
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
        let titles = ["Photograph 1: click or drag", "Photograph 2: the lines"];
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

/// The points, and through the selected one the line of all points that share its epipolar line.
fn draw_first(
    model: &EpipolarClick,
    geometry: Option<&Geometry>,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let selected = model.selected();
    if let Some(geometry) = geometry {
        for (index, point) in model.points() {
            if let Some(line) = model.line1(geometry, &point) {
                let (role, _) = series(index);
                draw_line(canvas, panel, &line, Stroke::solid(role, 1.0).dotted());
            }
        }
    }
    for (index, point) in model.points() {
        let (role, shape) = series(index);
        let place = panel.canvas_from_world((point.x, point.y));
        if selected == Some(index) {
            let ring = Stroke::solid(Role::Grip, 2.0).cased();
            canvas.circle(place, MARKER + 5.0, ring);
        }
        canvas.marker(place, MARKER, shape, role, true);
        draw_number(canvas, panel.rect, place, index, None);
    }
}

/// The epipolar lines, and on each the match.
fn draw_second(
    model: &EpipolarClick,
    geometry: Option<&Geometry>,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let selected = model.selected();
    if let Some(geometry) = geometry {
        for (index, point) in model.points() {
            if let Some(line) = model.line2(geometry, &point) {
                let (role, _) = series(index);
                let width = if selected == Some(index) { 2.5 } else { 1.75 };
                draw_line(canvas, panel, &line, Stroke::solid(role, width).cased());
            }
        }
    }
    for (index, point) in model.points() {
        let (role, shape) = series(index);
        let found = model.find_match(&point);
        let Some(pixel) = found.pixel() else { continue };
        let place = panel.canvas_from_world((pixel.x, pixel.y));
        if selected == Some(index) && in_picture(&pixel) {
            let ring = Stroke::solid(Role::Grip, 2.0).cased();
            canvas.circle(place, MARKER + 5.0, ring);
        }
        match found {
            Match::Visible(_) => {
                canvas.marker(place, MARKER, shape, role, true);
                draw_number(canvas, panel.rect, place, index, None);
            }
            Match::Hidden(_, by) => {
                canvas.hollow_marker(place, MARKER, shape, role, true);
                let text = format!("hidden by {by}");
                draw_number(canvas, panel.rect, place, index, Some(&text));
            }
            Match::Outside(_) => draw_outside(canvas, panel, place, index),
            Match::Behind | Match::Nothing => {}
        }
    }
}

fn draw_line(canvas: &mut Canvas, panel: &Panel, line: &Line2, stroke: Stroke) {
    let center = Point2::new(f64::from(PHOTO_WIDTH), f64::from(PHOTO_HEIGHT)) * 0.5;
    let foot = line.nearest(&center);
    let end = |sign: f64| {
        panel.canvas_from_world((
            foot.x - sign * FAR_PX * line.b,
            foot.y + sign * FAR_PX * line.a,
        ))
    };
    canvas.line(end(-1.0), end(1.0), stroke);
}

/// The number of a point beside its marker, perhaps with words.
fn draw_number(canvas: &mut Canvas, rect: Rect, place: Place, index: usize, words: Option<&str>) {
    let (role, _) = series(index);
    let text = match words {
        Some(words) => format!("{} {words}", index + 1),
        None => format!("{}", index + 1),
    };
    let width = text_width(&text, TEXT);
    let y = if place.1 - 14.0 > rect.y + 8.0 {
        place.1 - 15.0
    } else {
        place.1 + 16.0
    };
    let left = (place.0 + 9.0).min(rect.right() - width - 4.0);
    canvas.label((left, y), &text, TextStyle::new(role, TEXT).cased());
}

/// An arrow at the border towards a match beyond it.
fn draw_outside(canvas: &mut Canvas, panel: &Panel, place: Place, index: usize) {
    let (role, _) = series(index);
    let Some((from, to)) = border_arrow(panel.rect, place) else {
        return;
    };
    canvas.arrow(from, to, Stroke::solid(role, 2.5).cased());
    draw_number(canvas, panel.rect, from, index, Some("is outside"));
}

/// From inside the border to the border, towards a place outside.
fn border_arrow(rect: Rect, place: Place) -> Option<(Place, Place)> {
    const LENGTH: f64 = 26.0;
    let center = rect.center();
    let inner = rect.inset(3.0);
    let to = (
        place.0.clamp(inner.x, inner.right()),
        place.1.clamp(inner.y, inner.bottom()),
    );
    let direction = Vector2::new(place.0 - to.0, place.1 - to.1).try_normalize(1e-9)?;
    let from = (to.0 - LENGTH * direction.x, to.1 - LENGTH * direction.y);
    (rect.width > 4.0 * LENGTH && center.0.is_finite()).then_some((from, to))
}

/// The epipole, or at the border an arrow towards it.
fn draw_epipole(canvas: &mut Canvas, panel: &Panel, epipole: &Epipole, name: &str) {
    let rect = panel.rect;
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    let stroke = Stroke::solid(Role::Ink, 2.5);
    match epipole {
        Epipole::Finite(pixel) if in_picture(pixel) => {
            let place = panel.canvas_from_world((pixel.x, pixel.y));
            canvas.marker(place, 7.0, Shape::Ring, Role::Ink, true);
            canvas.marker(place, 2.0, Shape::Disk, Role::Ink, false);
            let y = if place.1 + 28.0 < rect.bottom() {
                place.1 + 19.0
            } else {
                place.1 - 19.0
            };
            let half = text_width(name, TEXT) / 2.0 + 4.0;
            let x = place.0.clamp(rect.x + half, rect.right() - half);
            canvas.label((x, y), name, style.middle());
        }
        Epipole::Finite(pixel) => {
            let place = panel.canvas_from_world((pixel.x, pixel.y));
            if let Some((from, to)) = border_arrow(rect, place) {
                canvas.arrow(from, to, stroke.cased());
                let distance_px = libm::hypot(
                    (place.0 - to.0) / panel.scale_x(),
                    (place.1 - to.1) / panel.scale_x(),
                );
                let text = format!("{name}, {} px away", format_number(distance_px, 0));
                label_inside(canvas, rect, from, &text);
            }
        }
        Epipole::AtInfinity(direction) => {
            let center = rect.center();
            for sign in [-1.0, 1.0] {
                let far = (
                    center.0 + sign * direction.x * 1e5,
                    center.1 + sign * direction.y * 1e5,
                );
                let clamped = (
                    far.0.clamp(rect.x - 1.0, rect.right() + 1.0),
                    far.1.clamp(rect.y - 1.0, rect.bottom() + 1.0),
                );
                if let Some((from, to)) = border_arrow(rect, clamped) {
                    canvas.arrow(from, to, stroke.cased());
                    label_inside(canvas, rect, from, &format!("{name} at infinity"));
                }
            }
        }
    }
}

/// A label above a place, within the panel.
fn label_inside(canvas: &mut Canvas, rect: Rect, place: Place, text: &str) {
    let half = text_width(text, TEXT) / 2.0 + 5.0;
    let x = place
        .0
        .clamp(rect.x + half, (rect.right() - half).max(rect.x + half));
    let y = if place.1 - 26.0 > rect.y {
        place.1 - 16.0
    } else {
        place.1 + 17.0
    };
    let style = TextStyle::new(Role::Ink, TEXT).middle().cased();
    canvas.label((x, y), text, style);
}

/// Words over a photograph.
fn draw_notice(canvas: &mut Canvas, rect: Rect, text: &str) {
    let plate = Rect::new(rect.x, rect.y, rect.width, rect.height * 0.45);
    canvas.fill_rect(plate, Role::Background, 0.9);
    canvas.paragraph(plate.inset(12.0), text, TextStyle::new(Role::Ink, TEXT));
}
