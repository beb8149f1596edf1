//! Two photographs of the still life, with epipolar lines and epipoles.

use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Panel, Rect, format_number};
use crate::kit::grid::{self, TEXT};
use crate::kit::labels::Labels;
use crate::kit::photo::Photo;
use crate::kit::scenes::{PHOTO_SIZE, still_life};
use crate::theme::Role;
use epipole::Error;
use epipole::camera::PosedCamera;
use epipole::epipolar::Epipole;
use epipole::math::Line2;
use image::RgbImage;
use nalgebra::{Point2, Vector2};

/// Hue and shape of each of two cameras, in photographs, top views and 3D views.
pub(crate) const CAMERAS: [(Role, Shape); 2] = [
    (Role::Series(0), Shape::Disk),
    (Role::Series(1), Shape::Square),
];
/// Half length of a drawn line, pixels, so that its ends are outside of the picture.
const FAR_PX: f64 = 2000.0;

/// Two photographs of the static still life.
#[derive(Default)]
pub(crate) struct Photos([Photo; 2]);

impl Photos {
    /// Returns one of the photographs, 0 or 1, in its current quality.
    ///
    /// # Errors
    /// As [`Photo::picture`].
    pub(crate) fn picture(
        &mut self,
        index: usize,
        camera: &PosedCamera,
    ) -> Result<&RgbImage, Error> {
        self.0[index].picture(&still_life(), camera, [0.0; 3], PHOTO_SIZE)
    }

    /// Returns both photographs.
    ///
    /// # Errors
    /// As [`Photo::picture`].
    pub(crate) fn pictures(&mut self, cameras: &[PosedCamera; 2]) -> Result<[&RgbImage; 2], Error> {
        let ([one, two], scene) = (&mut self.0, still_life());
        Ok([
            one.picture(&scene, &cameras[0], [0.0; 3], PHOTO_SIZE)?,
            two.picture(&scene, &cameras[1], [0.0; 3], PHOTO_SIZE)?,
        ])
    }

    /// Draws the photographs in their panels.
    pub(crate) fn draw(
        &mut self,
        canvas: &mut Canvas,
        panels: [&Panel; 2],
        cameras: &[PosedCamera; 2],
    ) {
        for (index, panel) in panels.into_iter().enumerate() {
            match self.picture(index, &cameras[index]) {
                Ok(picture) => canvas.photograph(panel.rect, picture),
                Err(error) => {
                    canvas.panel(panel.rect);
                    grid::notice(canvas, panel.rect, &error.to_string());
                }
            }
        }
    }

    /// See [`Photo::prepare`].
    pub(crate) fn prepare(&mut self, cameras: &[PosedCamera; 2]) -> bool {
        let scene = still_life();
        let mut photos = self.0.iter_mut().zip(cameras);
        photos.any(|(photo, camera)| photo.prepare(&scene, camera, [0.0; 3], PHOTO_SIZE))
    }

    /// See [`Photo::refine`].
    pub(crate) fn refine(&mut self, cameras: &[PosedCamera; 2]) -> bool {
        let scene = still_life();
        let mut photos = self.0.iter_mut().zip(cameras);
        photos.any(|(photo, camera)| photo.refine(&scene, camera, [0.0; 3], PHOTO_SIZE))
    }
}

/// Picks at most `most` of many, evenly spaced, to keep the photographs visible.
pub(crate) fn spread<T>(all: &[T], most: usize) -> impl Iterator<Item = &T> {
    let stride = all.len().div_ceil(most.max(1)).max(1);
    all.iter().step_by(stride)
}

/// Returns the color and shape of one of several points, in both photographs.
pub(crate) fn series(index: usize) -> (Role, Shape) {
    (Role::Series(index as u8), Shape::of_series(index))
}

/// Draws a line of the image plane and returns its visible ends.
pub(crate) fn draw_line(
    canvas: &mut Canvas,
    panel: &Panel,
    line: &Line2,
    stroke: Stroke,
) -> (Place, Place) {
    let (u, v) = panel.world_from_canvas(panel.rect.center());
    let center = Point2::new(u, v);
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

/// Returns the ends of an arrow inside the border that points to a position outside.
pub(crate) fn border_arrow(rect: Rect, place: Place) -> Option<(Place, Place)> {
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

/// Draws the epipole, or an arrow towards it at the border.
pub(crate) fn draw_epipole(
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
        Epipole::Finite(pixel) if rect.contains(panel.place_of(pixel)) => {
            let place = panel.place_of(pixel);
            canvas.marker(place, 7.0, Shape::Ring, Role::Ink, true);
            canvas.marker(place, 2.0, Shape::Disk, Role::Ink, false);
            labels.keep_free(place, 9.0);
            let text = format!("epipole {name}");
            labels.draw(canvas, &Labels::around(place, 13.0), &text, style);
        }
        Epipole::Finite(pixel) => {
            let place = panel.place_of(pixel);
            let Some((from, to)) = border_arrow(rect, place) else {
                return;
            };
            canvas.arrow(from, to, stroke);
            let across = place.0 - place.0.clamp(rect.x, rect.right());
            let down = place.1 - place.1.clamp(rect.y, rect.bottom());
            let distance = libm::hypot(across, down) / panel.scale_x();
            let text = format!("epipole {name}, {} px away", format_number(distance, 0));
            labels.draw(canvas, &beside_arrow(from, to), &text, style);
        }
        Epipole::AtInfinity(direction) => {
            let center = rect.center();
            for sign in [-1.0, 1.0] {
                // Far beyond the border, along the line through the center.
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

/// Returns positions for the label of an arrow at the border.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_are_spread_over_all() {
        let all: Vec<usize> = (0..1000).collect();
        let some: Vec<&usize> = spread(&all, 32).collect();
        assert!(some.len() <= 32 && *some[some.len() - 1] >= 960);
        assert_eq!(spread(&all[..5], 32).count(), 5);
        assert_eq!(spread(&all[..0], 32).count(), 0);
        assert_eq!(spread(&all, 0).count(), 1);
    }
}
