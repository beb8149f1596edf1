//! Four views from above: the same rays, under each of the four poses.

use super::model::{EDGES, FourPoses, Pose, X_RANGE, Z_RANGE};
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Layout, Panel, Rect, View};
use crate::labels::Labels;
use crate::theme::Role;
use epipole::camera::RigidTransform;
use nalgebra::{Point3, Vector3};

const GAP: f64 = 10.0;
const TITLE: f64 = 24.0;
const TEXT: f64 = 13.0;
const NARROW: f64 = 500.0;
/// What a panel shows to the right of camera 1 and before it.
const HALF_WIDTH: f64 = 4.6;
const HALF_HEIGHT: f64 = 4.2;
/// How long and how wide the triangle is that stands for a camera.
const LENS: f64 = 0.55;
const CAMERAS: [(Role, Shape); 2] = [
    (Role::Series(0), Shape::Disk),
    (Role::Series(1), Shape::Square),
];
const PANELS: [(&str, &str); 4] = [
    ("first", "R, t"),
    ("second", "R, −t"),
    ("third", "half-turned R, t"),
    ("fourth", "half-turned R, −t"),
];

/// Draws [`FourPoses`].
#[derive(Default)]
pub(crate) struct FourPosesView;

impl View for FourPosesView {
    type Model = FourPoses;

    fn layout(&self, _: &FourPoses, width: f64) -> Layout {
        let cell = ((width - GAP) / 2.0).max(1.0);
        let height = cell * HALF_HEIGHT / HALF_WIDTH;
        let panel = |(index, (id, _)): (usize, &(&'static str, &str))| {
            let x = (index % 2) as f64 * (cell + GAP);
            let y = TITLE + (index / 2) as f64 * (height + TITLE + 6.0);
            Panel {
                id,
                rect: Rect::new(x, y, cell, height),
                x_axis: Axis {
                    start: -HALF_WIDTH,
                    end: HALF_WIDTH,
                },
                y_axis: Axis {
                    start: HALF_HEIGHT,
                    end: -HALF_HEIGHT,
                },
                clickable: false,
            }
        };
        Layout {
            width,
            height: 2.0 * (height + TITLE) + 8.0,
            panels: PANELS.iter().enumerate().map(panel).collect(),
        }
    }

    fn draw(&mut self, model: &FourPoses, layout: &Layout, canvas: &mut Canvas) {
        for (index, (id, name)) in PANELS.into_iter().enumerate() {
            let panel = layout.panel(id);
            canvas.panel(panel.rect);
            let pose = model.poses().get(index);
            let place = (panel.rect.x, panel.rect.y - TITLE / 2.0);
            let style = TextStyle::new(Role::Ink, TEXT);
            canvas.label(place, name, style);
            if let Some(pose) = pose {
                draw_count(model, pose, panel, layout.width < NARROW, canvas);
                draw_pose(pose, panel, index == 0, canvas);
            }
        }
        let first = layout.panel(PANELS[0].0);
        let (x, z) = model.place();
        let rect = first.rect.inset(1.0);
        canvas.clipped(rect, |canvas| {
            let (left, far) = first.canvas_from_world((X_RANGE[0], Z_RANGE[1]));
            let (right, near) = first.canvas_from_world((X_RANGE[1], Z_RANGE[0]));
            let room = Rect::new(left, far, right - left, near - far);
            canvas.stroke_rect(room, Stroke::solid(Role::Grid, 1.0).dashed());
            canvas.grip(first.canvas_from_world((x, z)), Role::Grip);
        });
        if model.poses().is_empty() {
            let words = "No step, no E: move camera 2.";
            let style = TextStyle::new(Role::Ink, TEXT).cased();
            canvas.paragraph(rect.inset(8.0), words, style);
        }
    }
}

/// How many points are in front of both cameras, at the right end of the title.
fn draw_count(model: &FourPoses, pose: &Pose, panel: &Panel, is_narrow: bool, canvas: &mut Canvas) {
    let (count, all) = (pose.num_in_front(), model.num_matches());
    let wins = count == all && all > 0;
    let text = match is_narrow {
        true => format!("{count} of {all}"),
        false => format!("{count} of {all} in front of both"),
    };
    let role = if wins { Role::Inlier } else { Role::Outlier };
    let place = (panel.rect.right(), panel.rect.y - TITLE / 2.0);
    canvas.label(place, &text, TextStyle::new(role, TEXT).end());
    if wins {
        canvas.stroke_rect(panel.rect, Stroke::solid(Role::Inlier, 3.0));
    }
}

fn draw_pose(pose: &Pose, panel: &Panel, is_held: bool, canvas: &mut Canvas) {
    let at = |point: &Point3<f64>| panel.canvas_from_world((point.x, point.z));
    let world_from_cam2 = pose.cam2_from_cam1.inverse();
    let centers = [
        Point3::origin(),
        Point3::from(world_from_cam2.translation.vector),
    ];
    canvas.clipped(panel.rect.inset(1.5), |canvas| {
        for (from, to) in EDGES {
            // A wall from before the cameras to behind them would pass through infinity.
            if let (Some(a), Some(b)) = (&pose.crossings[from], &pose.crossings[to])
                && a.in_front == b.in_front
            {
                let stroke = Stroke::solid(Role::Reference, 1.5);
                canvas.line(at(&a.point), at(&b.point), stroke);
            }
        }
        // The rays of the ridge's end: backward ones dotted.
        if let Some(crossing) = &pose.crossings[4] {
            for index in 0..2 {
                let stroke = Stroke::solid(CAMERAS[index].0, 1.25);
                let stroke = match crossing.in_front[index] {
                    true => stroke,
                    false => stroke.dotted(),
                };
                canvas.line(at(&centers[index]), at(&crossing.point), stroke);
            }
        }
        canvas.line(
            at(&centers[0]),
            at(&centers[1]),
            Stroke::solid(Role::Ink, 1.5),
        );
        draw_camera(&RigidTransform::identity(), 0, panel, canvas);
        draw_camera(&world_from_cam2, 1, panel, canvas);
        for crossing in pose.crossings.iter().flatten() {
            let place = at(&crossing.point);
            match crossing.is_good() {
                true => canvas.marker(place, 4.5, Shape::Disk, Role::Inlier, true),
                false => canvas.marker(place, 4.5, Shape::Cross, Role::Outlier, true),
            }
        }
    });
    let mut labels = Labels::new(panel.rect.inset(4.0));
    for center in &centers {
        labels.keep_free(at(center), 9.0);
    }
    for crossing in pose.crossings.iter().flatten() {
        labels.keep_free(at(&crossing.point), 6.0);
    }
    for (index, center) in centers.iter().enumerate() {
        let style = TextStyle::new(CAMERAS[index].0, TEXT).cased();
        let name = if panel.rect.width < 250.0 {
            ["1", "2"][index]
        } else {
            ["camera 1", "camera 2"][index]
        };
        let distance = if is_held && index == 1 { 12.0 } else { 8.0 };
        let mut around = Labels::around(at(center), distance);
        around.rotate_left(2);
        labels.draw(canvas, &around, name, style);
    }
}

/// A camera from above: its center, and a triangle open to where it looks.
fn draw_camera(world_from_cam: &RigidTransform, index: usize, panel: &Panel, canvas: &mut Canvas) {
    let (role, shape) = CAMERAS[index];
    let center = Point3::from(world_from_cam.translation.vector);
    let side = |sideways: f64| {
        let ray = world_from_cam.rotation * Vector3::new(sideways * LENS, 0.0, LENS * 1.2);
        panel.canvas_from_world((center.x + ray.x, center.z + ray.z))
    };
    let place = panel.canvas_from_world((center.x, center.z));
    let (left, right) = (side(-0.64), side(0.64));
    canvas.polygon(&[place, left, right], role, 0.25);
    canvas.polygon_outline(&[place, left, right], Stroke::solid(role, 1.5));
    canvas.marker(place, 4.5, shape, role, true);
}
