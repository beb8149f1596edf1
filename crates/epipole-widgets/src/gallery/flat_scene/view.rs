//! Both images with the matches and the lines of the probe; beside or below them a top view of the
//! scene, and the singular values.

use super::fit::FITS;
use super::model::{FlatScene, State};
use super::scene::{cameras, point};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::matches::line2;
use crate::kit::pair::{CAMERAS, draw_line};
use crate::kit::plan::{self, PlanCamera};
use crate::kit::plot::{self, List, Ruler};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE};
use crate::theme::Role;
use nalgebra::{Point2, Vector2, Vector3};

const MARKER: f64 = 4.0;
const DECADES: [f64; 2] = [-3.6, 1.5];
/// Extent of the top view, meters to the right and away.
const PLAN_M: [[f64; 2]; 2] = [[-2.2, 3.4], [-0.4, 7.2]];
/// Depth of the drawn image planes, meters.
const IMAGE_M: f64 = 0.7;
const BEST: Stroke = Stroke::solid(Role::Grip, 3.0);
const OTHER: Stroke = Stroke::solid(Role::Candidate, 1.5).dashed();
const TRUTH: Stroke = Stroke::solid(Role::Truth, 2.0).dotted();

/// Draws [`FlatScene`].
#[derive(Default)]
pub(crate) struct FlatSceneView;

fn rulers() -> [Ruler; 2] {
    [
        Ruler::things(plot::SIGMAS),
        Ruler::decades(DECADES[0], DECADES[1]),
    ]
}

fn legend_entries() -> [Entry; 4] {
    [
        (Swatch::Line(BEST), "best F"),
        (Swatch::Line(OTHER), "others that fit"),
        (Swatch::Line(TRUTH), "true F"),
        (Swatch::Marker(Shape::Ring, Role::Ink), "if on the plane"),
    ]
}

impl View for FlatSceneView {
    type Model = FlatScene;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &FlatScene, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let shares = [[1.3, 1.0], [0.8, 1.0]];
        let [first, second, above, values] = grid.photographs_and_two(PHOTO_ASPECT, shares);
        grid.strip(legend::height(&legend_entries(), width, 0.0) + 4.0);
        let [x, y] = rulers();
        grid.layout(vec![
            Panel::photograph("first", first, PHOTO_SIZE).clickable(),
            Panel::photograph("second", second, PHOTO_SIZE),
            plan::panel_of("above", above, PLAN_M, 0.0),
            plot::panel("values", values, &x, &y),
        ])
    }

    fn draw(&mut self, model: &FlatScene, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 4] = [
            ("first", &["Image 1: drag the probe", "Image 1"]),
            (
                "second",
                &[
                    "Image 2: the probe's lines by every F that fits",
                    "Image 2: its lines",
                ],
            ),
            ("above", &["The scene from above", "From above"]),
            (
                "values",
                &["Singular values of the rows", "Singular values"],
            ),
        ];
        let [first, second, above, values] = grid::open_all(canvas, layout, titles);
        let [x, y] = rulers();
        plot::draw_axes(canvas, values, &x, &y);
        legend::draw_last(canvas, &legend_entries(), layout, 0.0, 4.0);
        let state = match model.state() {
            Ok(state) => state,
            Err(sentence) => return grid::notice(canvas, second.rect, sentence),
        };
        canvas.clipped(first.rect, |canvas| draw_first(model, state, first, canvas));
        canvas.clipped(second.rect, |canvas| {
            draw_second(model, state, second, canvas)
        });
        canvas.clipped(above.rect.inset(1.0), |canvas| {
            draw_above(model, state, above, canvas)
        });
        draw_values(state, values, canvas);
    }
}

fn draw_first(model: &FlatScene, state: &State, panel: &Panel, canvas: &mut Canvas) {
    for (pixel1, _) in &state.matches {
        canvas.marker(
            panel.place_of(pixel1),
            MARKER,
            Shape::Disk,
            Role::Inlier,
            true,
        );
    }
    canvas.grip(panel.place_of(&model.probe()), Role::Grip);
}

fn draw_second(model: &FlatScene, state: &State, panel: &Panel, canvas: &mut Canvas) {
    let probe = model.probe();
    for line in state
        .fit
        .others
        .iter()
        .filter_map(|other| line2(other, &probe))
    {
        draw_line(canvas, panel, &line, OTHER.cased());
    }
    if let Some(line) = line2(&state.fit.best, &probe) {
        draw_line(canvas, panel, &line, BEST.cased());
    }
    if let Some(line) = model.true_line() {
        draw_line(canvas, panel, &line, TRUTH);
    }
    for (_, pixel2) in &state.matches {
        canvas.marker(
            panel.place_of(pixel2),
            MARKER,
            Shape::Disk,
            Role::Inlier,
            true,
        );
    }
    if let Some(pixel2) = model.on_plane() {
        canvas.marker(panel.place_of(&pixel2), 7.0, Shape::Ring, Role::Ink, true);
    }
}

/// Draws the cameras, the points, the plane, and the probe's ray.
fn draw_above(model: &FlatScene, state: &State, panel: &Panel, canvas: &mut Canvas) {
    plan::draw_distances(canvas, panel, "m");
    let [width, _] = [PHOTO_SIZE.0, PHOTO_SIZE.1].map(f64::from);
    // The plane is vertical, so it is a line in the top view.
    let ends = [0.0, width - 1.0].map(|u| {
        let end = point(&Point2::new(u, 0.0), 0.0);
        panel.canvas_from_world((end.x, end.z))
    });
    canvas.line(
        ends[0],
        ends[1],
        Stroke::solid(Role::Reference, 1.5).dashed(),
    );
    for (posed, mark) in cameras().into_iter().flatten().zip(CAMERAS) {
        let world_from_cam = posed.cam_from_world.inverse();
        let (center, axis) = (
            world_from_cam.translation.vector,
            world_from_cam * Vector3::z(),
        );
        let camera = PlanCamera {
            center: Point2::new(center.x, center.z),
            heading_rad: libm::atan2(axis.x, axis.z),
            half_width: 0.5 * width / posed.camera.intrinsics.fu_px(),
            mark,
        };
        camera.draw(canvas, panel, IMAGE_M);
    }
    let towards = point(&model.probe(), 0.0);
    let ray = Vector2::new(towards.x, towards.z);
    let stroke = Stroke::solid(Role::Grip, 1.5).cased();
    plan::draw_ray(canvas, panel, &Point2::origin(), &ray, stroke);
    for point in &state.points {
        let place = panel.canvas_from_world((point.x, point.z));
        canvas.marker(place, 3.5, Shape::Disk, Role::Inlier, true);
    }
}

/// Draws the singular values, those at full spread, and the limit up to which an F fits.
fn draw_values(state: &State, panel: &Panel, canvas: &mut Canvas) {
    let sigma = &state.fit.singular_values;
    let limit = plot::decade(FITS * sigma[8]).max(DECADES[0]);
    let ends = [panel.x_axis.start, panel.x_axis.end].map(|x| (x, limit));
    let stroke = Stroke::solid(Role::Candidate, 1.5).dotted();
    plot::draw_curve(canvas, panel, ends, stroke);
    let mut labels = Labels::new(panel.rect.inset(2.0));
    let start = panel.canvas_from_world(ends[0]);
    let style = (Role::Candidate, SMALL);
    labels.name(canvas, ((start.0 + 4.0, start.1), 2.0), "1.5 σ₉", style);
    let now = List {
        values: sigma,
        stroke: Stroke::solid(Role::Inlier, 2.5),
        mark: (Shape::Disk, 4.5),
        name: ("now", 3),
    };
    let deep = List {
        values: &state.deep,
        stroke: Stroke::solid(Role::Reference, 1.25).dashed(),
        mark: (Shape::Ring, 4.0),
        name: ("spread 1", 7),
    };
    // At full spread both lists are the same.
    let lists = [deep, now];
    let first = usize::from(state.deep == *sigma);
    plot::draw_lists(canvas, panel, &lists[first..]);
}
