//! Both photographs as taken by rotated cameras, and a top view of the cameras.

use super::model::{Rectify, Shown, State};
use super::turned::image_ends;
use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::{CAMERAS, Photos, draw_line};
use crate::kit::plan::{self, PlanCamera};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE};
use crate::kit::warped;
use crate::theme::Role;
use nalgebra::{Matrix3, Point2};

const MARKER: f64 = 4.5;
/// Color of the selected match.
const LIT: Role = Role::Series(3);
/// Color of the epipolar line of the selected match.
const LINE: Role = Role::Series(2);
/// Distance of the drawn image planes from the centers, meters.
const IMAGE_M: f64 = 0.42;

/// Draws [`Rectify`].
#[derive(Default)]
pub(crate) struct RectifyView {
    photos: Photos,
}

impl View for RectifyView {
    type Model = Rectify;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &Rectify, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (pictures, top) = if grid::is_broad(width) {
            let [first, second, top] = grid.row([PHOTO_ASPECT, PHOTO_ASPECT, 0.9], 404.0);
            ([first, second], top)
        } else {
            let low = if grid::is_narrow(width) { 180.0 } else { 190.0 };
            let pictures = grid.row([PHOTO_ASPECT; 2], 254.0);
            let [top] = grid.shares([1.0], low);
            (pictures, top)
        };
        let mut panels = vec![plan::panel("top", top, (0.22, 0.7), 1.06)];
        for (id, rect) in ["first", "second"].into_iter().zip(pictures) {
            panels.push(Panel::photograph(id, rect, PHOTO_SIZE).clickable());
        }
        grid.layout(panels)
    }

    fn draw(&mut self, model: &Rectify, layout: &Layout, canvas: &mut Canvas) {
        let [first, second, top] = layout.panels_named(["first", "second", "top"]);
        let panels = [first, second];
        grid::fitting_title(canvas, first.rect, &["Image 1: click a match", "Image 1"]);
        grid::title(canvas, second.rect, "Image 2");
        grid::open(canvas, top, &["The cameras from above", "From above"]);
        for panel in panels {
            canvas.fill_rect(panel.rect, Role::Edge, 1.0);
        }
        let state = match model.state() {
            Ok(state) => state,
            Err(sentence) => return grid::notice(canvas, panels[0].rect, sentence),
        };
        for (index, panel) in panels.into_iter().enumerate() {
            let camera = &state.turned.taken[index];
            match self.photos.picture(index, camera) {
                Ok(picture) => canvas.clipped(panel.rect, |canvas| {
                    let homography = &state.turned.shown_from_taken[index];
                    match (homography - Matrix3::identity()).amax() < 1e-9 {
                        true => canvas.photograph(panel.rect, picture),
                        false => warped::draw(canvas, panel, homography, picture),
                    }
                    draw_marks(model, state, index, panel, canvas);
                }),
                Err(error) => grid::notice(canvas, panel.rect, &error.to_string()),
            }
        }
        draw_row(model, panels, canvas);
        canvas.clipped(top.rect.inset(1.0), |canvas| {
            draw_top(model, state, top, canvas)
        });
    }

    fn prepare(&mut self, model: &Rectify) -> bool {
        let state = model.state();
        state.is_ok_and(|state| self.photos.prepare(&state.turned.taken))
    }

    fn refine(&mut self, model: &Rectify) -> bool {
        let state = model.state();
        state.is_ok_and(|state| self.photos.refine(&state.turned.taken))
    }
}

/// Draws the epipolar lines with their matches, and at the end the valid rectangle.
fn draw_marks(model: &Rectify, state: &State, index: usize, panel: &Panel, canvas: &mut Canvas) {
    let at = |pixel: &Point2<f64>| panel.place_of(pixel);
    let chosen = model.selected().map(|(chosen, _)| chosen);
    let mut labels = Labels::new(panel.rect.inset(2.0));
    if model.is_rectified() {
        let valid = &state.turned.valid[index];
        let corners = [
            (valid.u_min, valid.v_min),
            (valid.u_max, valid.v_min),
            (valid.u_max, valid.v_max),
            (valid.u_min, valid.v_max),
        ];
        let outline = corners.map(|corner| panel.canvas_from_world(corner));
        let stroke = Stroke::solid(Role::Ink, 1.5).dashed().cased();
        canvas.polygon_outline(&outline, stroke);
        let place = (outline[0].0 + 6.0, outline[0].1 + 11.0);
        let style = TextStyle::new(Role::Ink, TEXT).cased();
        labels.draw(canvas, &[(place, Align::Start)], "valid", style);
    }
    for (number, shown) in state.matches.iter().enumerate() {
        let line = state.geometry.as_ref().and_then(|geometry| match index {
            0 => geometry.line1(&shown.pixels[0]),
            _ => geometry.line2(&shown.pixels[0]),
        });
        let Some(line) = line else { continue };
        let stroke = match chosen == Some(number) {
            true => Stroke::solid(LINE, 2.5).cased(),
            false => Stroke::solid(CAMERAS[index].0, 1.25).cased(),
        };
        draw_line(canvas, panel, &line, stroke);
    }
    for (number, shown) in state.matches.iter().enumerate() {
        let (place, role) = (at(&shown.pixels[index]), CAMERAS[index].0);
        let size = match chosen == Some(number) {
            true => MARKER + 2.5,
            false => MARKER,
        };
        match index == 0 || shown.is_seen {
            true => canvas.marker(place, size, CAMERAS[index].1, role, true),
            false => canvas.hollow_marker(place, size, CAMERAS[index].1, role, true),
        }
        labels.keep_free(place, size + 2.0);
    }
    if let Some((_, shown)) = model.selected() {
        let mark = (at(&shown.pixels[index]), 9.0);
        labels.name(canvas, mark, ["p", "p′"][index], (Role::Ink, TEXT));
    }
}

/// Draws the row of p through both images, and the distance of p′ from it.
fn draw_row(model: &Rectify, [first, second]: [&Panel; 2], canvas: &mut Canvas) {
    let Some((_, shown)) = model.selected() else {
        return;
    };
    let row = first.canvas_from_world((0.0, shown.pixels[0].y)).1;
    if row < first.rect.y || row > first.rect.bottom() {
        return;
    }
    let stroke = Stroke::solid(Role::Ink, 1.25).dashed().cased();
    canvas.line((first.rect.x, row), (second.rect.right(), row), stroke);
    let place = second.place_of(&shown.pixels[1]);
    if shown.is_seen && (place.1 - row).abs() > 3.0 {
        let off = Stroke::solid(Role::Outlier, 2.5).cased();
        canvas.clipped(second.rect, |canvas| {
            canvas.line(place, (place.0, row), off)
        });
    }
}

fn draw_top(model: &Rectify, state: &State, panel: &Panel, canvas: &mut Canvas) {
    plan::draw_distances(canvas, panel, "m");
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let at = |point: Point2<f64>| panel.place_of(&point);
    let cameras = [0, 1].map(|index| state.turned.seen_from_above(index));
    let along = cameras[1].0 - cameras[0].0;
    let dashed = Stroke::solid(Role::Muted, 1.25).dashed();
    plan::draw_ray(canvas, panel, &cameras[0].0, &along, dashed);
    plan::draw_ray(canvas, panel, &cameras[1].0, &-along, dashed);
    let from_above = |shown: &Shown| {
        let place = state.turned.taken[0].cam_from_world * shown.point;
        Point2::new(place.x, place.z)
    };
    let chosen = model.selected().map(|(_, shown)| from_above(shown));
    for (index, (center, heading_rad)) in cameras.into_iter().enumerate() {
        let (role, shape) = CAMERAS[index];
        let camera = PlanCamera {
            center,
            heading_rad,
            half_width: 1.0,
            mark: (role, shape),
        };
        let ends = image_ends(&state.turned.shown[index]).map(|x| camera.on_image(x, IMAGE_M));
        let axis = camera.on_image(0.0, 1.0) - center;
        plan::draw_ray(
            canvas,
            panel,
            &center,
            &axis,
            Stroke::solid(role, 1.0).dotted(),
        );
        if let Some(point) = chosen {
            canvas.line(at(center), at(point), Stroke::solid(LIT, 1.75));
        }
        for end in ends {
            canvas.line(at(center), at(end), Stroke::solid(role, 1.25));
        }
        canvas.line(at(ends[0]), at(ends[1]), Stroke::solid(role, 3.0));
        canvas.marker(at(center), 5.5, shape, role, true);
        let (x, y) = at(center);
        labels.keep_free((x, y), 8.0);
        let name = [
            ((x - 12.0, y + 9.0), Align::End),
            ((x + 12.0, y + 9.0), Align::Start),
        ];
        let style = TextStyle::new(role, TEXT).cased();
        labels.draw(canvas, &name[index..=index], ["O", "O′"][index], style);
    }
    for shown in &state.matches {
        canvas.disk(at(from_above(shown)), 2.5, Role::Muted, 1.0);
    }
    if let Some(place) = chosen.map(at) {
        canvas.marker(place, MARKER, Shape::Diamond, LIT, true);
        labels.name(canvas, (place, 8.0), "P", (Role::Ink, TEXT));
    }
    let (from, to) = (at(cameras[0].0), at(cameras[1].0));
    let beyond = to.0 + 40.0;
    let slope = (to.1 - from.1) / (to.0 - from.0);
    let place: Place = (beyond, from.1 + slope * (beyond - from.0));
    let style = TextStyle::new(Role::Muted, TEXT).cased();
    let beside = [14.0, -14.0].map(|off| ((place.0, place.1 + off), Align::Start));
    labels.draw(canvas, &beside, "baseline", style);
}
