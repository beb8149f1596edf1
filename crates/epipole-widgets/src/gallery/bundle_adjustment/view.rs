//! House and cameras in 3D, one of the photographs with its errors, and the curves of the loop.

use super::model::BundleAdjustment;
use super::question::State;
use crate::canvas::{Canvas, Dash, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, GAP, Grid, SMALL};
use crate::kit::house::{House, MARK, SHOWN, SIZE};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::orbit::Orbit;
use crate::kit::plot::{self, Ruler, decade};
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use nalgebra::{Point2, Point3};

/// Gap between a panel and the legend below it, CSS pixels.
const LEGEND_GAP: f64 = 6.0;
/// Center and radius of the visible scene: the house and the cameras in front of it.
const SUBJECT: Subject = Subject {
    middle: Point3::new(0.1, -0.15, -0.75),
    radius: 1.85,
};
/// Distance of a picture from its camera center, in world units.
const PICTURE_DEPTH: f64 = 0.42;
/// World y of the ground below the house; y points down.
const GROUND: f64 = 0.4;
const CAMERA_NAMES: [&str; 4] = ["camera 1", "camera 2", "camera 3", "camera 4"];
/// Names of the cameras in small panels.
const SHORT_NAMES: [&str; 4] = ["1", "2", "3", "4"];
/// Range of each plot, powers of ten.
const COST: [f64; 2] = [-1.5, 9.6];
const DAMPING: [f64; 2] = [-8.0, 5.0];
/// Minimum length of the step axis.
const FEWEST: usize = 8;

const START: Stroke = Stroke {
    role: Role::Reference,
    width: 1.25,
    dash: Dash::Dashed,
    cased: false,
};

/// Draws [`BundleAdjustment`].
#[derive(Default)]
pub(crate) struct BundleAdjustmentView;

const ERROR: Stroke = Stroke::solid(Role::Series(1), 2.0);
const TRUTH: Stroke = Stroke::solid(Role::Truth, 1.5).dotted();
const LEGEND: [Entry; 6] = [
    (Swatch::Line(START), "at the start"),
    (Swatch::Line(Stroke::solid(Role::Best, 2.0)), "now"),
    (Swatch::Line(TRUTH), "truth"),
    (Swatch::Marker(Shape::Ring, Role::Ink), "feature"),
    (Swatch::Marker(Shape::Cross, Role::Outlier), "wrong feature"),
    (Swatch::Line(ERROR), "reprojection error"),
];

fn rulers(model: &BundleAdjustment) -> [Ruler; 3] {
    let answer = model.asked.answer();
    let num_steps = answer.map_or(FEWEST, |answer| answer.num_steps());
    let [cost, damping] = [COST, DAMPING].map(|[low, high]| Ruler::decades(low, high));
    [
        Ruler::linear(-0.6, num_steps.max(FEWEST) as f64 + 0.6),
        cost,
        damping,
    ]
}

impl View for BundleAdjustmentView {
    type Model = BundleAdjustment;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &BundleAdjustment, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let legend_height = |width| LEGEND_GAP + legend::height(&LEGEND, width, 0.0);
        let (space, photo, plots) = if grid::is_broad(width) {
            let shares = [0.385, 0.385, 0.23];
            let photo = shares[1] * (width - 2.0 * GAP);
            let height = photo * aspect + legend_height(photo);
            let [space, photo, plots] = grid.shares(shares, height);
            (space, photo, grid::stack(plots, [1.0; 2]))
        } else {
            let shares = [0.55, 0.45];
            let height = shares[1] * (width - GAP) * aspect;
            let [space, photo] = grid.shares(shares, height);
            grid.strip(legend_height(width));
            let plots = if grid::is_narrow(width) { 104.0 } else { 94.0 };
            (space, photo, grid.shares([1.0; 2], plots))
        };
        let photo = Rect::new(photo.x, photo.y, photo.width, photo.width * aspect);
        let [x, cost, damping] = rulers(model);
        grid.layout(vec![
            Orbit::panel(space),
            Panel::photograph("photo", photo, SIZE),
            plot::panel("cost", plots[0], &x, &cost).clickable(),
            plot::panel("damping", plots[1], &x, &damping).clickable(),
        ])
    }

    fn draw(&mut self, model: &BundleAdjustment, layout: &Layout, canvas: &mut Canvas) {
        let [space, photo] = layout.panels_named(["space", "photo"]);
        for (panel, titles) in [
            (space, ["A house and four cameras", "In space"]),
            (photo, ["What camera 3 sees", "Camera 3"]),
        ] {
            grid::open(canvas, panel, &titles);
        }
        if let Some(house) = model.house() {
            draw_space(model, house, space, canvas);
            draw_photo(model, house, photo, canvas);
        }
        draw_handles(canvas, space, &model.orbit);
        let is_broad = grid::is_broad(layout.width);
        let left = if is_broad { photo.rect.x } else { 0.0 };
        let right = if is_broad {
            photo.rect.right()
        } else {
            layout.width
        };
        let top = photo.rect.bottom() + LEGEND_GAP;
        // The margin on the right equals that on the left.
        legend::draw(canvas, &LEGEND, right + left, left, top);
        draw_plots(model, layout, canvas);
        if let Some(problem) = model.asked.problem() {
            grid::notice(canvas, space.rect, problem);
        }
    }
}

fn draw_space(model: &BundleAdjustment, house: &House, panel: &Panel, canvas: &mut Canvas) {
    // The cameras are side by side, so a narrow panel needs a larger viewing distance.
    let narrowness = 1.45 * panel.rect.height / panel.rect.width.max(1.0);
    let subject = Subject {
        radius: SUBJECT.radius * narrowness.max(1.0),
        ..SUBJECT
    };
    let Some(mut space) = Space::new(panel, &model.orbit, &subject) else {
        return;
    };
    space.ground(&SUBJECT.middle, GROUND, 0.6, 6);
    let wires = |space: &mut Space, points: &[Point3<f64>], stroke: Stroke| {
        for [from, to] in house.pieces() {
            space.line(&points[from], &points[to], stroke);
        }
    };
    let is_small = panel.rect.width < 300.0;
    let names = if is_small { SHORT_NAMES } else { CAMERA_NAMES };
    if let Some([start, now]) = model.states() {
        wires(&mut space, &start.points, START);
        wires(&mut space, &now.points, Stroke::solid(Role::Best, 2.0));
        for (index, (pose, was)) in now.poses.iter().zip(&start.poses).enumerate() {
            let (role, shape) = camera_mark(index);
            let camera = house.camera(index, *pose);
            space.frustum(&camera, SIZE, PICTURE_DEPTH, role, shape);
            let center = camera.center_in_world();
            let was = house.camera(index, *was).center_in_world();
            space.line(&was, &center, START);
            space.marker(&was, 4.0, Shape::Cross, Role::Reference);
            space.label(&center, names[index], role);
        }
    } else {
        for (index, camera) in house.cameras.iter().enumerate() {
            let (role, shape) = camera_mark(index);
            space.frustum(camera, SIZE, PICTURE_DEPTH, role, shape);
        }
    }
    wires(&mut space, &house.points, TRUTH);
    space.draw(canvas, panel);
}

/// Returns color and shape of a camera; the one whose photograph is shown has its own.
fn camera_mark(index: usize) -> (Role, Shape) {
    match index == SHOWN {
        true => (Role::Series(3), Shape::Square),
        false => (Role::Series(0), Shape::Disk),
    }
}

fn draw_photo(model: &BundleAdjustment, house: &House, panel: &Panel, canvas: &mut Canvas) {
    let on_page = |pixel: &Point2<f64>| panel.place_of(pixel);
    let mark = panel.canvas_from_world(model.mark.place());
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        if let (Some([start, now]), Some(answer)) = (model.states(), model.asked.answer()) {
            let places = |state: &State| -> Vec<Option<Place>> {
                let camera = house.camera(SHOWN, state.poses[SHOWN]);
                let shown = state.points.iter().map(|point| camera.project(point).ok());
                shown
                    .map(|pixel| pixel.filter(is_near).as_ref().map(on_page))
                    .collect()
            };
            draw_wires(house, &places(start), START, canvas);
            let now = places(now);
            draw_wires(house, &now, Stroke::solid(Role::Best, 1.5), canvas);
            for (index, (feature, shown)) in answer.features.iter().zip(&now).enumerate() {
                let place = match index == MARK {
                    true => mark,
                    false => on_page(&feature.pixel),
                };
                if let Some(shown) = shown {
                    canvas.line(*shown, place, ERROR);
                }
                match feature.is_wrong {
                    true => canvas.marker(place, 4.0, Shape::Cross, Role::Outlier, true),
                    false => canvas.circle(place, 2.5, Stroke::solid(Role::Ink, 1.0)),
                }
            }
        } else {
            let shown = |point| house.cameras[SHOWN].project(point).ok();
            let shown = house.points.iter().map(shown);
            let places: Vec<_> = shown.map(|p| p.as_ref().map(on_page)).collect();
            draw_wires(house, &places, TRUTH, canvas);
        }
        canvas.grip(mark, Role::Grip);
        let style = TextStyle::new(Role::Grip, SMALL).cased();
        let place = (panel.rect.x + 8.0, panel.rect.bottom() - 12.0);
        let words = if panel.rect.width > 220.0 {
            "drag the marked feature"
        } else {
            "drag me"
        };
        canvas.label(place, words, style);
    });
}

/// Whether a pixel is at most one image size outside of the photograph.
fn is_near(pixel: &Point2<f64>) -> bool {
    let (width, height) = (f64::from(SIZE.0), f64::from(SIZE.1));
    (-width..2.0 * width).contains(&pixel.x) && (-height..2.0 * height).contains(&pixel.y)
}

fn draw_wires(house: &House, places: &[Option<Place>], stroke: Stroke, canvas: &mut Canvas) {
    for [from, to] in house.pieces() {
        if let (Some(a), Some(b)) = (places[from], places[to]) {
            canvas.line(a, b, stroke);
        }
    }
}

/// Draws the curves of cost and damping over the steps.
fn draw_plots(model: &BundleAdjustment, layout: &Layout, canvas: &mut Canvas) {
    let [x, cost, damping] = rulers(model);
    let titles = [
        ["Cost after each step, px²", "Cost, px²"],
        ["Damping λ of each step", "Damping λ"],
    ];
    let of_cost = |state: &State| decade(state.cost);
    let of_damping = |state: &State| decade(state.damping);
    let values: [&dyn Fn(&State) -> f64; 2] = [&of_cost, &of_damping];
    for (index, (id, y)) in [("cost", cost), ("damping", damping)]
        .into_iter()
        .enumerate()
    {
        let panel = layout.panel(id);
        plot::draw_axes(canvas, panel, &x, &y);
        plot::title_from_left(canvas, panel, &titles[index]);
        let Some(answer) = model.asked.answer() else {
            continue;
        };
        plot::draw_now(canvas, panel, model.num_taken() as f64);
        // Zero and values beyond the axis are clamped to its ends.
        let (low, high) = (panel.y_axis.end, panel.y_axis.start);
        let place =
            |(step, state): (usize, &State)| (step as f64, values[index](state).clamp(low, high));
        let role = Role::Series(index as u8);
        let places = || answer.states.iter().enumerate().map(place);
        plot::draw_curve(canvas, panel, places(), Stroke::solid(role, 2.0));
        // Smaller markers where many steps are close together.
        let radius = (0.4 * panel.scale_x()).clamp(1.5, 3.5);
        for (place, state) in places().zip(&answer.states) {
            let at = panel.canvas_from_world(place);
            match state.accepted {
                true => canvas.marker(at, radius, Shape::Disk, role, true),
                false => canvas.marker(at, radius + 1.0, Shape::Cross, Role::Outlier, true),
            }
        }
    }
}
