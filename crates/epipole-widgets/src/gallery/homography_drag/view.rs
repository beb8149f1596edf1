//! The photograph with its four corners, and the plane seen from directly above, with the ruler.

use super::model::{HomographyDrag, camera};
use crate::canvas::{Align, Canvas, Place, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::corners;
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::photo::Photo;
use crate::kit::scenes::{PHOTO_SIZE, still_life};
use crate::kit::warped;
use crate::theme::Role;
use image::RgbImage;
use nalgebra::Point2;

/// Maximum height of the panels, CSS pixels.
const TALLEST: f64 = 430.0;
const OUTLINE: Role = Role::Series(0);
const RULER: Role = Role::Series(1);

/// Draws [`HomographyDrag`].
#[derive(Default)]
pub(crate) struct HomographyDragView {
    photo: Photo,
}

impl HomographyDragView {
    /// Returns the photograph of the still life in its current quality.
    fn still_life(&mut self) -> Option<&RgbImage> {
        let picture = self
            .photo
            .picture(&still_life(), &camera(), [0.0; 3], PHOTO_SIZE);
        picture.ok()
    }
}

impl View for HomographyDragView {
    type Model = HomographyDrag;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &HomographyDrag, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(model.size());
        let cells = match grid::is_narrow(width) {
            true => [grid.row([aspect], 158.0), grid.row([aspect], 158.0)].map(|[cell]| cell),
            false => grid.row([aspect; 2], TALLEST),
        };
        let plane = plane_panel(cells[1], model.range_cm());
        grid.layout(vec![
            Panel::photograph("photo", cells[0], model.size()),
            plane,
        ])
    }

    fn photograph(&mut self, model: &HomographyDrag, panel: &str) -> Option<RgbImage> {
        match model.own() {
            _ if panel != "photo" => None,
            Some(own) => Some(own.image().clone()),
            None if model.is_own() => None,
            None => self.still_life().cloned(),
        }
    }

    fn draw(&mut self, model: &HomographyDrag, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 2] = [
            ("photo", &["Photograph: drag the corners", "Photograph"]),
            (
                "plane",
                &["The plane, seen from straight above", "From straight above"],
            ),
        ];
        let [photo, plane] = grid::open_all(canvas, layout, titles);
        let image = match model.own() {
            Some(own) => Some(own.image()),
            None if model.is_own() => None,
            None => self.still_life(),
        };
        let homography = model.plane_from_photo();
        if let Some(image) = image {
            canvas.photograph(photo.rect, image);
            if let Ok(homography) = &homography {
                canvas.clipped(plane.rect.inset(1.0), |canvas| {
                    warped::draw(canvas, plane, homography, image);
                });
            }
        }
        canvas.clipped(photo.rect, |canvas| draw_photo_marks(model, photo, canvas));
        match homography {
            Ok(_) => canvas.clipped(plane.rect.inset(1.0), |canvas| {
                draw_plane_marks(model, plane, canvas);
            }),
            Err(sentence) => grid::notice(canvas, plane.rect, sentence),
        }
    }

    fn prepare(&mut self, model: &HomographyDrag) -> bool {
        !model.is_own() && (self.photo).prepare(&still_life(), &camera(), [0.0; 3], PHOTO_SIZE)
    }

    fn refine(&mut self, model: &HomographyDrag) -> bool {
        !model.is_own() && (self.photo).refine(&still_life(), &camera(), [0.0; 3], PHOTO_SIZE)
    }
}

/// Creates the panel for a range of the plane, centered in a cell, with one scale for both
/// directions.
fn plane_panel(cell: Rect, [x, y]: [[f64; 2]; 2]) -> Panel {
    let half = |[low, high]: [f64; 2]| (high - low) / 2.0;
    let middle = |[low, high]: [f64; 2]| (high + low) / 2.0;
    let scale = (cell.width / half(x)).min(cell.height / half(y)) / 2.0;
    // Rounding must not cut off an end of the range.
    let shown = |range: [f64; 2], side: f64| {
        let half = side / scale / 2.0;
        [
            (middle(range) - half).min(range[0]),
            (middle(range) + half).max(range[1]),
        ]
    };
    Panel::new("plane", cell, shown(x, cell.width), shown(y, cell.height))
}

/// Draws the quadrilateral with its corners, and the ruler in the photograph.
fn draw_photo_marks(model: &HomographyDrag, panel: &Panel, canvas: &mut Canvas) {
    let corners = model.corners().map(|corner| panel.place_of(&corner));
    canvas.polygon_outline(&corners, Stroke::solid(OUTLINE, 2.0).cased());
    if let Some([from, to]) = model.ruler_px() {
        let ends = (panel.place_of(&from), panel.place_of(&to));
        canvas.line(ends.0, ends.1, Stroke::solid(RULER, 2.5).cased());
    }
    corners::draw_grips(canvas, corners);
    draw_outline_names(panel, corners, canvas);
}

/// Draws the letters beside the corners of an outline.
fn draw_outline_names(panel: &Panel, corners: [Place; 4], canvas: &mut Canvas) {
    let mut labels = Labels::new(panel.rect.inset(3.0));
    for index in 0..4 {
        labels.keep_line_free(corners[index], corners[(index + 1) % 4]);
    }
    corners::draw_names(canvas, &mut labels, corners);
}

/// Draws the rectangle, and the ruler with its length.
fn draw_plane_marks(model: &HomographyDrag, panel: &Panel, canvas: &mut Canvas) {
    let at = |point: Point2<f64>| panel.place_of(&point);
    let corners = model.rectangle().map(at);
    canvas.polygon_outline(&corners, Stroke::solid(OUTLINE, 2.0).cased());
    draw_outline_names(panel, corners, canvas);
    let [from, to] = model.ruler().map(at);
    canvas.line(from, to, Stroke::solid(RULER, 2.5).cased());
    for end in [from, to] {
        canvas.grip(end, Role::Grip);
    }
    let mut labels = Labels::new(panel.rect.inset(3.0));
    labels.keep_line_free(from, to);
    for place in [from, to] {
        labels.keep_free(place, 9.0);
    }
    let (x, y) = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
    let text = format!("{} cm", format_number(model.length_cm(), 1));
    let beside = [
        ((x + 12.0, y), Align::Start),
        ((x - 12.0, y), Align::End),
        ((x, y - 16.0), Align::Middle),
        ((x, y + 16.0), Align::Middle),
    ];
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    labels.draw(canvas, &beside, &text, style);
}
