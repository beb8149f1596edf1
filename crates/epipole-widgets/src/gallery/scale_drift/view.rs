//! The block from above with the three paths around it, and beside it the scale of each frame.

use super::answer::Judged;
use super::drive::centers;
use super::model::ScaleDrift;
use super::plot;
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle, text_width};
use crate::contract::{Axis, Layout, Panel, Rect, View, format_number};
use crate::labels::Labels;
use crate::legend::{self, Entry, Swatch};
use crate::theme::Role;
use epipole::camera::RigidTransform;
use nalgebra::{Point3, Vector3};

const GAP: f64 = 14.0;
const TITLE: f64 = 24.0;
const TEXT: f64 = 13.0;
const SMALL: f64 = 12.0;
/// Below this width the plot is under the map.
const NARROW: f64 = 560.0;
/// Share of a wide page that the map takes.
const MAP_SHARE: f64 = 0.58;
/// Around all paths, as a share of their extent.
const MARGIN: f64 = 0.05;
/// About how many cameras are drawn on a path.
const NUM_CAMERAS: usize = 10;
/// How large the arrowhead of a camera of the right scale is, in true steps.
const ARROW: f64 = 1.6;
/// Height below the paths that the rule takes, CSS pixels.
const RULE_ROOM: f64 = 22.0;
/// The rule is never shorter than this, CSS pixels.
const RULE: f64 = 36.0;

/// Draws [`ScaleDrift`].
#[derive(Default)]
pub(crate) struct ScaleDriftView;

pub(super) fn truth_stroke() -> Stroke {
    Stroke::solid(Role::Truth, 1.75).dotted()
}

pub(super) fn before_stroke() -> Stroke {
    Stroke::solid(Role::Series(1), 1.75).dashed()
}

pub(super) fn after_stroke() -> Stroke {
    Stroke::solid(Role::Best, 2.25)
}

fn legend_entries() -> [Entry; 3] {
    [
        (Swatch::Line(truth_stroke()), "truth"),
        (Swatch::Line(before_stroke()), "odometry"),
        (Swatch::Line(after_stroke()), "loop closed"),
    ]
}

/// From above, with the first heading to the right: z to the right, and the left side up.
fn from_above(point: &Point3<f64>) -> Place {
    (point.z, -point.x)
}

impl View for ScaleDriftView {
    type Model = ScaleDrift;

    fn layout(&self, model: &ScaleDrift, width: f64) -> Layout {
        let legend_height = |width| legend::height(&legend_entries(), width, 0.0);
        let (map, plot) = if width < NARROW {
            let map = Rect::new(0.0, TITLE, width, (width * 0.78).max(1.0));
            let top = map.bottom() + 6.0 + legend_height(width);
            (map, Rect::new(0.0, top, width, 212.0))
        } else {
            let left = MAP_SHARE * width;
            let height = (left * 0.82).min(460.0);
            let rest = width - left - GAP;
            let map = Rect::new(0.0, TITLE, left, height);
            let room = height + TITLE - legend_height(rest) - 6.0;
            (map, Rect::new(left + GAP, 0.0, rest, room))
        };
        let (x_axis, y_axis) = map_axes(model, map);
        let height = map.bottom().max(plot.bottom()) + 2.0;
        let map = Panel {
            id: "map",
            rect: map,
            x_axis,
            y_axis,
            clickable: false,
        };
        let [plot, track] = plot::panels(model, plot);
        Layout {
            width,
            height,
            panels: vec![map, plot, track],
        }
    }

    fn draw(&mut self, model: &ScaleDrift, layout: &Layout, canvas: &mut Canvas) {
        let [map, plot, track] = ["map", "plot", "track"].map(|id| layout.panel(id));
        canvas.panel(map.rect);
        let place = (map.rect.x + 2.0, map.rect.y - TITLE / 2.0);
        let title = "Around a block, seen from above";
        canvas.label(place, title, TextStyle::new(Role::Ink, TEXT));
        draw_map(model, map, canvas);
        plot::draw(model, [plot, track], canvas);
        if layout.width < NARROW {
            let top = map.rect.bottom() + 4.0;
            legend::draw(canvas, &legend_entries(), layout.width, 2.0, top);
        } else {
            let left = map.rect.right() + GAP;
            let height = legend::height(&legend_entries(), layout.width - left, 0.0);
            let top = map.rect.bottom() - height;
            // As much margin on the right as on the left.
            legend::draw(canvas, &legend_entries(), layout.width + left, left, top);
        }
    }
}

/// Axes on which all paths are inside, one step as long up as to the right.
fn map_axes(model: &ScaleDrift, rect: Rect) -> (Axis, Axis) {
    let answer = model.answer();
    let (mut low, mut high) = ((0.0_f64, 0.0_f64), (0.0_f64, 0.0_f64));
    let mut cover = |(x, y): Place| {
        low = (low.0.min(x), low.1.min(y));
        high = (high.0.max(x), high.1.max(y));
    };
    // All of the drive, however far it has come, so that the map stays while the camera moves.
    let drive = &answer.drive;
    centers(&drive.truth)
        .iter()
        .map(from_above)
        .for_each(&mut cover);
    for (pose, scale) in drive.believed.iter().zip(&drive.scale) {
        arrow(pose, *scale).into_iter().for_each(&mut cover);
    }
    if let Some(Ok(after)) = &answer.after {
        for (pose, scale) in after.poses.iter().zip(&after.scale) {
            arrow(pose, *scale).into_iter().for_each(&mut cover);
        }
    }
    let (width, height) = (rect.width.max(1.0), (rect.height - RULE_ROOM).max(1.0));
    let per_pixel = ((high.0 - low.0) / width).max((high.1 - low.1) / height);
    let per_pixel = per_pixel * (1.0 + 2.0 * MARGIN);
    let middle = ((low.0 + high.0) / 2.0, (low.1 + high.1) / 2.0);
    let (half, top) = (width * per_pixel / 2.0, middle.1 + height * per_pixel / 2.0);
    (
        Axis {
            start: middle.0 - half,
            end: middle.0 + half,
        },
        Axis {
            start: top,
            end: top - rect.height.max(1.0) * per_pixel,
        },
    )
}

fn draw_map(model: &ScaleDrift, map: &Panel, canvas: &mut Canvas) {
    let answer = model.answer();
    let at = |center: &Point3<f64>| map.canvas_from_world(from_above(center));
    let places = |path: &[RigidTransform]| -> Vec<Place> { centers(path).iter().map(at).collect() };
    let truth = places(&answer.drive.truth);
    let before = places(&answer.before.poses);
    let after = answer.after.as_ref().and_then(|after| after.as_ref().ok());
    let rect = map.rect.inset(1.0);
    let (start, end) = (truth[0], before[before.len() - 1]);
    canvas.clipped(rect, |canvas| {
        canvas.polygon(&truth, Role::Grid, 0.7);
        draw_cameras(&answer.before, model, Role::Series(1), map, canvas);
        if let Some(after) = after {
            draw_cameras(after, model, Role::Best, map, canvas);
            canvas.polyline(&places(&after.poses), after_stroke());
        }
        canvas.polyline(&before, before_stroke());
        canvas.polyline(&truth, truth_stroke());
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
    draw_rule(map, canvas);
    let after = after.map_or_else(Vec::new, |after| places(&after.poses));
    draw_labels(model, map, [&truth, &before, &after], canvas);
}

/// Every few frames the camera, as an arrowhead as large as things around it come out.
fn draw_cameras(path: &Judged, model: &ScaleDrift, role: Role, map: &Panel, canvas: &mut Canvas) {
    let stride = (model.num_steps() / NUM_CAMERAS).max(1);
    for (pose, scale) in path.poses.iter().zip(&path.scale).step_by(stride) {
        let arrow = arrow(pose, *scale).map(|place| map.canvas_from_world(place));
        canvas.polygon(&arrow, role, 0.22);
        canvas.polygon_outline(&arrow, Stroke::solid(role, 1.0));
    }
}

/// The arrowhead of one camera, in steps: its tip is ahead, the camera in the middle of its back.
fn arrow(pose: &RigidTransform, scale: f64) -> [Place; 3] {
    [(0.0, 1.2), (-0.6, 0.0), (0.6, 0.0)].map(|(sideways, ahead)| {
        let ray = Vector3::new(sideways, 0.0, ahead) * (ARROW * scale);
        from_above(&Point3::from(pose.translation.vector + pose.rotation * ray))
    })
}

/// How long some steps are, in the bottom left corner.
fn draw_rule(map: &Panel, canvas: &mut Canvas) {
    let pixels = map.scale_x();
    let lengths = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
    let length = lengths.into_iter().find(|length| length * pixels >= RULE);
    let Some(length) = length else { return };
    let left = (map.rect.x + 12.0, map.rect.bottom() - 12.0);
    let right = (left.0 + length * pixels, left.1);
    let stroke = Stroke::solid(Role::Muted, 1.5);
    canvas.line(left, right, stroke);
    for end in [left, right] {
        canvas.line((end.0, end.1 - 4.0), (end.0, end.1 + 4.0), stroke);
    }
    canvas.label((right.0 + 7.0, right.1), &rule_text(length), rule_style());
}

fn rule_text(length: f64) -> String {
    let plural = if length > 1.0 { "steps" } else { "step" };
    format!("{} {plural}", format_number(length, 0))
}

fn rule_style() -> TextStyle {
    TextStyle::new(Role::Muted, SMALL).cased()
}

fn draw_labels(
    model: &ScaleDrift,
    map: &Panel,
    [truth, before, after]: [&[Place]; 3],
    canvas: &mut Canvas,
) {
    let (start, end) = (truth[0], before[before.len() - 1]);
    let path = &model.answer().before;
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

fn around(place: Place) -> Vec<(Place, crate::canvas::Align)> {
    let mut all = Labels::around(place, 9.0).to_vec();
    all.extend(Labels::around(place, 18.0));
    all
}
