//! Selection of points by a line drawn around them.

use super::cloud::CloudView;
use super::look;
use super::marks::shows_surface;
use crate::project::Project;
use crate::session::Layers;
use egui::{PointerButton, Pos2, Rect, Response, Shape, Stroke, Ui};
use epipole_canvas::cloud::Orbit;
use epipole_canvas::theme::Role;

/// Minimum distance between corners of the line, points.
const STEP: f32 = 3.0;

impl CloudView {
    /// Returns the layers that are shown.
    pub(crate) fn layers(&self, project: &Project) -> Layers {
        Layers {
            sparse: self.shows_sparse(project),
            dense: self.dense,
            surface: shows_surface(project, self.surface),
        }
    }

    /// Draws the line of a drag; its end selects the points inside.
    ///
    /// * `size`: width and height of the picture, pixels
    pub(super) fn lasso(
        &mut self,
        project: &Project,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        (orbit, size): (&Orbit, (usize, usize)),
    ) {
        let line = &mut self.selection.line;
        // Two fingers move the view.
        let is_moving = ui.input(|input| input.multi_touch().is_some() || input.modifiers.shift);
        if is_moving {
            line.clear();
        } else if response.dragged_by(PointerButton::Primary)
            && let Some(at) = response.interact_pointer_pos()
        {
            if line.is_empty() {
                line.extend(ui.input(|input| input.pointer.press_origin()));
            }
            if line.last().is_none_or(|last| last.distance(at) >= STEP) {
                line.push(at);
            }
        }
        let color = look::color(ui, Role::Grip);
        let shape = Shape::closed_line(line.clone(), Stroke::new(2.0, color));
        ui.painter_at(rect).add(shape);
        if response.drag_stopped() {
            let scale = egui::vec2(size.0 as f32, size.1 as f32) / rect.size();
            let corner = |at: Pos2| {
                let at = (at - rect.min) * scale;
                [f64::from(at.x), f64::from(at.y)]
            };
            let corners: Vec<[f64; 2]> = line.drain(..).map(corner).collect();
            let is_inside = |place: [f64; 3]| {
                let seen = orbit.project(place.map(|x| x as f32), size);
                seen.is_some_and(|(at, _)| encloses(&corners, at))
            };
            if corners.len() >= 3 {
                let points = project.select(self.layers(project), is_inside);
                self.selection.add(project, &points);
            }
        }
    }
}

/// Whether a polygon encloses a point: a ray from it crosses the sides an odd number of times.
fn encloses(corners: &[[f64; 2]], [u, v]: [f64; 2]) -> bool {
    let mut is_inside = false;
    let mut from = corners.last().copied().unwrap_or_default();
    for &to in corners {
        let crosses = (from[1] > v) != (to[1] > v);
        if crosses && u < from[0] + (v - from[1]) / (to[1] - from[1]) * (to[0] - from[0]) {
            is_inside = !is_inside;
        }
        from = to;
    }
    is_inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_encloses_what_is_inside() {
        // The letter L.
        let corners = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 6.0],
            [5.0, 6.0],
            [5.0, 8.0],
            [0.0, 8.0],
        ];
        for inside in [[1.0, 1.0], [1.0, 7.0], [4.0, 7.0]] {
            assert!(encloses(&corners, inside), "{inside:?}");
        }
        for outside in [[3.0, 3.0], [-1.0, 1.0], [4.0, 9.0], [f64::NAN, 1.0]] {
            assert!(!encloses(&corners, outside), "{outside:?}");
        }
        assert!(!encloses(&[], [0.0, 0.0]));
    }
}
