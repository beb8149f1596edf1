//! Top views of the four poses, side by side, with the corners in front of both cameras marked.

use super::model::{FourPoses, X_RANGE, Z_RANGE};
use super::poses::{EDGES, FOCAL_PX, Pose, RIDGE, SIZE};
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::{CAMERAS, border_arrow};
use crate::kit::plan::{self, PlanCamera};
use crate::theme::Role;
use nalgebra::{Point2, Point3, Vector3};

/// Minimum extent of a panel around camera 1, scene units: to each side, and along its axis.
const HALF_WIDTH: f64 = 3.2;
const HALF_DEPTH: f64 = 3.9;
/// Height of a panel on a phone, CSS pixels.
const LOW: f64 = 150.0;
/// Distance of the drawn image plane from its camera, scene units.
const LENS: f64 = 0.6;
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
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &FourPoses, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let rects = if grid::is_narrow(width) {
            let [first, second] = grid.shares([1.0; 2], LOW);
            let [third, fourth] = grid.shares([1.0; 2], LOW);
            [first, second, third, fourth]
        } else {
            grid.row([1.3; 4], 400.0)
        };
        let panels = PANELS.into_iter().zip(rects).map(|((id, _), rect)| {
            let half_depth = HALF_DEPTH.max(HALF_WIDTH * rect.height / rect.width.max(1.0));
            plan::panel(id, rect, (0.0, 0.0), half_depth)
        });
        grid.layout(panels.collect())
    }

    fn draw(&mut self, model: &FourPoses, layout: &Layout, canvas: &mut Canvas) {
        for (index, (id, name)) in PANELS.into_iter().enumerate() {
            let panel = layout.panel(id);
            grid::open(canvas, panel, &[name]);
            if index == 0 {
                draw_room(panel, canvas);
            }
            if let Some(pose) = model.poses().get(index) {
                draw_count(model, pose, panel, canvas);
                draw_pose(pose, panel, index == 0, canvas);
            }
        }
        let first = layout.panel(PANELS[0].0);
        canvas.grip(first.canvas_from_world(model.camera2.place()), Role::Grip);
        if model.poses().is_empty() {
            grid::notice(canvas, first.rect, "No step, no E: move camera 2.");
        }
    }
}

/// Draws the range of camera 2.
fn draw_room(panel: &Panel, canvas: &mut Canvas) {
    let room = panel.rect_between((X_RANGE[0], Z_RANGE[1]), (X_RANGE[1], Z_RANGE[0]));
    canvas.stroke_rect(room, Stroke::solid(Role::Grid, 1.0).dashed());
}

/// Whether there is room for text beside the marks.
fn is_wordy(panel: &Panel) -> bool {
    panel.rect.width >= 240.0
}

/// Draws the number of corners in front of both cameras, and frames the panel if all are.
fn draw_count(model: &FourPoses, pose: &Pose, panel: &Panel, canvas: &mut Canvas) {
    let (count, all) = (pose.num_in_front(), model.num_matches());
    let wins = count == all && all > 0;
    let wide = if is_wordy(panel) { " in front" } else { "" };
    let text = format!("{count} of {all}{wide}");
    let role = if wins { Role::Inlier } else { Role::Outlier };
    let place = (panel.rect.right(), panel.rect.y - grid::TITLE / 2.0);
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
    let inner = panel.rect.inset(1.5);
    canvas.clipped(inner, |canvas| {
        draw_house(pose, panel, canvas);
        // Rays of the ridge's end; dotted if they meet behind the camera.
        if let Some(crossing) = &pose.crossings[RIDGE] {
            for (index, center) in centers.iter().enumerate() {
                let stroke = Stroke::solid(CAMERAS[index].0, 1.25);
                let stroke = stroke.dotted_if(!crossing.in_front[index]);
                canvas.line(at(center), at(&crossing.point), stroke);
            }
        }
        let baseline = Stroke::solid(Role::Ink, 1.5);
        canvas.line(at(&centers[0]), at(&centers[1]), baseline);
        let ahead = [Vector3::z(), world_from_cam2.rotation * Vector3::z()];
        for index in 0..2 {
            let camera = PlanCamera {
                center: Point2::new(centers[index].x, centers[index].z),
                heading_rad: libm::atan2(ahead[index].x, ahead[index].z),
                half_width: f64::from(SIZE.0) / 2.0 / FOCAL_PX,
                mark: CAMERAS[index],
            };
            camera.draw(canvas, panel, LENS);
        }
    });
    let mut labels = Labels::new(panel.rect.inset(4.0));
    for crossing in pose.crossings.iter().flatten() {
        let place = at(&crossing.point);
        let (role, shape) = match crossing.is_good() {
            true => (Role::Inlier, Shape::Disk),
            false => (Role::Outlier, Shape::Cross),
        };
        if !inner.contains(place) {
            // Outside the panel: an arrow points to the corner.
            if let Some((from, to)) = border_arrow(inner, place) {
                canvas.arrow(shorter(from, to), to, Stroke::solid(role, 1.5));
            }
            continue;
        }
        canvas.marker(place, 4.0, shape, role, true);
        labels.keep_free(place, 6.0);
    }
    for center in &centers {
        labels.keep_free(at(center), 9.0);
    }
    let names = match is_wordy(panel) {
        true => ["camera 1", "camera 2"],
        false => ["1", "2"],
    };
    for (index, center) in centers.iter().enumerate() {
        let style = TextStyle::new(CAMERAS[index].0, TEXT).cased();
        let distance = if is_held && index == 1 { 12.0 } else { 8.0 };
        let mut around = Labels::around(at(center), distance);
        around.rotate_left(2);
        labels.draw(canvas, &around, names[index], style);
    }
}

/// Draws the walls and the ridge, except for edges with one end in front of a camera and the other
/// behind it, which would pass through infinity.
fn draw_house(pose: &Pose, panel: &Panel, canvas: &mut Canvas) {
    let at = |point: &Point3<f64>| panel.canvas_from_world((point.x, point.z));
    let base = pose.crossings[..4].iter().flatten();
    let base: Vec<Place> = base.map(|corner| at(&corner.point)).collect();
    let mut sides = pose
        .crossings
        .iter()
        .flatten()
        .map(|corner| corner.in_front);
    let first = sides.next();
    if base.len() == 4 && sides.all(|side| Some(side) == first) {
        canvas.polygon(&base, Role::Reference, 0.16);
    }
    let stroke = Stroke::solid(Role::Reference, 1.5);
    for (from, to) in EDGES {
        if let (Some(a), Some(b)) = (&pose.crossings[from], &pose.crossings[to])
            && a.in_front == b.in_front
        {
            canvas.line(at(&a.point), at(&b.point), stroke);
        }
    }
}

/// Returns a start for an arrow closer to its tip.
fn shorter(from: Place, to: Place) -> Place {
    ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0)
}
