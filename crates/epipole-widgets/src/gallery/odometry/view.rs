//! A frame with its corners, path and points in 3D, and the error along the path.

use super::model::OdometryFigure;
use super::question::{Answer, Frame};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, GAP, Grid, TITLE};
use crate::kit::orbit::Orbit;
use crate::kit::plot::{self, Ruler};
use crate::kit::sequence::{self, SIZE};
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use epipole::camera::PosedCamera;
use nalgebra::Point3;

/// Height over width of a frame.
const ASPECT: f64 = grid::aspect(SIZE);
/// Minimum height of the plot's axis, millimeters.
const LEAST_MM: f64 = 4.0;
/// Length of the cameras drawn, meters.
const CAMERA_M: f64 = 0.09;
const TRUTH: Stroke = Stroke::solid(Role::Truth, 1.75).dotted();
const FOUND: Stroke = Stroke::solid(Role::Best, 2.25);

/// Draws [`OdometryFigure`].
#[derive(Default)]
pub(crate) struct OdometryView;

/// Returns the errors of the frames with a pose, millimeters.
fn errors_mm(model: &OdometryFigure) -> Vec<(f64, f64)> {
    let frames = model.answer().map_or(&[][..], |answer| &answer.frames);
    let errors = frames.iter().enumerate();
    let errors = errors
        .filter_map(|(index, frame)| Some((index as f64, 1000.0 * model.error_m(index, frame)?)));
    errors.collect()
}

fn rulers(model: &OdometryFigure) -> [Ruler; 2] {
    let last = model.last() as f64;
    let most = errors_mm(model)
        .iter()
        .map(|(_, error)| *error)
        .fold(LEAST_MM, f64::max);
    [
        Ruler::linear(-0.03 * last, 1.03 * last).named("frame"),
        Ruler::linear(0.0, 1.08 * most),
    ]
}

impl View for OdometryView {
    type Model = OdometryFigure;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &OdometryFigure, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (photo, errors, space);
        if grid::is_narrow(width) {
            [space] = grid.shares([1.0], 176.0);
            [photo, errors] = grid.shares([0.46, 0.54], 140.0);
        } else {
            let height = (0.55 * width).min(392.0);
            let [left, right] = grid.shares([0.29, 0.71], height);
            let photo_height = ASPECT * left.width;
            let top = left.y + photo_height + GAP + TITLE;
            photo = Rect::new(left.x, left.y, left.width, photo_height);
            errors = Rect::new(left.x, top, left.width, left.bottom() - top);
            space = right;
        }
        let photo_height = (ASPECT * photo.width).min(photo.height);
        let photo = Rect::new(photo.x, photo.y, photo_height / ASPECT, photo_height);
        let [x, y] = rulers(model);
        let [plot, track] = plot::panel_and_track("errors", errors, &x, &y);
        grid.layout(vec![
            Panel::photograph("photo", photo, SIZE),
            plot,
            track,
            Orbit::panel(space),
        ])
    }

    fn draw(&mut self, model: &OdometryFigure, layout: &Layout, canvas: &mut Canvas) {
        let [photo, plot, track, space] =
            layout.panels_named(["photo", "errors", "track", "space"]);
        let index = model.frame();
        grid::open(canvas, photo, &[&format!("Frame {}", index + 1)]);
        grid::open(
            canvas,
            space,
            &[
                "The path and the points, true path dotted",
                "Path and points",
            ],
        );
        let [x, y] = rulers(model);
        plot::draw_axes(canvas, plot, &x, &y);
        plot::title_from_left(
            canvas,
            plot,
            &["Distance from the true path, mm", "Error, mm"],
        );
        let pictures = model
            .asked
            .answer()
            .map_or(&[][..], |answer| &answer.frames);
        if let Some(frame) = pictures.get(index) {
            canvas.photograph(photo.rect, frame.picture.image());
        }
        match model.answer() {
            Some(answer) => {
                if let Some(frame) = answer.frames.get(index) {
                    draw_corners(frame, photo, canvas);
                }
                plot::draw_curve(canvas, plot, errors_mm(model), FOUND);
                draw_space(model, answer, space, canvas);
            }
            None => grid::notice(canvas, space.rect, model.asked.stand_in()),
        }
        draw_handles(canvas, space, &model.orbit);
        plot::draw_now(canvas, plot, model.place());
        plot::draw_track(canvas, track, [0.0, model.last() as f64], model.place());
    }
}

fn draw_corners(frame: &Frame, panel: &Panel, canvas: &mut Canvas) {
    for corner in &frame.corners {
        let place = panel.canvas_from_world(*corner);
        canvas.marker(place, 2.2, Shape::Disk, Role::Inlier, true);
    }
}

/// Draws the paths up to the current frame, its camera, and the points seen so far.
fn draw_space(model: &OdometryFigure, answer: &Answer, panel: &Panel, canvas: &mut Canvas) {
    let first = sequence::camera(0);
    let ahead = first.cam_from_world.inverse() * Point3::new(0.05, 0.0, 0.62);
    let subject = Subject {
        middle: ahead,
        radius: 0.76,
    };
    let Some(mut space) = Space::new(panel, &model.orbit, &subject) else {
        return;
    };
    let index = model.frame();
    for (point, color, seen) in &answer.points {
        if *seen as usize <= index {
            space.dot(point, (panel.rect.height / 170.0).clamp(1.2, 2.6), *color);
        }
    }
    let truth: Vec<_> = (model.question().used())
        .map(|frame| sequence::camera(frame).center_in_world())
        .collect();
    for pair in truth.windows(2) {
        space.line(&pair[0], &pair[1], TRUTH);
    }
    let so_far = || answer.frames.iter().take(index + 1);
    let found: Vec<_> = so_far().filter_map(Frame::center).collect();
    for pair in found.windows(2) {
        space.line(&pair[0], &pair[1], FOUND);
    }
    for frame in so_far() {
        if let Some(center) = frame.center().filter(|_| frame.is_keyframe) {
            space.marker(&center, 3.0, Shape::Square, Role::Best);
        }
    }
    if let Some(pose) = answer
        .frames
        .get(index)
        .and_then(|frame| frame.world_from_cam)
    {
        let camera = PosedCamera {
            cam_from_world: pose.inverse(),
            camera: first.camera,
        };
        space.frustum(&camera, SIZE, CAMERA_M, Role::Series(0), Shape::Disk);
    }
    space.draw(canvas, panel);
}
