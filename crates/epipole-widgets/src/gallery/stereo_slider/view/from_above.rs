//! Top view of the rig: rays, image planes with the similar triangles of Z = f B / d, and the
//! depths that a pixel of error leaves possible.

use super::super::model::DEPTH_RANGE_M;
use super::super::rig::{Measured, Rig};
use super::super::words::reach;
use super::style::UNCERTAIN;
use crate::canvas::{Align, Canvas, Place, Stroke, TextStyle};
use crate::contract::{Panel, Rect, format_number};
use crate::kit::grid::{self, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::CAMERAS;
use crate::kit::plan::{self, draw_span};
use crate::kit::scenes::PHOTO_WIDTH;
use crate::theme::Role;

/// Extent of the table: left, right, near and far edge, meters.
const TABLE_M: [f64; 4] = [-0.95, 0.95, 0.35, 11.35];
/// Visible range to each side of the left camera, and beyond the farthest ball, meters.
const SIDE_M: f64 = 1.0;
const BEYOND_M: f64 = 0.8;
/// Height below the cameras for the baseline and its length, CSS pixels.
const BELOW: f64 = 36.0;
/// Distance of a drawn image plane at a focal length of 1000 pixels, meters; at true scale it would
/// be too close to see.
const PLANE_M: f64 = 1.9;
/// Maximum distance of the image plane, as a fraction of the ball's depth.
const NEARER: f64 = 0.6;
/// Width below which there is room only for the shortest labels, CSS pixels.
const SMALL: f64 = 300.0;

/// Creates the panel, stretched horizontally to make the baseline visible.
pub(super) fn panel(rect: Rect) -> Panel {
    let far = DEPTH_RANGE_M[1] + BEYOND_M;
    let below = -far * BELOW / (rect.height - BELOW).max(1.0);
    Panel::new("top", rect, [-SIDE_M, SIDE_M], [far, below]).clickable()
}

/// Draws the view; without a measurement, only the cameras and their rays.
pub(super) fn draw(rig: &Rig, measured: Option<Measured>, panel: &Panel, canvas: &mut Canvas) {
    let rect = panel.rect;
    let is_small = rect.width < SMALL || rect.height < SMALL;
    let titles = ["From above, stretched sideways", "From above, stretched"];
    grid::fitting_title(canvas, rect, &titles);
    canvas.panel(rect);
    let inner = rect.inset(1.0);
    let mut labels = Labels::new(rect.inset(3.0));
    let at = |x: f64, z: f64| panel.canvas_from_world((x, z));
    canvas.clipped(inner, |canvas| {
        draw_table(canvas, panel);
        plan::draw_distances(canvas, panel, "m");
        if let Some(measured) = measured {
            draw_uncertainty(canvas, panel, rig, measured);
        }
        for (index, camera_x) in [0.0, rig.baseline_m].into_iter().enumerate() {
            let (role, _) = CAMERAS[index];
            canvas.line(
                at(camera_x, 0.0),
                at(rig.x_m, rig.z_m),
                Stroke::solid(role, 1.75),
            );
            let beyond = panel.y_axis.start / rig.z_m;
            let end = at(camera_x + (rig.x_m - camera_x) * beyond, panel.y_axis.start);
            canvas.line(at(rig.x_m, rig.z_m), end, Stroke::solid(role, 1.0).dotted());
        }
    });
    labels.keep_free(at(rig.x_m, rig.z_m), 10.0);
    draw_cameras(canvas, panel, &mut labels, rig);
    canvas.clipped(inner, |canvas| {
        if let Some(measured) = measured {
            draw_triangles(canvas, panel, &mut labels, rig, measured, is_small);
        }
        canvas.grip(at(rig.x_m, rig.z_m), Role::Grip);
    });
    if let Some(measured) = measured {
        draw_numbers(canvas, panel, &mut labels, rig, measured, is_small);
    }
}

fn draw_table(canvas: &mut Canvas, panel: &Panel) {
    let (left, far) = panel.canvas_from_world((TABLE_M[0], TABLE_M[3]));
    let (right, near) = panel.canvas_from_world((TABLE_M[1], TABLE_M[2]));
    let table = Rect::new(left, far, right - left, near - far);
    canvas.fill_rect(table, Role::Background, 1.0);
    canvas.stroke_rect(table, Stroke::solid(Role::Grid, 1.0));
}

/// Draws the depths possible within one pixel of error: a band, and the part of the left ray in it.
fn draw_uncertainty(canvas: &mut Canvas, panel: &Panel, rig: &Rig, measured: Measured) {
    let near_m = measured.interval.near_m;
    let far_m = measured.interval.far_m.unwrap_or(f64::INFINITY);
    let shown_far_m = far_m.min(panel.y_axis.start);
    let along_left = |z: f64| panel.canvas_from_world((rig.x_m / rig.z_m * z, z));
    let (near, far) = (along_left(near_m), along_left(shown_far_m));
    let rect = panel.rect;
    let band = Rect::new(rect.x, far.1, rect.width, near.1 - far.1);
    canvas.fill_rect(band, UNCERTAIN, 0.14);
    for (y, is_edge) in [(near.1, true), (far.1, far_m < panel.y_axis.start)] {
        if is_edge {
            let stroke = Stroke::solid(UNCERTAIN, 1.0);
            canvas.line((rect.x, y), (rect.right(), y), stroke);
        }
    }
    // The region allowed by the right camera: between the rays of the columns one pixel to either
    // side.
    let right = panel.canvas_from_world((rig.baseline_m, 0.0));
    canvas.polygon(&[right, near, far], UNCERTAIN, 0.35);
    canvas.line(near, far, Stroke::solid(UNCERTAIN, 5.0));
}

fn draw_cameras(canvas: &mut Canvas, panel: &Panel, labels: &mut Labels, rig: &Rig) {
    let (left, y) = panel.canvas_from_world((0.0, 0.0));
    let right = panel.canvas_from_world((rig.baseline_m, 0.0)).0;
    let plane_m = plane_m(rig);
    let half_m = f64::from(PHOTO_WIDTH) / 2.0 / rig.focal_px * plane_m;
    for (index, camera_x) in [0.0, rig.baseline_m].into_iter().enumerate() {
        let (role, shape) = CAMERAS[index];
        let at = |x: f64, z: f64| panel.canvas_from_world((camera_x + x, z));
        for side in [-half_m, half_m] {
            canvas.line(
                at(0.0, 0.0),
                at(side, plane_m),
                Stroke::solid(role, 1.0).dotted(),
            );
        }
        // Both image planes are on one line, so the right one is drawn slightly above it.
        let lift = 2.5 * (0.5 - index as f64);
        let end = |x: f64| (at(x, plane_m).0, at(x, plane_m).1 + lift);
        canvas.line(end(-half_m), end(half_m), Stroke::solid(role, 2.5));
        labels.keep_line_free(end(-half_m), end(half_m));
        canvas.marker(at(0.0, 0.0), 5.5, shape, role, true);
        labels.keep_free(at(0.0, 0.0), 7.0);
    }
    draw_span(
        canvas,
        (left, y + 15.0),
        (right, y + 15.0),
        Stroke::solid(Role::Ink, 1.5),
    );
    labels.keep_rect_free(Rect::new(left - 4.0, y + 8.0, right - left + 8.0, 14.0));
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    let text = format!("B = {} m", format_number(rig.baseline_m, 2));
    labels.draw(
        canvas,
        &[((right + 10.0, y + 16.0), Align::Start)],
        &text,
        style,
    );
    let (edge, plane_y) = panel.canvas_from_world((-half_m, plane_m));
    let text = "image plane";
    let places = [
        ((edge - 4.0, plane_y), Align::End),
        ((edge, plane_y - 12.0), Align::Start),
    ];
    labels.draw(
        canvas,
        &places,
        text,
        TextStyle::new(Role::Muted, grid::SMALL).cased(),
    );
}

fn plane_m(rig: &Rig) -> f64 {
    (PLANE_M * rig.focal_px / 1000.0).min(NEARER * rig.z_m)
}

/// Draws the similar triangles: the large one from the baseline to the ball, and the small one on
/// the image plane, between the right ray and the left ray shifted to the right camera.
fn draw_triangles(
    canvas: &mut Canvas,
    panel: &Panel,
    labels: &mut Labels,
    rig: &Rig,
    measured: Measured,
    is_small: bool,
) {
    let at = |x: f64, z: f64| panel.canvas_from_world((x, z));
    let (b, plane_m) = (rig.baseline_m, plane_m(rig));
    let share = plane_m / rig.z_m;
    let ball = at(rig.x_m, rig.z_m);
    let (left, right) = (at(0.0, 0.0), at(b, 0.0));
    canvas.polygon(&[left, right, ball], Role::Ink, 0.10);
    // Intersections of the right ray and the shifted left ray with the image plane, and their ends.
    let on_plane = [b + (rig.x_m - b) * share, b + rig.x_m * share].map(|x| at(x, plane_m));
    canvas.polygon(&[right, on_plane[0], on_plane[1]], Role::Grip, 0.45);
    let stroke = Stroke::solid(CAMERAS[0].0, 1.5).dashed();
    canvas.line(right, at(b + rig.x_m, rig.z_m), stroke);
    let seen_left = at(rig.x_m * share, plane_m);
    for (place, index) in [(seen_left, 0), (on_plane[0], 1)] {
        let (role, shape) = CAMERAS[index];
        canvas.marker(place, 3.5, shape, role, true);
    }
    let (role, shape) = CAMERAS[0];
    canvas.hollow_marker(on_plane[1], 3.5, shape, role, true);
    for place in [seen_left, on_plane[0], on_plane[1]] {
        labels.keep_free(place, 5.0);
    }
    labels.keep_line_free(right, ball);
    labels.keep_line_free(left, ball);
    let text = match is_small {
        true => "d".to_owned(),
        false => format!("d = {} px", format_number(measured.disparity_px, 1)),
    };
    let (x, y) = (on_plane[0].0.max(on_plane[1].0), on_plane[1].1);
    let places: [(Place, Align); 4] = [
        ((x + 9.0, y + 11.0), Align::Start),
        ((x + 9.0, y - 11.0), Align::Start),
        ((x + 9.0, y), Align::Start),
        ((on_plane[0].0 - 9.0, y - 12.0), Align::End),
    ];
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    labels.draw(canvas, &places, &text, style);
}

fn draw_numbers(
    canvas: &mut Canvas,
    panel: &Panel,
    labels: &mut Labels,
    rig: &Rig,
    measured: Measured,
    is_small: bool,
) {
    let rect = panel.rect;
    let (x, y) = panel.canvas_from_world((rig.x_m, rig.z_m));
    let text = format!("Z = {} m", format_number(measured.depth_m, 2));
    let places = [
        ((x + 15.0, y + 2.0), Align::Start),
        ((x - 15.0, y + 2.0), Align::End),
        ((x + 13.0, y + 18.0), Align::Start),
        ((x - 13.0, y + 18.0), Align::End),
        ((x + 13.0, y - 18.0), Align::Start),
    ];
    labels.draw(
        canvas,
        &places,
        &text,
        TextStyle::new(Role::Ink, TEXT).cased(),
    );
    if is_small {
        return;
    }
    let row = |z: f64| panel.canvas_from_world((0.0, z)).1;
    let near_y = row(measured.interval.near_m);
    let far_y = row(measured
        .interval
        .far_m
        .unwrap_or(1e3)
        .min(panel.y_axis.start));
    // On the side away from the ball.
    let (x, align) = if rig.x_m < 0.0 {
        (rect.right() - 8.0, Align::End)
    } else {
        (rect.x + 44.0, Align::Start)
    };
    let places = [far_y - 12.0, near_y + 12.0, (near_y + far_y) / 2.0].map(|y| ((x, y), align));
    let text = format!("±1 px: {}", reach(&measured.interval));
    labels.draw(
        canvas,
        &places,
        &text,
        TextStyle::new(UNCERTAIN, TEXT).cased(),
    );
}
