//! 3D view: cameras with their photographs, and the scene as far as it is reconstructed.

use super::model::{Cover, NUM_STEPS};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid};
use crate::kit::orbit::Orbit;
use crate::kit::pair::{CAMERAS, spread};
use crate::kit::question::Question as _;
use crate::kit::reconstruction::{Answer, Motion, Question, Stage};
use crate::kit::scenes::PHOTO_SIZE;
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use epipole::camera::PosedCamera;
use nalgebra::{Isometry3, Point2, Point3};

/// Center and radius of the visible scene, in the frame of camera 1 (baseline 1).
const SUBJECT: Subject = Subject {
    middle: Point3::new(0.55, -0.38, 2.7),
    radius: 1.85,
};
/// Distance of the photographs from the camera centers, in baselines.
const PICTURE: f64 = 0.9;
/// Fraction of the last step during which the matched points appear.
const POINTS: f64 = 0.35;
/// Maximum number of lines; more would hide the scene behind them.
const MOST_LINES: usize = 30;
/// Maximum number of dots; more would hide a photograph.
const MOST_DOTS: usize = 400;
/// Fractions of the first step at which the second camera departs and arrives.
const LEAVES: f64 = 0.3;
const ARRIVES: f64 = 0.85;

/// Draws [`Cover`].
#[derive(Default)]
pub(crate) struct CoverView;

impl View for CoverView {
    type Model = Cover;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &Cover, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let height = (0.28 * width + 130.0).min(420.0);
        let [space] = grid.shares([1.0], height);
        grid.layout(vec![Orbit::panel(space)])
    }

    fn draw(&mut self, model: &Cover, layout: &Layout, canvas: &mut Canvas) {
        let panel = layout.panel("space");
        canvas.panel(panel.rect);
        grid::title(canvas, panel.rect, title(model.step()));
        if let Some((question, answer)) = model.asked.answered() {
            draw_space(model, question, answer, panel, canvas);
        }
        draw_handles(canvas, panel, &model.orbit);
        let waiting = model.asked.is_waiting().then_some(Question::LABEL);
        if let Some(words) = model.asked.problem().or(waiting) {
            grid::notice(canvas, panel.rect, words);
        }
    }
}

fn title(step: usize) -> &'static str {
    [
        "1 Photograph it from two places",
        "2 Find points in both",
        "3 Match them",
        "4 Cross their rays",
        "5 The cloud, and where the cameras stood",
    ][step.min(NUM_STEPS - 1)]
}

fn draw_space(
    model: &Cover,
    question: &Question,
    answer: &Answer,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let cameras = question.cameras(answer, Stage::Adjust);
    let (Some((first, Some(second))), Some(motion)) = (cameras, &answer.motion) else {
        return;
    };
    // A narrow panel needs a larger viewing distance to show the whole scene.
    let breadth = panel.rect.width / panel.rect.height.max(1.0);
    let radius = SUBJECT.radius * (2.0 / breadth).clamp(1.0, 1.35);
    let subject = Subject { radius, ..SUBJECT };
    let Some(mut space) = Space::new(panel, &model.orbit, &subject) else {
        return;
    };
    let gone = (model.share(0) - LEAVES) / (ARRIVES - LEAVES);
    let second = on_the_way(&first, &second, gone.clamp(0.0, 1.0));
    let pictures = [(&first, 0), (&second, 1)];
    let num_cameras = if gone > 0.0 { 2 } else { 1 };
    let num_pictures = usize::from(model.share(0) > 0.0) + usize::from(gone >= 1.0);
    let standing = pictures.iter().take(num_pictures);
    space.stand(
        standing.map(|(camera, index)| (*camera, answer.pictures[*index].image())),
        PICTURE,
    );
    for (camera, index) in pictures.into_iter().take(num_cameras) {
        let (role, shape) = CAMERAS[index];
        space.frustum(camera, PHOTO_SIZE, PICTURE, role, shape);
        space.label(&camera.center_in_world(), ["O", "O′"][index], role);
    }
    draw_points(model, answer, [&first, &second], &mut space, canvas);
    draw_rays(model, motion, [&first, &second], &mut space);
    // The matched points appear first, then the dense surface that hides them.
    let [points, pixels] = [0.0, POINTS].map(|from| {
        let length = if from > 0.0 { 1.0 - POINTS } else { POINTS };
        ((model.share(4) - from) / length).clamp(0.0, 1.0)
    });
    let radius = (panel.rect.height / 150.0).clamp(1.5, 2.8);
    if pixels < 1.0 || motion.surface.is_err() {
        for point in told(&motion.points, points) {
            space.dot(&point.place, radius, point.color);
        }
    }
    if let Ok(surface) = &motion.surface {
        surface.draw(&mut space, pixels, panel);
    }
    if model.share(4) >= 1.0 {
        let ends = [first.center_in_world(), second.center_in_world()];
        space.line(&ends[0], &ends[1], Stroke::solid(Role::Ink, 1.5));
    }
    space.draw(canvas, panel);
}

/// Draws the features on the photographs, and lines between matches.
fn draw_points(
    model: &Cover,
    answer: &Answer,
    cameras: [&PosedCamera; 2],
    space: &mut Space<'_>,
    canvas: &Canvas,
) {
    let place = |space: &Space<'_>, index: usize, pixel: &Point2<f64>| {
        space.on_picture(cameras[index], pixel, PICTURE)
    };
    let found = canvas.theme().color(Role::Candidate);
    // With matches only matched features are shown, and with the cloud no features.
    if model.share(1) > 0.0 && model.share(2) < 1.0 {
        for (index, pixels) in answer.keypoints.iter().enumerate() {
            let shown: Vec<_> = spread(pixels, MOST_DOTS).collect();
            for pixel in told(&shown, model.share(1)) {
                let point = place(space, index, pixel);
                space.dot(&point, 0.7, found);
            }
        }
    }
    if model.share(2) <= 0.0 || model.share(4) >= 1.0 {
        return;
    }
    let all: Vec<_> = answer.matches_that(true).collect();
    let agreeing: Vec<_> = spread(&all, MOST_DOTS).copied().collect();
    let matched = canvas.theme().color(Role::Inlier);
    for pair in told(&agreeing, model.share(2)) {
        for (index, pixel) in answer.pixels(*pair).iter().enumerate() {
            let point = place(space, index, pixel);
            space.dot(&point, 0.9, matched);
        }
    }
    if model.share(3) > 0.0 {
        return;
    }
    for pair in spread(&agreeing, MOST_LINES) {
        let [one, two] = answer.pixels(*pair);
        let (from, to) = (place(space, 0, &one), place(space, 1, &two));
        let end = from + (to - from) * model.share(2);
        space.line(&from, &end, Stroke::solid(Role::Inlier, 1.25));
    }
}

/// Draws the rays as they grow to their points; the last step removes them.
fn draw_rays(model: &Cover, motion: &Motion, cameras: [&PosedCamera; 2], space: &mut Space<'_>) {
    let (sent, gone) = (model.share(3), model.share(4));
    if sent <= 0.0 || gone >= 1.0 {
        return;
    }
    let rays: Vec<_> = spread(&motion.points, MOST_LINES).collect();
    for point in told(&rays, 1.0 - gone) {
        for (index, camera) in cameras.into_iter().enumerate() {
            let center = camera.center_in_world();
            let tip = center + (point.place - center) * sent;
            space.line(&center, &tip, Stroke::solid(CAMERAS[index].0, 1.0));
        }
        if sent >= 1.0 {
            space.marker(&point.place, 3.0, Shape::Disk, Role::Inlier);
        }
    }
}

/// Interpolates between two camera poses.
fn on_the_way(first: &PosedCamera, second: &PosedCamera, share: f64) -> PosedCamera {
    let (one, two) = (first.cam_from_world, second.cam_from_world);
    let rotation = one.rotation.slerp(&two.rotation, share);
    let (from, to) = (first.center_in_world(), second.center_in_world());
    let center = from + (to - from) * share;
    let translation = -(rotation * center.coords);
    PosedCamera {
        cam_from_world: Isometry3::from_parts(translation.into(), rotation),
        ..*second
    }
}

/// Returns the first `share` of all elements.
fn told<T>(all: &[T], share: f64) -> &[T] {
    &all[..(share * all.len() as f64).round() as usize]
}
