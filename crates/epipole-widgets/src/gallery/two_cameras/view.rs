//! Top view of the cameras and the balls, with both image planes; beside it, both photographs.

use super::model::{FOCAL_PX, MIDDLE_PX, Meeting, SIZE, TwoCameras};
use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::CAMERAS;
use crate::kit::plan::{self, PlanCamera};
use crate::theme::Role;
use nalgebra::{Point2, Vector2};

/// Distance of the drawn image planes from the centers, and radius of a ball, meters.
const IMAGE_M: f64 = 0.45;
const RADIUS_M: f64 = 0.09;
const PHANTOM: Role = Role::Outlier;

/// Draws [`TwoCameras`].
#[derive(Default)]
pub(crate) struct TwoCamerasView;

impl View for TwoCamerasView {
    type Model = TwoCameras;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &TwoCameras, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let (top, photographs) = grid.beside_photographs(aspect, 430.0);
        let mut panels = vec![plan::panel("top", top, (0.2, 1.35), 2.0)];
        for (id, rect) in ["left", "right"].into_iter().zip(photographs) {
            panels.push(Panel::photograph(id, rect, SIZE));
        }
        grid.layout(panels)
    }

    fn draw(&mut self, model: &TwoCameras, layout: &Layout, canvas: &mut Canvas) {
        for (id, title) in [
            ("top", "From above"),
            ("left", "Left camera"),
            ("right", "Right camera"),
        ] {
            let panel = layout.panel(id);
            grid::open(canvas, panel, &[title]);
            canvas.clipped(panel.rect.inset(1.0), |canvas| match id {
                "top" => draw_top(model, panel, canvas),
                _ => draw_photograph(model, usize::from(id == "right"), panel, canvas),
            });
        }
    }
}

fn draw_top(model: &TwoCameras, panel: &Panel, canvas: &mut Canvas) {
    plan::draw_distances(canvas, panel, "m");
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let at = |point: Point2<f64>| panel.place_of(&point);
    let ink = TextStyle::new(Role::Ink, TEXT).cased();
    let columns = model.columns().unwrap_or_default();
    let centers = [0.0, model.baseline_m()].map(|x| Point2::new(x, 0.0));
    for index in 0..2 {
        let camera = PlanCamera {
            center: centers[index],
            heading_rad: 0.0,
            half_width: f64::from(SIZE.0) / 2.0 / FOCAL_PX,
            mark: CAMERAS[index],
        };
        let towards = Vector2::new((columns[index] - MIDDLE_PX.0) / FOCAL_PX, 1.0);
        if let Meeting::Behind(_) = model.meeting() {
            let back = Stroke::solid(CAMERAS[index].0, 1.25).dotted();
            plan::draw_ray(canvas, panel, &camera.center, &-towards, back);
        }
        let name = [("O", Align::End), ("O′", Align::Start)][index];
        camera.draw_sight(canvas, panel, &mut labels, name, IMAGE_M, &towards);
        let far = camera.center + towards * panel.y_axis.start;
        labels.keep_line_free(at(camera.center), at(far));
    }
    let [left, right] = centers.map(at);
    let y = left.1 + 17.0;
    plan::draw_span(
        canvas,
        (left.0, y),
        (right.0, y),
        Stroke::solid(Role::Ink, 1.5),
    );
    let text = format!("B = {} m", format_number(model.baseline_m(), 2));
    labels.keep_rect_free(span_rect((left.0, right.0), y));
    // Below it, or beside it at the end of the top view.
    let places = [
        (((left.0 + right.0) / 2.0, y + 15.0), Align::Middle),
        ((right.0 + 9.0, y), Align::Start),
    ];
    labels.draw(canvas, &places, &text, ink);
    let radius = RADIUS_M * panel.scale_x();
    for (ball, name) in model.balls().into_iter().zip(["P", "Q"]) {
        let place = panel.canvas_from_world(ball);
        canvas.disk(place, radius, Role::Candidate, 0.45);
        canvas.grip(place, Role::Grip);
        labels.keep_free(place, radius.max(9.0));
        labels.name(canvas, (place, 11.0), name, (Role::Ink, TEXT));
    }
    if let (true, Meeting::Ahead(found) | Meeting::Behind(found)) =
        (model.is_wrong(), model.meeting())
    {
        let (shown, text) = phantom(found, panel);
        let shape = [Shape::Cross, Shape::Triangle][usize::from(shown != found)];
        canvas.marker(at(shown), 7.0, shape, PHANTOM, true);
        labels.name(canvas, (at(shown), 10.0), &text, (PHANTOM, TEXT));
    }
}

/// Returns the position and the label of the phantom. If it is outside of the top view, it is
/// marked on the left ray at the edge, with its distance.
fn phantom(found: Point2<f64>, panel: &Panel) -> (Point2<f64>, String) {
    let room = 12.0 / panel.scale_x();
    let (nearest, farthest) = (panel.y_axis.end + room, panel.y_axis.start - room);
    let depth = found.y.clamp(nearest, farthest);
    if depth == found.y {
        return (found, "phantom".to_owned());
    }
    let way = format_number(found.y.abs(), 1);
    let side = if found.y < 0.0 { " behind" } else { "" };
    let text = format!("phantom, {way} m{side}");
    // The left camera is at the origin.
    (found * (depth / found.y), text)
}

/// Draws both balls, the column used for P and, on the right, its distance from the left one.
fn draw_photograph(model: &TwoCameras, camera: usize, panel: &Panel, canvas: &mut Canvas) {
    let mut balls = [0, 1].map(|ball: usize| (model.balls()[ball].1, ball));
    // The nearer ball is drawn last.
    balls.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (depth_m, ball) in balls {
        let Ok(pixel) = model.pixel(camera, ball) else {
            continue;
        };
        let place = panel.place_of(&pixel);
        let radius = RADIUS_M * FOCAL_PX / depth_m * panel.scale_x();
        canvas.disk(place, radius, Role::Candidate, 0.55);
        let above = (place.0 + radius + 2.0, place.1 - radius - 7.0);
        canvas.label(
            above,
            ["P", "Q"][ball],
            TextStyle::new(Role::Ink, TEXT).middle().cased(),
        );
    }
    let columns = model.columns().unwrap_or_default();
    let places = columns.map(|column| panel.canvas_from_world((column, 0.0)).0);
    let (top, bottom) = (panel.rect.y, panel.rect.bottom());
    let mut labels = Labels::new(panel.rect.inset(3.0));
    for index in 0..=camera {
        let stroke = Stroke::solid(CAMERAS[index].0, 1.5);
        let stroke = if index == camera {
            stroke
        } else {
            stroke.dashed()
        };
        canvas.line((places[index], top), (places[index], bottom), stroke);
    }
    let x = places[camera];
    let text = format!("{} = {:.0}", ["u", "u′"][camera], columns[camera]);
    let style = TextStyle::new(CAMERAS[camera].0, TEXT).cased();
    let beside = [
        ((x + 6.0, top + 12.0), Align::Start),
        ((x - 6.0, top + 12.0), Align::End),
    ];
    labels.draw(canvas, &beside[usize::from(camera == 1)..], &text, style);
    if camera == 1 {
        let ink = Stroke::solid(Role::Ink, 1.5).cased();
        plan::draw_span(
            canvas,
            (places[1], bottom - 12.0),
            (places[0], bottom - 12.0),
            ink,
        );
        let text = format!("d = {} px", format_number(model.disparity_px(), 0));
        let (left, right) = (places[0].min(places[1]), places[0].max(places[1]));
        let y = bottom - 12.0;
        labels.keep_rect_free(span_rect((left, right), y));
        for x in [left, right] {
            labels.keep_line_free((x, top), (x, bottom));
        }
        let beside = [
            ((right + 9.0, y), Align::Start),
            ((left - 9.0, y), Align::End),
            (((left + right) / 2.0, y - 14.0), Align::Middle),
        ];
        let style = TextStyle::new(Role::Ink, TEXT).cased();
        labels.draw(canvas, &beside, &text, style);
    }
}

/// Returns the rectangle of a horizontal span with its ends.
fn span_rect((left, right): (f64, f64), y: f64) -> Rect {
    Rect::new(left, y - 4.0, right - left, 8.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_phantom_off_the_plan_is_told_at_its_edge() {
        let rect = Rect {
            x: 0.0,
            y: 0.0,
            width: 400.0,
            height: 400.0,
        };
        let plan = plan::panel("top", rect, (0.2, 1.35), 2.0);
        let near = Point2::new(0.1, 2.0);
        assert_eq!(phantom(near, &plan), (near, "phantom".to_owned()));
        for (found, text) in [
            (Point2::new(0.6, 4.0), "phantom, 4.0 m"),
            (Point2::new(-0.24, -1.6), "phantom, 1.6 m behind"),
        ] {
            let (shown, told) = phantom(found, &plan);
            assert_eq!(told, text);
            let (x, y) = plan.place_of(&shown);
            assert!((1.0..399.0).contains(&x) && (1.0..399.0).contains(&y));
            // It remains on the ray of the left camera.
            assert!((shown.x / shown.y - found.x / found.y).abs() < 1e-12);
        }
    }
}
