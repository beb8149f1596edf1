//! The photograph with the sides of the cloth, and the image plane around it with the vanishing
//! points.

use super::model::{VanishingPoints, pixel};
use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::corners;
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::{border_arrow, draw_line};
use crate::kit::photo::Photo;
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE, still_life};
use crate::theme::Role;
use epipole::math::Line2;
use image::RgbImage;
use nalgebra::Vector3;

/// Maximum height of the panels, CSS pixels.
const TALLEST: f64 = 430.0;
/// Columns of the image plane around the photograph, pixels.
const AROUND_PX: [f64; 2] = [-1000.0, 1640.0];
/// Row of the image plane in the middle of that panel, pixels.
const MIDDLE_ROW_PX: f64 = 60.0;
/// Hue and shape of each pair of sides.
const SIDES: [(Role, Shape); 2] = [
    (Role::Series(0), Shape::Disk),
    (Role::Series(1), Shape::Square),
];
const HORIZON: Role = Role::Series(2);

/// Draws [`VanishingPoints`].
#[derive(Default)]
pub(crate) struct VanishingPointsView {
    photo: Photo,
}

impl View for VanishingPointsView {
    type Model = VanishingPoints;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &VanishingPoints, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [photo, around] = match grid::is_narrow(width) {
            true => [grid.row([PHOTO_ASPECT], 190.0), grid.row([0.42], 126.0)].map(|[cell]| cell),
            false => grid.row([PHOTO_ASPECT; 2], TALLEST),
        };
        let [left, right] = AROUND_PX;
        let half = (right - left) / 2.0 * around.height / around.width;
        let rows = [MIDDLE_ROW_PX - half, MIDDLE_ROW_PX + half];
        grid.layout(vec![
            Panel::photograph("photo", photo, PHOTO_SIZE),
            Panel::new("around", around, AROUND_PX, rows),
        ])
    }

    fn photograph(&mut self, model: &VanishingPoints, panel: &str) -> Option<RgbImage> {
        let camera = model.camera();
        let picture = self
            .photo
            .picture(&still_life(), &camera, [0.0; 3], PHOTO_SIZE);
        picture.ok().filter(|_| panel == "photo").cloned()
    }

    fn draw(&mut self, model: &VanishingPoints, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 2] = [
            (
                "photo",
                &["Photograph: drag a corner of the cloth", "Photograph"],
            ),
            (
                "around",
                &[
                    "The image plane around the photograph",
                    "Around the photograph",
                ],
            ),
        ];
        let panels = grid::open_all(canvas, layout, titles);
        let [photo, around] = panels;
        let camera = model.camera();
        let (width, height) = PHOTO_SIZE;
        let far = (f64::from(width) - 0.5, f64::from(height) - 0.5);
        match self
            .photo
            .picture(&still_life(), &camera, [0.0; 3], PHOTO_SIZE)
        {
            Ok(picture) => {
                canvas.photograph(photo.rect, picture);
                canvas.photograph(around.rect_between((-0.5, -0.5), far), picture);
            }
            Err(error) => grid::notice(canvas, photo.rect, &error.to_string()),
        }
        for panel in panels {
            canvas.clipped(panel.rect.inset(1.0), |canvas| {
                draw_marks(model, panel, canvas)
            });
        }
        if model.sides().is_none() {
            grid::notice(canvas, around.rect, "Two corners are at one place.");
        }
    }

    fn prepare(&mut self, model: &VanishingPoints) -> bool {
        (self.photo).prepare(&still_life(), &model.camera(), [0.0; 3], PHOTO_SIZE)
    }

    fn refine(&mut self, model: &VanishingPoints) -> bool {
        (self.photo).refine(&still_life(), &model.camera(), [0.0; 3], PHOTO_SIZE)
    }
}

/// Draws sides, vanishing points and horizon, and in the photograph also the corners.
fn draw_marks(model: &VanishingPoints, panel: &Panel, canvas: &mut Canvas) {
    let is_photo = panel.id == "photo";
    let corners = model.corners().map(|corner| panel.place_of(&corner));
    let mut labels = Labels::new(panel.rect.inset(3.0));
    if let (Some(sides), Some(points)) = (model.sides(), model.vanishing_points()) {
        for (pair, (role, _)) in sides.into_iter().zip(SIDES) {
            for line in pair {
                let width = if is_photo { 1.75 } else { 1.25 };
                let (from, to) =
                    draw_line(canvas, panel, &line, Stroke::solid(role, width).cased());
                labels.keep_line_free(from, to);
            }
        }
        if let Some(horizon) = model.horizon() {
            draw_horizon(canvas, panel, &mut labels, &horizon);
        }
        for (index, point) in points.into_iter().enumerate() {
            let name = ["v₁", "v₂"][index];
            draw_vanishing_point(canvas, panel, &mut labels, point, (SIDES[index], name));
        }
    }
    if is_photo {
        corners::draw_grips(canvas, corners);
        corners::draw_names(canvas, &mut labels, corners);
    }
}

fn draw_horizon(canvas: &mut Canvas, panel: &Panel, labels: &mut Labels, horizon: &Line2) {
    let stroke = Stroke::solid(HORIZON, 2.5).dashed().cased();
    let (from, to) = draw_line(canvas, panel, horizon, stroke);
    labels.keep_line_free(from, to);
    let rect = panel.rect;
    let x = rect.center().0;
    let y = from.1 + (to.1 - from.1) * (x - from.0) / (to.0 - from.0);
    if y > rect.y + 4.0 && y < rect.bottom() - 4.0 {
        let beside = [
            ((x, y - 13.0), Align::Middle),
            ((x, y + 13.0), Align::Middle),
        ];
        let style = TextStyle::new(HORIZON, TEXT).cased();
        labels.draw(canvas, &beside, "horizon", style);
    }
}

/// Draws a vanishing point, or in the surrounding image plane an arrow toward it at the border.
fn draw_vanishing_point(
    canvas: &mut Canvas,
    panel: &Panel,
    labels: &mut Labels,
    point: Vector3<f64>,
    ((role, shape), name): ((Role, Shape), &str),
) {
    let Some(place) = pixel(point).map(|pixel| panel.place_of(&pixel)) else {
        return;
    };
    if panel.rect.contains(place) {
        canvas.marker(place, 6.5, shape, role, true);
        labels.keep_free(place, 8.0);
        labels.name(canvas, (place, 10.0), name, (Role::Ink, TEXT));
    } else if panel.id == "around"
        && let Some((from, to)) = border_arrow(panel.rect, place)
    {
        canvas.arrow(from, to, Stroke::solid(role, 2.5).cased());
        labels.name(canvas, (from, 8.0), name, (Role::Ink, TEXT));
    }
}
