//! Top view of the block with three paths around it.

use super::super::drive::centers;
use super::super::model::ScaleDrift;
use super::super::question::Judged;
use super::style::{AFTER, BEFORE, TRUTH};
use crate::canvas::{Align, Canvas, Place, Shape, Stroke, TextStyle, text_width};
use crate::contract::{Panel, Rect, format_number};
use crate::kit::grid::{SMALL, TEXT};
use crate::kit::labels::Labels;
use crate::kit::plan;
use crate::theme::Role;
use epipole::camera::RigidTransform;
use nalgebra::{Point3, Vector3};

/// Margin around all paths, as a fraction of their extent.
const MARGIN: f64 = 0.05;
/// Approximate number of cameras drawn on a path.
const NUM_CAMERAS: usize = 10;
/// Size of a camera's arrowhead at scale 1, in true steps.
const ARROW: f64 = 1.6;
/// Height of the scale bar below the paths, CSS pixels.
const RULE_ROOM: f64 = 22.0;

/// Projects a point to the top view, with the initial heading to the right: z to the right, and the
/// left side up.
fn from_above(point: &Point3<f64>) -> Place {
    (point.z, -point.x)
}

/// Creates a panel that contains all paths, with one scale for both directions.
pub(super) fn panel(model: &ScaleDrift, rect: Rect) -> Panel {
    let (mut low, mut high) = ((0.0_f64, 0.0_f64), (0.0_f64, 0.0_f64));
    let mut cover = |(x, y): Place| {
        low = (low.0.min(x), low.1.min(y));
        high = (high.0.max(x), high.1.max(y));
    };
    // The whole drive, so that the map does not change while the camera moves.
    let drive = &model.drive;
    centers(&drive.truth)
        .iter()
        .map(from_above)
        .for_each(&mut cover);
    let after = model.after();
    let after = after
        .iter()
        .flat_map(|after| after.poses.iter().zip(&after.scale));
    for (pose, scale) in drive.believed.iter().zip(&drive.scale).chain(after) {
        arrow(pose, *scale).into_iter().for_each(&mut cover);
    }
    let (width, height) = (rect.width.max(1.0), (rect.height - RULE_ROOM).max(1.0));
    let per_pixel = ((high.0 - low.0) / width).max((high.1 - low.1) / height);
    let per_pixel = per_pixel * (1.0 + 2.0 * MARGIN);
    let middle = (low.0 + high.0) / 2.0;
    let below = (low.1 + high.1 - RULE_ROOM * per_pixel) / 2.0;
    plan::panel(
        "map",
        rect,
        (middle, below),
        rect.height.max(1.0) * per_pixel / 2.0,
    )
}

pub(super) fn draw(model: &ScaleDrift, map: &Panel, canvas: &mut Canvas) {
    let at = |center: &Point3<f64>| map.canvas_from_world(from_above(center));
    let places = |path: &[RigidTransform]| -> Vec<Place> { centers(path).iter().map(at).collect() };
    let truth = places(&model.drive.truth);
    let before = places(&model.before.poses);
    let after = model.after();
    let rect = map.rect.inset(1.0);
    let (start, end) = (truth[0], before[before.len() - 1]);
    canvas.clipped(rect, |canvas| {
        canvas.polygon(&truth, Role::Grid, 0.7);
        draw_cameras(&model.before, model, Role::Series(1), map, canvas);
        if let Some(after) = after {
            draw_cameras(after, model, Role::Best, map, canvas);
            canvas.polyline(&places(&after.poses), AFTER);
        }
        canvas.polyline(&before, BEFORE);
        canvas.polyline(&truth, TRUTH);
        if model.is_home() {
            canvas.line(end, start, Stroke::solid(Role::Ink, 1.25));
        }
        canvas.marker(start, 5.0, Shape::Disk, Role::Ink, true);
        canvas.marker(end, 5.0, Shape::Square, Role::Series(1), true);
        if !model.is_home() {
            let place = truth[model.traveled()];
            canvas.marker(place, 5.0, Shape::Diamond, Role::Truth, true);
        }
    });
    plan::draw_rule(canvas, map, |length| {
        let plural = if length > 1.0 { "steps" } else { "step" };
        format!("{} {plural}", format_number(length, 0))
    });
    let after = after.map_or_else(Vec::new, |after| places(&after.poses));
    draw_labels(model, map, [&truth, &before, &after], canvas);
}

/// Draws the camera every few frames, as an arrowhead whose size is that of reconstructed objects
/// around it.
fn draw_cameras(path: &Judged, model: &ScaleDrift, role: Role, map: &Panel, canvas: &mut Canvas) {
    let stride = (model.num_steps() / NUM_CAMERAS).max(1);
    for (pose, scale) in path.poses.iter().zip(&path.scale).step_by(stride) {
        let arrow = arrow(pose, *scale).map(|place| map.canvas_from_world(place));
        canvas.polygon(&arrow, role, 0.22);
        canvas.polygon_outline(&arrow, Stroke::solid(role, 1.0));
    }
}

/// Returns the arrowhead of a camera, in steps: its tip is ahead, the camera in the middle of its
/// back edge.
fn arrow(pose: &RigidTransform, scale: f64) -> [Place; 3] {
    [(0.0, 1.2), (-0.6, 0.0), (0.6, 0.0)].map(|(sideways, ahead)| {
        let ray = Vector3::new(sideways, 0.0, ahead) * (ARROW * scale);
        from_above(&Point3::from(pose.translation.vector + pose.rotation * ray))
    })
}

fn draw_labels(
    model: &ScaleDrift,
    map: &Panel,
    [truth, before, after]: [&[Place]; 3],
    canvas: &mut Canvas,
) {
    let (start, end) = (truth[0], before[before.len() - 1]);
    let path = &model.before;
    let mut labels = Labels::new(map.rect.inset(4.0));
    for path in [truth, before, after] {
        for pair in path.windows(2) {
            labels.keep_line_free(pair[0], pair[1]);
        }
    }
    for mark in [start, end] {
        labels.keep_free(mark, 7.0);
    }
    if model.is_home() {
        labels.keep_line_free(start, end);
    }
    if let (Some(pose), Some(scale)) = (path.poses.last(), path.scale.last()) {
        for corner in arrow(pose, *scale) {
            labels.keep_line_free(end, map.canvas_from_world(corner));
        }
    }
    let rule = text_width("100 steps", SMALL) + 90.0;
    let corner = Rect::new(map.rect.x, map.rect.bottom() - 24.0, rule, 24.0);
    labels.keep_rect_free(corner);
    let ink = TextStyle::new(Role::Ink, TEXT).cased();
    labels.draw(canvas, &around(start), "start", ink);
    let orange = TextStyle::new(Role::Series(1), TEXT).cased();
    if !model.is_home() {
        let place = truth[model.traveled()];
        labels.keep_free(place, 7.0);
        let pink = TextStyle::new(Role::Truth, TEXT).cased();
        labels.draw(canvas, &around(place), "really here", pink);
        labels.draw(canvas, &around(end), "believed here", orange);
        return;
    }
    let length = libm::hypot(end.0 - start.0, end.1 - start.1);
    if length > 24.0 {
        labels.draw(canvas, &around(end), "end, by odometry", orange);
    }
    if length > 60.0 {
        let middle = ((start.0 + end.0) / 2.0, (start.1 + end.1) / 2.0);
        labels.draw(canvas, &around(middle), "gap", ink);
    }
}

fn around(place: Place) -> Vec<(Place, Align)> {
    let mut all = Labels::around(place, 9.0).to_vec();
    all.extend(Labels::around(place, 18.0));
    all
}
