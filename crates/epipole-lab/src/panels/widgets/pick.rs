//! Picking of a point in 3D by mouse, touch or key.

use super::look;
use egui::{Rect, Response, Ui};
use epipole_canvas::cloud::{Frame, Orbit, Scene};
use epipole_canvas::theme::Role;

/// Result of a click in the 3D view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Click {
    /// No point was near.
    Missed,
    /// A sparse point, by index.
    Point(usize),
    /// A point of dense depth, counted from the first one.
    Dense(usize),
    /// A vertex of the surface, by index.
    Vertex(usize),
}

/// Maximum distance from the click for a mouse, points; then for touch.
const REACH: f32 = 8.0;
const REACH_OF_FINGER: f32 = 22.0;
/// A sparse point behind dense ones lies on the same surface if it is at most this many times as
/// far away.
const SAME_DEPTH: f64 = 1.05;

/// Returns the clicked point; a key clicks in the middle.
///
/// * `num_shared`: number of sparse points of the scene; dense ones follow, then vertices
pub(super) fn pick(
    response: &Response,
    rect: Rect,
    frame: &Frame,
    scene: &Scene,
    orbit: &Orbit,
    num_shared: usize,
) -> Click {
    let place = response.interact_pointer_pos().unwrap_or(rect.center());
    let at = (place - rect.min) / rect.size();
    let (width, height) = frame.size();
    let at = [at.x * width as f32, at.y * height as f32].map(f64::from);
    let reach = match response.ctx.input(egui::InputState::has_touch_screen) {
        true => REACH_OF_FINGER,
        false => REACH,
    };
    let reach_px = (reach * width as f32 / rect.width()).ceil().max(1.0) as usize;
    match frame.pick(at[0], at[1], reach_px) {
        None => Click::Missed,
        Some(point) if point < num_shared => Click::Point(point),
        Some(point) => {
            let reach_px = 0.5 * reach_px as f64;
            match shared_at(at, reach_px, frame, scene, orbit, num_shared, point) {
                Some(shared) => Click::Point(shared),
                None if point < scene.first_vertex => Click::Dense(point - num_shared),
                None => Click::Vertex(point - scene.first_vertex),
            }
        }
    }
}

/// Finds the sparse point nearest to a pixel, on the surface of a dense point that hides it, since
/// sparse points are more accurate.
fn shared_at(
    [u, v]: [f64; 2],
    reach_px: f64,
    frame: &Frame,
    scene: &Scene,
    orbit: &Orbit,
    num_shared: usize,
    dense: usize,
) -> Option<usize> {
    let size = frame.size();
    let (_, depth) = orbit.project(scene.points.get(dense)?.0, size)?;
    let mut best: Option<(f64, usize)> = None;
    for (index, (place, _)) in scene.points.iter().take(num_shared).enumerate() {
        let Some(([column, row], away)) = orbit.project(*place, size) else {
            continue;
        };
        let off_px = libm::hypot(column - u, row - v);
        if off_px <= reach_px
            && away <= SAME_DEPTH * depth
            && best.is_none_or(|(least, _)| off_px < least)
        {
            best = Some((off_px, index));
        }
    }
    best.map(|(_, index)| index)
}

/// Draws the crosshair at which Enter clicks.
pub(super) fn crosshair(ui: &Ui, rect: Rect) {
    let stroke = egui::Stroke::new(1.5, look::color(ui, Role::Grip));
    let middle = rect.center();
    for arm in [egui::vec2(9.0, 0.0), egui::vec2(0.0, 9.0)] {
        for side in [-1.0, 1.0] {
            let ends = [middle + 0.4 * side * arm, middle + side * arm];
            ui.painter().line_segment(ends, stroke);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shared_point_behind_its_own_surface_is_preferred() {
        // A sparse point, with dense ones in front of it: on its surface, then far in front.
        let shared = ([0.0, 0.0, 1.0], [255; 3]);
        let near = |z: f32| ([0.01, 0.0, z], [9; 3]);
        let corner = |x: f32| ([x, x, 1.0], [9; 3]);
        let chosen = |front: f32| {
            let scene = Scene {
                points: vec![shared, near(front), corner(-1.0), corner(1.0)],
                first_vertex: 4,
                ..Scene::default()
            };
            let mut orbit = Orbit::around(&scene, [0.0, 1.0, 0.0]);
            orbit.look_along([0.0, 0.0, 1.0]);
            let look = epipole_canvas::cloud::Look {
                point_px: 3.0,
                every: 1,
                background: [0; 3],
            };
            let mut frame = Frame::default();
            frame.draw(&scene, &orbit, (400, 400), &look);
            let (at, _) = orbit.project(shared.0, (400, 400)).expect("it is in front");
            shared_at(at, 8.0, &frame, &scene, &orbit, 1, 1)
        };
        assert_eq!(chosen(0.99), Some(0));
        assert_eq!(chosen(-1.0), None);
    }
}
