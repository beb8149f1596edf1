//! The newest photograph with its visible points, the number of points in each photograph, and
//! cameras and points in 3D.

use super::model::IncrementalSfm;
use super::question::{Answer, SIZE, TARGET};
use super::steps::Step;
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, GAP, Grid, SMALL, TITLE};
use crate::kit::orbit::Orbit;
use crate::kit::pair::spread;
use crate::kit::plot::{self, Ruler};
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use epipole::camera::PosedCamera;
use nalgebra::{Point3, Vector3};

/// Height over width of a photograph.
const ASPECT: f64 = grid::aspect(SIZE);
/// Distance at which photographs are drawn from their cameras, meters.
const CAMERA_M: f64 = 0.2;
/// Width of a bar, in steps.
const BAR: f64 = 0.72;
/// Maximum number of rays from the newest camera.
const MOST_RAYS: usize = 24;
/// Radius of the visible scene, and its center relative to the target, meters.
const RADIUS_M: f64 = 0.97;
const MIDDLE_M: [f64; 3] = [-0.04, 0.02, -0.08];

/// Draws [`IncrementalSfm`].
#[derive(Default)]
pub(crate) struct IncrementalSfmView;

/// Returns the axes of the bars: steps, with the two photographs of the start at −1 and 0, and
/// numbers of points.
fn rulers(model: &IncrementalSfm) -> [Ruler; 2] {
    let count = model.question().num_photographs as f64;
    let steps = model.answer().map_or(&[][..], |answer| &answer.steps);
    let most = steps.iter().flat_map(|step| &step.num_seen).max();
    let most = most.map_or(100.0, |most| *most as f64);
    [
        Ruler::bare(-1.6, count - 1.4).named("in order of registration"),
        Ruler::linear(0.0, 1.1 * most.max(10.0)),
    ]
}

impl View for IncrementalSfmView {
    type Model = IncrementalSfm;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &IncrementalSfm, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (photo, seen, space);
        if grid::is_narrow(width) {
            [space] = grid.shares([1.0], 176.0);
            [photo, seen] = grid.shares([0.46, 0.54], 140.0);
        } else {
            let height = (0.55 * width).min(392.0);
            let [left, right] = grid.shares([0.27, 0.73], height);
            let photo_height = ASPECT * left.width;
            let top = left.y + photo_height + GAP + TITLE;
            photo = Rect::new(left.x, left.y, left.width, photo_height);
            seen = Rect::new(left.x, top, left.width, left.bottom() - top);
            space = right;
        }
        let photo_height = (ASPECT * photo.width).min(photo.height);
        let photo = Rect::new(photo.x, photo.y, photo_height / ASPECT, photo_height);
        let [x, y] = rulers(model);
        let [plot, track] = plot::panel_and_track("seen", seen, &x, &y);
        grid.layout(vec![
            Panel::photograph("photo", photo, SIZE),
            plot,
            track,
            Orbit::panel(space),
        ])
    }

    fn draw(&mut self, model: &IncrementalSfm, layout: &Layout, canvas: &mut Canvas) {
        let [photo, plot, track, space] = layout.panels_named(["photo", "seen", "track", "space"]);
        grid::open(
            canvas,
            space,
            &[
                "Cameras and points, true places ringed",
                "Cameras and points",
            ],
        );
        let [x, y] = rulers(model);
        plot::draw_axes(canvas, plot, &x, &y);
        plot::title_from_left(
            canvas,
            plot,
            &["Points that each photograph sees", "Points seen"],
        );
        let newest = model.step().map(|step| step.newest);
        let title = newest.map_or("Newest photograph".to_owned(), |newest| {
            format!("Photograph {}, newest", newest + 1)
        });
        grid::open(canvas, photo, &[&title, "Newest"]);
        let picture = model
            .asked
            .answer()
            .and_then(|answer| answer.pictures.get(newest?));
        if let Some(picture) = picture {
            canvas.photograph(photo.rect, picture.image());
        }
        match model.answer().zip(model.step()) {
            Some((answer, step)) => {
                draw_sights(step, photo, canvas);
                draw_bars(model, step, plot, canvas);
                draw_space(model, (answer, step), space, canvas);
            }
            None => grid::notice(canvas, space.rect, model.asked.stand_in()),
        }
        draw_handles(canvas, space, &model.orbit);
        plot::draw_now(canvas, plot, model.place() + BAR / 2.0 + 0.14);
        plot::draw_track(canvas, track, [0.0, model.last() as f64], model.place());
    }
}

fn draw_sights(step: &Step, panel: &Panel, canvas: &mut Canvas) {
    for ([x, y], agrees) in &step.sights {
        let place = panel.canvas_from_world((*x, *y));
        if *agrees {
            canvas.marker(place, 2.2, Shape::Disk, Role::Inlier, true);
        } else {
            canvas.marker(place, 3.0, Shape::Cross, Role::Outlier, true);
        }
    }
}

/// Draws a bar for each photograph, with its number below: registered, next, or waiting.
fn draw_bars(model: &IncrementalSfm, step: &Step, panel: &Panel, canvas: &mut Canvas) {
    let next = model.next();
    for (index, image) in model.order().into_iter().enumerate() {
        let x = index as f64 - 1.0;
        let (left, top) = panel.canvas_from_world((x - BAR / 2.0, step.num_seen[image] as f64));
        let (right, bottom) = panel.canvas_from_world((x + BAR / 2.0, 0.0));
        let bar = Rect::new(left, top, right - left, bottom - top);
        let (role, opacity) = match step.cam_from_world[image] {
            Some(_) => (Role::Series(0), 0.9),
            None if next == Some(image) => (Role::Candidate, 1.0),
            None => (Role::Muted, 0.5),
        };
        canvas.fill_rect(bar, role, opacity);
        let below = ((left + right) / 2.0, panel.rect.bottom() + 12.0);
        let style = TextStyle::new(Role::Muted, SMALL).middle();
        canvas.label(below, &(image + 1).to_string(), style);
    }
}

/// Draws the cameras with their photographs, the points, rays of the newest camera, and rings at
/// the true positions.
fn draw_space(
    model: &IncrementalSfm,
    (answer, step): (&Answer, &Step),
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let target = Point3::from(TARGET);
    let subject = Subject {
        middle: target + Vector3::from(MIDDLE_M),
        radius: RADIUS_M,
    };
    let (Some(mut space), Ok(truth)) = (
        Space::new(panel, &model.orbit, &subject),
        model.question().cameras(),
    ) else {
        return;
    };
    let found: Vec<(usize, PosedCamera)> = (step.cam_from_world.iter().zip(&truth).enumerate())
        .filter_map(|(index, (pose, camera))| {
            let cam_from_world = (*pose)?;
            Some((
                index,
                PosedCamera {
                    cam_from_world,
                    ..*camera
                },
            ))
        })
        .collect();
    let photographs = found
        .iter()
        .map(|(index, camera)| (camera, answer.pictures[*index].image()));
    space.stand(photographs, CAMERA_M);
    let side = (panel.rect.height / 90.0).clamp(1.8, 4.2);
    let place = |place: &[f32; 3]| Point3::from(*place).cast::<f64>();
    for (point, color) in &step.points {
        space.speck(&place(point), side, *color);
    }
    for (index, camera) in &found {
        let is_newest = *index == step.newest;
        if is_newest {
            for (point, _) in spread(&step.points, MOST_RAYS) {
                let ray = Stroke::solid(Role::Inlier, 0.75);
                space.line(&camera.center_in_world(), &place(point), ray);
            }
        }
        let role = if is_newest {
            Role::Inlier
        } else {
            Role::Series(0)
        };
        space.frustum(camera, SIZE, CAMERA_M, role, Shape::Disk);
    }
    for camera in &truth {
        space.marker(&camera.center_in_world(), 4.5, Shape::Ring, Role::Truth);
    }
    space.draw(canvas, panel);
}
