//! The two photographs with what each stage finds, and below them cameras and points in space.

use super::answer::{Answer, pixel};
use super::model::{Stage, TwoViewSfm};
use super::words;
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Layout, Panel, Rect, View};
use crate::orbit::Orbit;
use crate::scenes::{PHOTO_HEIGHT, PHOTO_WIDTH};
use crate::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use epipole::camera::Camera;
use image::RgbImage;
use nalgebra::Point3;

const TITLE: f64 = 24.0;
const TEXT: f64 = 13.0;
const NARROW: f64 = 500.0;
/// A tall photograph must not push everything else off the screen.
const TALLEST: f64 = 300.0;
/// More lines than this hide the photographs.
const MOST_LINES: usize = 50;
/// Each camera has a hue and a shape, above its photograph and in space.
const CAMERAS: [(Role, Shape); 2] = [
    (Role::Series(0), Shape::Disk),
    (Role::Series(1), Shape::Square),
];
const PHOTOS: [&str; 2] = ["first", "second"];

/// Draws [`TwoViewSfm`].
#[derive(Default)]
pub(crate) struct TwoViewSfmView;

impl View for TwoViewSfmView {
    type Model = TwoViewSfm;

    fn layout(&self, model: &TwoViewSfm, width: f64) -> Layout {
        let gap = if width < NARROW { 6.0 } else { 12.0 };
        let room = ((width - gap) / 2.0).max(1.0);
        let sizes = [0, 1].map(|index| size(model, index));
        let tall = sizes.map(|(w, h)| room * f64::from(h) / f64::from(w));
        let height = tall[0].max(tall[1]).min(TALLEST);
        let photo = |index: usize| {
            let (w, h) = sizes[index];
            let scale = (room / f64::from(w)).min(height / f64::from(h));
            let (w_css, h_css) = (scale * f64::from(w), scale * f64::from(h));
            let x = index as f64 * (room + gap) + (room - w_css) / 2.0;
            let y = TITLE + (height - h_css) / 2.0;
            Panel::photograph(PHOTOS[index], Rect::new(x, y, w_css, h_css), w, h)
        };
        let y = TITLE + height + 10.0 + TITLE;
        let space_height = (width * 0.5).clamp(260.0, 400.0);
        let space = Orbit::panel(Rect::new(0.0, y, width, space_height));
        Layout {
            width,
            height: y + space_height,
            panels: vec![photo(0), photo(1), space],
        }
    }

    fn draw(&mut self, model: &TwoViewSfm, layout: &Layout, canvas: &mut Canvas) {
        let space = layout.panel("space");
        for index in 0..2 {
            draw_photo(model, layout, canvas, index);
        }
        let place = (space.rect.x, space.rect.y - TITLE / 2.0);
        canvas.label(place, title(model), TextStyle::new(Role::Ink, TEXT));
        canvas.panel(space.rect);
        if let Some(answer) = model.answer() {
            draw_features(model, answer, layout, canvas);
            draw_space(model, answer, space, canvas);
        }
        draw_handles(canvas, space, model.orbit());
        let failed = model.answer().and_then(words::failure);
        let failed = failed.filter(|_| model.stage() >= Stage::Ransac);
        let words = model.problem().map(str::to_owned).or(failed);
        let words = words.or_else(|| model.is_waiting().then(|| "computing …".to_owned()));
        if let Some(words) = words {
            let rect = space.rect.inset(12.0);
            let rect = Rect::new(rect.x, rect.y, rect.width.min(520.0), rect.height);
            canvas.paragraph(rect, &words, TextStyle::new(Role::Ink, 14.0).cased());
        }
    }
}

/// What the lower picture shows.
fn title(model: &TwoViewSfm) -> &'static str {
    match model.stage() {
        Stage::Detect => "Space: camera 1 with its features",
        Stage::Match => "Space: camera 1, features with a match",
        Stage::Ransac => "Space: camera 1 with the inliers",
        Stage::Pose => "Space: both cameras, one step apart",
        Stage::Cloud => "Space: cameras and triangulated points",
    }
}

/// The size of a photograph, also before it is there.
fn size(model: &TwoViewSfm, index: usize) -> (u32, u32) {
    let answered = model.answer().map(|answer| &answer.pictures[index]);
    let picture = answered.or_else(|| model.own(index));
    picture.map_or((PHOTO_WIDTH, PHOTO_HEIGHT), RgbImage::dimensions)
}

fn draw_photo(model: &TwoViewSfm, layout: &Layout, canvas: &mut Canvas, index: usize) {
    let rect = layout.panel(PHOTOS[index]).rect;
    let (role, shape) = CAMERAS[index];
    canvas.marker((rect.x + 6.0, TITLE / 2.0), 5.0, shape, role, false);
    let title = ["Camera 1", "Camera 2"][index];
    let style = TextStyle::new(Role::Ink, TEXT);
    canvas.label((rect.x + 18.0, TITLE / 2.0), title, style);
    let answered = model.answer().map(|answer| &answer.pictures[index]);
    match answered.or_else(|| model.own(index)) {
        Some(picture) => canvas.photograph(rect, picture),
        None => canvas.panel(rect),
    }
}

/// A feature, match or point in both photographs.
fn draw_features(model: &TwoViewSfm, answer: &Answer, layout: &Layout, canvas: &mut Canvas) {
    let panels = PHOTOS.map(|id| layout.panel(id));
    let radius = if layout.width < NARROW { 1.0 } else { 1.6 };
    let place = |index: usize, at: (f64, f64)| panels[index].canvas_from_world(at);
    let color = |canvas: &Canvas, role| canvas.theme().color(role);
    let stage = model.stage();
    if stage == Stage::Detect {
        for index in 0..2 {
            let fill = color(canvas, Role::Candidate);
            for &at in &answer.keypoints[index] {
                canvas.dot(place(index, at), radius, fill);
            }
        }
        return;
    }
    let is_shown = |n: usize| stage == Stage::Match || answer.inliers[n];
    let role = match stage {
        Stage::Match => Role::Candidate,
        _ => Role::Inlier,
    };
    for (n, pair) in answer.matches.iter().enumerate() {
        if is_shown(n) {
            for index in 0..2 {
                let fill = color(canvas, role);
                canvas.dot(place(index, pair[index]), radius, fill);
            }
        }
    }
    if stage > Stage::Ransac {
        return;
    }
    let line = |canvas: &mut Canvas, n: usize, stroke| {
        let [a, b] = answer.matches[n];
        canvas.line(place(0, a), place(1, b), stroke);
    };
    let shown: Vec<usize> = (0..answer.matches.len()).filter(|&n| is_shown(n)).collect();
    for n in spread(&shown) {
        line(canvas, n, Stroke::solid(role, 1.0));
    }
    if stage == Stage::Ransac {
        let outliers: Vec<usize> = (0..answer.matches.len())
            .filter(|&n| !answer.inliers[n])
            .collect();
        for n in spread(&outliers) {
            line(canvas, n, Stroke::solid(Role::Outlier, 1.0).dashed());
            for index in 0..2 {
                let at = place(index, answer.matches[n][index]);
                canvas.marker(at, 3.0, Shape::Cross, Role::Outlier, true);
            }
        }
        legend(canvas, panels[0].rect, outliers.len(), shown.len());
    }
}

fn legend(canvas: &mut Canvas, rect: Rect, num_outliers: usize, num_inliers: usize) {
    if rect.width < 300.0 {
        return;
    }
    let style = TextStyle::new(Role::Inlier, TEXT).cased();
    let text = format!("{num_inliers} inliers");
    canvas.label((rect.x + 8.0, rect.y + 14.0), &text, style);
    let style = TextStyle::new(Role::Outlier, TEXT).cased();
    let text = format!("{num_outliers} outliers, dashed");
    canvas.label((rect.x + 8.0, rect.y + 32.0), &text, style);
}

/// Some of many, evenly.
fn spread(all: &[usize]) -> impl Iterator<Item = usize> {
    let stride = all.len().div_ceil(MOST_LINES).max(1);
    all.iter().copied().step_by(stride)
}

/// What the reader looks at: the cameras and most of the points.
fn subject(answer: &Answer) -> Subject {
    let usual = Subject {
        middle: Point3::new(0.0, 0.0, 2.0),
        radius: 2.4,
    };
    let Some(motion) = &answer.motion else {
        return usual;
    };
    let points: Vec<Point3<f64>> = motion.points.iter().map(|p| p.position()).collect();
    let share = |values: Vec<f64>, share: f64| quantile(values, share).unwrap_or(0.0);
    let along = |axis: usize| share(points.iter().map(|p| p[axis]).collect(), 0.5);
    let cloud = Point3::new(along(0), along(1), along(2));
    let reach = share(points.iter().map(|p| (p - cloud).norm()).collect(), 0.8);
    // Between the cloud and the cameras, nearer to the cloud.
    let middle = cloud * 0.53;
    Subject {
        middle,
        radius: (0.5 * cloud.coords.norm()).max(0.7 * reach).max(1e-6),
    }
}

fn draw_space(model: &TwoViewSfm, answer: &Answer, panel: &Panel, canvas: &mut Canvas) {
    let subject = subject(answer);
    let Some(mut space) = Space::new(panel, model.orbit(), model.zoom(), &subject) else {
        return;
    };
    let stage = model.stage();
    let picture_depth = 0.22 * subject.radius;
    let cameras = answer.cameras();
    let [Some(first), second] = &cameras else {
        return;
    };
    let second = second.as_ref().filter(|_| stage >= Stage::Pose);
    space.ground(
        &subject.middle,
        floor(answer, &subject),
        0.35 * subject.radius,
        8,
    );
    for (index, camera) in [Some(first), second].into_iter().enumerate() {
        if let Some(camera) = camera {
            let (role, shape) = CAMERAS[index];
            let size = answer.pictures[index].dimensions();
            space.frustum(camera, size, picture_depth, role, shape);
            let name = ["camera 1", "camera 2"][index];
            space.label(&camera.center_in_world(), name, role);
        }
    }
    if second.is_none() {
        space.axes(first, 0.3 * subject.radius);
    }
    if let Some(second) = second {
        let centers = (first.center_in_world(), second.center_in_world());
        space.line(&centers.0, &centers.1, Stroke::solid(Role::Ink, 2.0));
    }
    match (&answer.motion, stage) {
        (Some(motion), Stage::Cloud) => {
            for point in &motion.points {
                space.dot(&point.position(), 2.6, point.color);
            }
        }
        _ => features_on_picture(answer, stage, first, picture_depth, &mut space, canvas),
    }
    space.draw(canvas, panel);
}

/// The features of camera 1 on its picture, put up in front of it.
fn features_on_picture(
    answer: &Answer,
    stage: Stage,
    camera: &Camera,
    depth: f64,
    space: &mut Space,
    canvas: &Canvas,
) {
    let (role, places): (Role, Vec<(f64, f64)>) = match stage {
        Stage::Detect => (Role::Candidate, answer.keypoints[0].clone()),
        Stage::Match => (
            Role::Candidate,
            answer.matches.iter().map(|pair| pair[0]).collect(),
        ),
        _ => {
            let inliers = answer.matches.iter().zip(&answer.inliers);
            let inliers = inliers.filter(|(_, is_inlier)| **is_inlier);
            (Role::Inlier, inliers.map(|(pair, _)| pair[0]).collect())
        }
    };
    let color = canvas.theme().color(role);
    for place in places {
        space.dot(&space.on_picture(camera, &pixel(place), depth), 1.0, color);
    }
}

/// The height of the grid: below nearly all points, y being down.
fn floor(answer: &Answer, subject: &Subject) -> f64 {
    let heights: Vec<f64> = (answer.motion.iter())
        .flat_map(|motion| motion.points.iter().map(|point| point.position().y))
        .collect();
    quantile(heights, 0.95).unwrap_or(0.5 * subject.radius)
}

/// The value that a share of all values, 0 to 1, is below.
fn quantile(mut values: Vec<f64>, share: f64) -> Option<f64> {
    let place = (share * values.len().checked_sub(1)? as f64) as usize;
    Some(*values.select_nth_unstable_by(place, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_spread_over_all_matches() {
        let all: Vec<usize> = (0..1000).collect();
        let some: Vec<usize> = spread(&all).collect();
        assert!(some.len() <= MOST_LINES && some[some.len() - 1] >= 980);
        assert_eq!(spread(&all[..5]).count(), 5);
        assert_eq!(spread(&[]).count(), 0);
    }
}
