//! The two photographs with the results of each stage, and beside them cameras and points in 3D.

use super::model::TwoViewSfm;
use super::words;
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid, TEXT, TITLE};
use crate::kit::orbit::Orbit;
use crate::kit::pair::{CAMERAS, spread};
use crate::kit::question::Question as _;
use crate::kit::reconstruction::{Answer, Question, Stage};
use crate::kit::scenes::PHOTO_SIZE;
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use nalgebra::{Point2, Point3};

/// Maximum number of match lines, to keep the photographs visible.
const MOST_LINES: usize = 32;
/// Maximum number of points with rays, to keep the points visible.
const MOST_RAYS: usize = 24;
const PHOTOS: [&str; 2] = ["first", "second"];

/// Draws [`TwoViewSfm`].
#[derive(Default)]
pub(crate) struct TwoViewSfmView {
    /// Frame cached for a version of the result.
    framed: Option<(u64, Frame)>,
}

/// Visible part of the 3D scene.
#[derive(Clone, Copy)]
struct Frame {
    subject: Subject,
    /// y of the ground grid, below nearly all points; y is down.
    floor: f64,
}

impl View for TwoViewSfmView {
    type Model = TwoViewSfm;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &TwoViewSfm, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (photos, space) = if grid::is_narrow(width) {
            let photos = grid.shares([1.0, 1.0], 128.0);
            let [space] = grid.shares([1.0], 188.0);
            (photos, space)
        } else {
            let height = 395.0;
            let column = 4.0 / 3.0 * (height - TITLE - grid::GAP) / 2.0;
            let [photos, space] = grid.shares([column, width - column - grid::GAP], height);
            (grid::stack(photos, [1.0; 2]), space)
        };
        let photo = |index: usize| {
            let (columns, rows) = size(model, index);
            let cell = photos[index];
            let scale = (cell.width / f64::from(columns)).min(cell.height / f64::from(rows));
            let size = (scale * f64::from(columns), scale * f64::from(rows));
            let rect = Rect::new(cell.x, cell.y, size.0, size.1);
            Panel::photograph(PHOTOS[index], rect, (columns, rows))
        };
        grid.layout(vec![photo(0), photo(1), Orbit::panel(space)])
    }

    fn draw(&mut self, model: &TwoViewSfm, layout: &Layout, canvas: &mut Canvas) {
        let space = layout.panel("space");
        canvas.panel(space.rect);
        for (index, id) in PHOTOS.into_iter().enumerate() {
            match model.picture(index) {
                Some(picture) => canvas.photograph(layout.panel(id).rect, picture.image()),
                None => canvas.panel(layout.panel(id).rect),
            }
        }
        let asked = &model.asked;
        if let Some((question, answer)) = asked.answered() {
            let known = self
                .framed
                .filter(|(version, _)| *version == asked.version());
            let frame = known.map_or_else(|| frame(answer), |(_, frame)| frame);
            self.framed = Some((asked.version(), frame));
            draw_features(model.stage(), answer, layout, canvas);
            draw_space(model, (question, answer), frame, space, canvas);
        }
        draw_handles(canvas, space, &model.orbit);
        draw_titles(model, layout, canvas);
        let failed = asked.answered().and_then(words::failure);
        let failed = failed.filter(|_| model.stage() >= Stage::Ransac);
        let sparse = model.answer().and_then(words::no_surface);
        let sparse = sparse.filter(|_| model.stage() == Stage::Surface);
        let waiting = asked.is_waiting().then(|| format!("{} …", Question::LABEL));
        let problem = asked.problem().map(str::to_owned);
        if let Some(words) = problem.or(failed).or(waiting).or(sparse) {
            grid::notice(canvas, space.rect, &words);
        }
    }
}

/// Draws the titles above the panels, where no lines between the photographs cross them.
fn draw_titles(model: &TwoViewSfm, layout: &Layout, canvas: &mut Canvas) {
    for (index, id) in PHOTOS.into_iter().enumerate() {
        let Rect { x, y, .. } = layout.panel(id).rect;
        let (role, shape) = CAMERAS[index];
        canvas.marker((x + 6.0, y - TITLE / 2.0), 5.0, shape, role, true);
        let style = TextStyle::new(Role::Ink, TEXT).cased();
        canvas.label(
            (x + 18.0, y - TITLE / 2.0),
            ["Camera 1", "Camera 2"][index],
            style,
        );
    }
    let has_motion = model.answer().is_none_or(|answer| answer.motion.is_some());
    let has_surface = model
        .answer()
        .is_none_or(|answer| words::no_surface(answer).is_none());
    let title = match model.stage() {
        Stage::Detect => "In space: each feature of camera 1 is a ray",
        Stage::Match => "In space: rays of features with a match",
        Stage::Ransac => "In space: rays of the inliers",
        _ if !has_motion => "In space: rays of the inliers, all from one place",
        Stage::Pose => "In space: camera 2, one step aside",
        Stage::Cloud => "In space: points, camera 2 knocked askew",
        Stage::Surface if has_surface => "In space: every pixel that has a depth",
        Stage::Adjust | Stage::Surface => "In space: points and cameras, adjusted",
    };
    grid::title(canvas, layout.panel("space").rect, title);
}

/// Returns the size of a photograph, even before it is available.
fn size(model: &TwoViewSfm, index: usize) -> (u32, u32) {
    model
        .picture(index)
        .map_or(PHOTO_SIZE, |picture| picture.size())
}

/// Draws features, matches or points in both photographs.
fn draw_features(stage: Stage, answer: &Answer, layout: &Layout, canvas: &mut Canvas) {
    let panels = PHOTOS.map(|id| layout.panel(id));
    let radius = (panels[0].rect.width / 230.0).clamp(0.7, 1.6);
    let place = |index: usize, at: &Point2<f64>| panels[index].place_of(at);
    let role = role_of(stage);
    let color = canvas.theme().color(role);
    if stage == Stage::Detect {
        for (index, places) in answer.keypoints.iter().enumerate() {
            for at in places {
                canvas.dot(place(index, at), radius, color);
            }
        }
        return;
    }
    let shown: Vec<[Point2<f64>; 2]> = match stage {
        Stage::Match => answer
            .matches
            .iter()
            .map(|pair| answer.pixels(*pair))
            .collect(),
        _ => answer
            .matches_that(true)
            .map(|pair| answer.pixels(pair))
            .collect(),
    };
    for pair in &shown {
        for (index, at) in pair.iter().enumerate() {
            canvas.dot(place(index, at), radius, color);
        }
    }
    if stage > Stage::Ransac {
        return;
    }
    for [a, b] in spread(&shown, MOST_LINES) {
        canvas.line(place(0, a), place(1, b), Stroke::solid(role, 1.0));
    }
    if stage == Stage::Match {
        return;
    }
    let outliers: Vec<[Point2<f64>; 2]> =
        (answer.matches_that(false).map(|pair| answer.pixels(pair))).collect();
    for pair in spread(&outliers, MOST_LINES) {
        let [a, b] = [0, 1].map(|index| place(index, &pair[index]));
        canvas.line(a, b, Stroke::solid(Role::Outlier, 1.0).dashed());
        for at in [a, b] {
            canvas.marker(at, 3.0, Shape::Cross, Role::Outlier, true);
        }
    }
    legend(canvas, panels[0].rect, outliers.len(), shown.len());
}

fn legend(canvas: &mut Canvas, rect: Rect, num_outliers: usize, num_inliers: usize) {
    let rows = [
        (Role::Inlier, format!("{num_inliers} inliers")),
        (Role::Outlier, format!("{num_outliers} outliers, dashed")),
    ];
    for (row, (role, text)) in rows.into_iter().enumerate() {
        let place = (rect.x + 8.0, rect.y + 14.0 + 18.0 * row as f64);
        canvas.label(place, &text, TextStyle::new(role, TEXT).cased());
    }
}

/// Returns a frame of the cameras and most of the points, or of the space in front of camera 1.
fn frame(answer: &Answer) -> Frame {
    let Some(motion) = &answer.motion else {
        return Frame {
            subject: Subject {
                middle: Point3::new(0.0, 0.0, 1.2),
                radius: 1.6,
            },
            floor: 1.0,
        };
    };
    let center = motion.cam2_from_cam1.inverse().translation.vector;
    let range = |axis: usize| {
        let along = || {
            motion
                .points
                .iter()
                .map(|point| point.place[axis])
                .collect()
        };
        let [low, high] = [0.04, 0.96].map(|share| quantile(along(), share).unwrap_or(0.0));
        let cameras = (center[axis].min(0.0), center[axis].max(0.0));
        (low.min(cameras.0), high.max(cameras.1))
    };
    let ranges = [0, 1, 2].map(range);
    let [x, y, z] = ranges.map(|(low, high)| low + MIDDLE * (high - low));
    let squares = ranges.map(|(low, high)| (high - low) * (high - low));
    Frame {
        subject: Subject {
            middle: Point3::new(x, y, z),
            radius: (FILL * squares.iter().sum::<f64>().sqrt()).max(1e-6),
        },
        floor: ranges[1].1,
    }
}

/// Position of the subject's center in the bounding box, as a fraction; near parts look larger.
const MIDDLE: f64 = 0.48;
/// Radius of the subject in a broad panel, as a fraction of the box's diagonal.
const FILL: f64 = 0.33;

fn draw_space(
    model: &TwoViewSfm,
    (question, answer): (&Question, &Answer),
    Frame { subject, floor }: Frame,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    // A narrow panel shows the whole scene from farther away.
    let breadth = panel.rect.width / panel.rect.height.max(1.0);
    let radius = subject.radius * (1.7 / breadth).clamp(1.0, 1.4);
    let subject = Subject { radius, ..subject };
    let Some(mut space) = Space::new(panel, &model.orbit, &subject) else {
        return;
    };
    let stage = model.stage();
    let Some((first, second)) = question.cameras(answer, stage) else {
        return;
    };
    // A single picture is drawn at the position of the future scene.
    let depth = subject.radius * if second.is_none() { 0.9 } else { 0.24 };
    space.ground(&subject.middle, floor, 0.35 * subject.radius, 8);
    for (index, camera) in [Some(&first), second.as_ref()].into_iter().enumerate() {
        if let Some(camera) = camera {
            let (role, shape) = CAMERAS[index];
            space.frustum(camera, answer.pictures[index].size(), depth, role, shape);
            let name = ["camera 1", "camera 2"][index];
            space.label(&camera.center_in_world(), name, role);
        }
    }
    if second.is_none() {
        space.axes(&first, 0.3 * subject.radius);
    }
    let centers = [Some(&first), second.as_ref()]
        .map(|camera| camera.map_or_else(Point3::origin, |camera| camera.center_in_world()));
    if second.is_some() {
        space.line(&centers[0], &centers[1], Stroke::solid(Role::Ink, 2.0));
    }
    let motion = answer.motion.as_ref();
    let surface = motion.filter(|_| stage == Stage::Surface);
    let surface = surface.and_then(|motion| motion.surface.as_ref().ok());
    match (motion, surface, stage) {
        (_, Some(surface), _) => surface.draw(&mut space, 1.0, panel),
        (Some(motion), None, Stage::Cloud | Stage::Adjust | Stage::Surface) => {
            let radius = (panel.rect.height / 140.0).clamp(1.6, 3.2);
            for point in &motion.points {
                let place = match stage {
                    Stage::Cloud => &point.triangulated,
                    _ => &point.place,
                };
                space.dot(place, radius, point.color);
            }
        }
        _ => {
            let pixels = features_of_camera_1(stage, answer);
            let color = canvas.theme().color(role_of(stage));
            for pixel in &pixels {
                space.dot(&space.on_picture(&first, pixel, depth), 1.0, color);
            }
            if second.is_none() {
                for pixel in spread(&pixels, MOST_RAYS) {
                    let far = space.on_picture(&first, pixel, 2.4 * depth);
                    space.line(&centers[0], &far, Stroke::solid(role_of(stage), 0.75));
                }
            }
        }
    }
    if let (Some(motion), Stage::Pose) = (&answer.motion, stage) {
        for point in spread(&motion.points, MOST_RAYS) {
            for (center, (role, _)) in centers.iter().zip(CAMERAS) {
                space.line(center, &point.place, Stroke::solid(role, 0.75));
            }
        }
    }
    space.draw(canvas, panel);
}

/// Returns the color role of features at a stage.
fn role_of(stage: Stage) -> Role {
    match stage {
        Stage::Detect | Stage::Match => Role::Candidate,
        _ => Role::Inlier,
    }
}

/// Returns the features of a stage in photograph 1.
fn features_of_camera_1(stage: Stage, answer: &Answer) -> Vec<Point2<f64>> {
    let first = |pair: (u32, u32)| answer.pixels(pair)[0];
    match stage {
        Stage::Detect => answer.keypoints[0].clone(),
        Stage::Match => answer.matches.iter().map(|pair| first(*pair)).collect(),
        _ => answer.matches_that(true).map(first).collect(),
    }
}

/// Returns the quantile of the values at `share`, 0 to 1.
fn quantile(mut values: Vec<f64>, share: f64) -> Option<f64> {
    let place = (share * values.len().checked_sub(1)? as f64) as usize;
    values.sort_by(f64::total_cmp);
    Some(values[place])
}
