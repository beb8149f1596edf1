//! Viewpoint of the point cloud: the initial one, and changes by pointer, touch and keys.

use crate::session::Remaining;
use crate::tasks::{CameraFound, Component};
use egui::{Key as KeyName, Response, Ui, Vec2};
use epipole_canvas::cloud::Orbit;

/// Rotates, pans and zooms. True while something moves.
///
/// * `is_selecting`: whether a drag of the first button selects instead
pub(crate) fn steer(
    orbit: &mut Orbit,
    ui: &Ui,
    response: &Response,
    size: (usize, usize),
    pixels: f32,
    is_selecting: bool,
) -> bool {
    let before = *orbit;
    let drag = response.drag_delta();
    let (keys, shift) = ui.input(|input| (input.modifiers, input.modifiers.shift));
    let touches = ui.input(egui::InputState::multi_touch);
    if let Some(touch) = touches.filter(|_| response.hovered() || response.dragged()) {
        let moved = touch.translation_delta * pixels;
        orbit.pan(f64::from(moved.x), f64::from(moved.y), size);
        orbit.zoom(f64::from(touch.zoom_delta));
    } else if drag != Vec2::ZERO {
        let second = response.dragged_by(egui::PointerButton::Secondary)
            || response.dragged_by(egui::PointerButton::Middle);
        if shift || second {
            let moved = drag * pixels;
            orbit.pan(f64::from(moved.x), f64::from(moved.y), size);
        } else if !is_selecting {
            orbit.rotate(f64::from(drag.x) * -0.008, f64::from(drag.y) * -0.008);
        }
    }
    if response.hovered() && touches.is_none() {
        let scrolled = ui.input(|input| input.smooth_scroll_delta().y);
        let pinched = ui.input(egui::InputState::zoom_delta);
        orbit.zoom(f64::from(pinched) * libm::exp(f64::from(scrolled) * 0.003));
    }
    if response.has_focus() {
        let step = |name: KeyName| ui.input(|input| input.num_presses(name) as f64);
        let right = step(KeyName::ArrowRight) - step(KeyName::ArrowLeft);
        let down = step(KeyName::ArrowDown) - step(KeyName::ArrowUp);
        if keys.shift {
            orbit.pan(24.0 * right, 24.0 * down, size);
        } else {
            orbit.rotate(-0.1 * right, -0.1 * down);
        }
        let nearer = step(KeyName::Plus) + step(KeyName::Equals) - step(KeyName::Minus);
        orbit.zoom(libm::exp(0.15 * nearer));
        // While the 3D view has the focus, the arrow keys must not move the focus.
        ui.memory_mut(|memory| {
            memory.set_focus_lock_filter(
                response.id,
                egui::EventFilter {
                    horizontal_arrows: true,
                    vertical_arrows: true,
                    ..egui::EventFilter::default()
                },
            );
        });
    }
    if response.clicked() {
        response.request_focus();
    }
    *orbit != before
}

/// Frames all cameras, and the remaining points except for the outermost, in the direction of
/// another view; without one, from behind the cameras and a little to the side.
pub(crate) fn frame(
    orbit: &mut Orbit,
    component: &Component,
    kept: &Remaining<'_>,
    side: Option<Orbit>,
) {
    const ASIDE_RAD: f64 = 0.35;
    let cameras = || component.cameras.iter().flatten();
    let ahead = |camera: &CameraFound| {
        let [_, _, cu, cv] = camera.intrinsics;
        camera.ray([cu, cv]).normalize()
    };
    let forward: nalgebra::Vector3<f64> = cameras().map(ahead).sum();
    match side {
        Some(before) => (orbit.yaw_rad, orbit.pitch_rad) = (before.yaw_rad, before.pitch_rad),
        None => {
            orbit.look_along(forward.into());
            orbit.rotate(ASIDE_RAD, 0.0);
        }
    }
    let middle = orbit.middle;
    let away = |place: &[f64; 3]| (nalgebra::Point3::from(*place) - middle).norm_squared();
    let all = component
        .points
        .iter()
        .filter(|point| kept.has_point(point));
    let all = all.map(|point| point.position);
    let mut by_distance: Vec<(f64, [f64; 3])> = all.map(|place| (away(&place), place)).collect();
    by_distance.retain(|(away, _)| away.is_finite());
    let num_near = by_distance.len() * 19 / 20;
    if num_near < by_distance.len() {
        by_distance.select_nth_unstable_by(num_near, |(a, _), (b, _)| a.total_cmp(b));
        by_distance.truncate(num_near);
    }
    let mut places: Vec<[f64; 3]> = by_distance.into_iter().map(|(_, place)| place).collect();
    places.extend(cameras().map(|camera| <[f64; 3]>::from(camera.center().coords)));
    orbit.fit(&places);
}
