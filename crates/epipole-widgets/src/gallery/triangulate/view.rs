//! Cameras and point from above; around the point, enlarged, the rays and all estimates; and how the
//! uncertainty grows as the angle narrows.

use super::estimates::{Estimates, METHODS};
use super::model::{ASIDE_M, FOCAL_PX, SIZE, Triangulate};
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Swatch};
use crate::kit::orbit::Orbit;
use crate::kit::plan::{self, PlanCamera};
use crate::kit::plot::{self, Ruler};
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use epipole::camera::Camera;
use epipole::triangulation::point_covariance;
use nalgebra::{Point2, Point3, Rotation3, Vector3};

/// How far in front of the centers the image planes are drawn, meters.
const IMAGE_M: f64 = 0.35;
const CAMERAS: [(Role, Shape); 2] = [
    (Role::Series(0), Shape::Disk),
    (Role::Series(1), Shape::Square),
];
const REGION: Role = Role::Series(3);
const SHAPES: [Shape; 4] = [Shape::Cross, Shape::Plus, Shape::Triangle, Shape::Diamond];
/// Angles and uncertainties that the plot shows, degrees and powers of ten of a centimeter.
const ANGLES: [f64; 2] = [0.0, 60.0];
const DECADES: [f64; 2] = [-1.0, 2.3];

fn rulers() -> [Ruler; 2] {
    [
        Ruler::linear(ANGLES[0], ANGLES[1])
            .shown(1.0, "°")
            .named("angle between the rays"),
        Ruler::decades(DECADES[0], DECADES[1]),
    ]
}

/// Draws [`Triangulate`].
#[derive(Default)]
pub(crate) struct TriangulateView;

impl View for TriangulateView {
    type Model = Triangulate;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &Triangulate, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [top, space, cell] = if grid::is_narrow(width) {
            let [top, space] = grid.shares([1.0, 1.15], 170.0);
            let [cell] = grid.shares([1.0], 96.0);
            [top, space, cell]
        } else {
            grid.shares(
                [1.0, 1.25, 0.85],
                if grid::is_broad(width) { 400.0 } else { 300.0 },
            )
        };
        grid.strip(legend_height(width));
        let [x, y] = rulers();
        grid.layout(vec![
            plan::panel_of("top", top, [ASIDE_M, [-0.3, 3.4]], 0.25),
            Orbit::panel(space),
            plot::panel("plot", cell, &x, &y),
        ])
    }

    fn draw(&mut self, model: &Triangulate, layout: &Layout, canvas: &mut Canvas) {
        let [top, space, panel] = ["top", "space", "plot"].map(|id| layout.panel(id));
        let narrow = grid::is_narrow(layout.width);
        grid::title(canvas, top.rect, "From above");
        grid::title(
            canvas,
            space.rect,
            if narrow {
                "Around P"
            } else {
                "Around P, enlarged: drag to turn"
            },
        );
        grid::title(canvas, panel.rect, "1 σ, cm");
        canvas.panel(top.rect);
        canvas.panel(space.rect);
        let [x, y] = rulers();
        plot::draw_axes(canvas, panel, &x, &y);
        let top_of_legend = layout.height - legend_height(layout.width);
        legend::draw(canvas, &legend_entries(), layout.width, 0.0, top_of_legend);
        let estimates = match model.estimates() {
            Ok(estimates) => estimates,
            Err(sentence) => return grid::notice(canvas, space.rect, sentence),
        };
        canvas.clipped(top.rect.inset(1.0), |canvas| draw_top(model, top, canvas));
        draw_space(model, estimates, space, canvas);
        draw_plot(model, estimates, panel, canvas);
    }
}

fn legend_entries() -> [legend::Entry; 5] {
    let marker = |index: usize| Swatch::Marker(SHAPES[index], Role::Ink);
    [
        (marker(0), METHODS[0]),
        (marker(1), METHODS[1]),
        (marker(2), METHODS[2]),
        (marker(3), METHODS[3]),
        (Swatch::Marker(Shape::Ring, Role::Truth), "P itself"),
    ]
}

fn legend_height(width: f64) -> f64 {
    legend::height(&legend_entries(), width, 0.0) + 4.0
}

fn draw_top(model: &Triangulate, panel: &Panel, canvas: &mut Canvas) {
    plan::draw_distances(canvas, panel, "m");
    let [point, second] = model.pins();
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let ink = TextStyle::new(Role::Ink, TEXT).cased();
    for (index, (x, z)) in [(0.0, 0.0), second].into_iter().enumerate() {
        let towards = (point.0 - x, point.1 - z);
        let camera = PlanCamera {
            center: Point2::new(x, z),
            heading_rad: libm::atan2(towards.0, towards.1),
            half_width: f64::from(SIZE.0) / 2.0 / FOCAL_PX,
            mark: CAMERAS[index],
        };
        let ray = camera.on_image(0.0, 1.0) - camera.center;
        plan::draw_ray(
            canvas,
            panel,
            &camera.center,
            &ray,
            Stroke::solid(CAMERAS[index].0, 1.5),
        );
        camera.draw(canvas, panel, IMAGE_M);
        let place = panel.canvas_from_world((x, z));
        if index == 1 {
            canvas.grip(place, Role::Grip);
        }
        labels.keep_free(place, 9.0);
    }
    for (index, place) in [(0.0, 0.0), second].into_iter().enumerate() {
        let place = panel.canvas_from_world(place);
        let name = ["camera 1", "camera 2"][index];
        labels.draw(canvas, &Labels::around(place, 10.0), name, ink);
    }
    let place = panel.canvas_from_world(point);
    canvas.grip(place, Role::Grip);
    labels.keep_free(place, 9.0);
    labels.draw(canvas, &Labels::around(place, 10.0), "P", ink);
}

fn draw_space(model: &Triangulate, estimates: &Estimates, panel: &Panel, canvas: &mut Canvas) {
    let truth = estimates.truth;
    let long = estimates.uncertainty_m().unwrap_or(0.5).min(4.0);
    let missed = (estimates.points.iter().flatten()).map(|point| (point - truth).norm());
    let radius = missed.fold(2.6 * long, f64::max).min(12.0);
    let subject = Subject {
        middle: truth,
        radius,
    };
    let Some(mut space) = Space::new(panel, model.orbit(), model.zoom(), &subject) else {
        return;
    };
    for (index, camera) in estimates.cameras.iter().enumerate() {
        let center = camera.center_in_world();
        let ray = camera.ray_in_world(&estimates.pixels[index]).normalize();
        let near = (truth - center).dot(&ray);
        let ends = [near - 1.6 * radius, near + 1.6 * radius].map(|along| center + ray * along);
        space.line(&ends[0], &ends[1], Stroke::solid(CAMERAS[index].0, 2.0));
    }
    let color = canvas.theme().color(REGION);
    for point in &estimates.repeats {
        space.dot(point, 1.3, color);
    }
    if let Some(axes) = estimates.axes {
        draw_region(&mut space, &truth, &axes);
    }
    space.marker(&truth, 6.0, Shape::Ring, Role::Truth);
    for (point, shape) in estimates.points.iter().zip(SHAPES) {
        if let Ok(point) = point {
            space.marker(point, 5.0, shape, Role::Ink);
        }
    }
    space.draw(canvas, panel);
    draw_handles(canvas, panel, model.orbit());
}

/// The region of two standard deviations: its outline in the planes of its axes.
fn draw_region(space: &mut Space, middle: &Point3<f64>, axes: &[Vector3<f64>; 3]) {
    const CORNERS: usize = 48;
    for (a, b) in [(0, 1), (0, 2)] {
        let corner = |index: usize| {
            let turn = std::f64::consts::TAU * index as f64 / CORNERS as f64;
            middle + (axes[a] * libm::cos(turn) + axes[b] * libm::sin(turn)) * 2.0
        };
        for index in 0..CORNERS {
            space.line(
                &corner(index),
                &corner(index + 1),
                Stroke::solid(REGION, 1.5),
            );
        }
    }
}

/// The uncertainty of a second camera as far away as the first one, over the angle; and where we are.
fn draw_plot(model: &Triangulate, estimates: &Estimates, panel: &Panel, canvas: &mut Canvas) {
    let first = estimates.cameras[0];
    let curve = (1..=120).filter_map(|half| {
        let angle_deg = f64::from(half) / 2.0;
        let turned = turned_about(&first, &estimates.truth, angle_deg);
        let covariance =
            point_covariance(&[first, turned], &estimates.truth, model.sigma_px()).ok()?;
        let long_m = covariance.symmetric_eigenvalues().max().sqrt();
        Some((angle_deg, plot::decade(100.0 * long_m)))
    });
    plot::draw_curve(canvas, panel, curve, Stroke::solid(REGION, 2.0));
    plot::draw_now(canvas, panel, estimates.angle_deg);
    if let Some(long_m) = estimates.uncertainty_m() {
        let decade = plot::decade(100.0 * long_m).clamp(DECADES[0], DECADES[1]);
        let place = panel.canvas_from_world((estimates.angle_deg.min(ANGLES[1]), decade));
        canvas.marker(place, 5.0, Shape::Disk, Role::Grip, true);
    }
}

/// A camera led about a point on a circle, from above, still looking at it.
fn turned_about(camera: &Camera, point: &Point3<f64>, angle_deg: f64) -> Camera {
    let turn = Rotation3::from_axis_angle(&Vector3::y_axis(), angle_deg.to_radians());
    let about = nalgebra::Translation3::from(point.coords)
        * nalgebra::UnitQuaternion::from_rotation_matrix(&turn)
        * nalgebra::Translation3::from(-point.coords);
    Camera {
        cam_from_world: camera.cam_from_world * about,
        ..*camera
    }
}
