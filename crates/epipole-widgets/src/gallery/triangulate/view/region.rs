//! Enlarged neighborhood of the point: both rays, all estimates, and the repeated estimates.

use super::style::{METHOD_ROLE, REGION, SHAPES, draw_bar};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::Panel;
use crate::gallery::triangulate::estimates::Estimates;
use crate::gallery::triangulate::model::Triangulate;
use crate::kit::pair::CAMERAS;
use crate::kit::space::{Space, Subject, draw_handles};
use crate::theme::Role;
use nalgebra::{Point3, Vector3};

pub(super) fn draw(model: &Triangulate, estimates: &Estimates, panel: &Panel, canvas: &mut Canvas) {
    let truth = estimates.truth;
    let long = estimates.uncertainty_m().unwrap_or(0.5).min(4.0);
    let missed = (estimates.points.iter().flatten()).map(|point| (point - truth).norm());
    let radius = missed.fold(2.15 * long, f64::max).min(12.0);
    let subject = Subject {
        middle: truth,
        radius,
    };
    let Some(mut space) = Space::new(panel, &model.orbit, &subject) else {
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
    // Around the small cross of the pan handle, which is in the middle.
    space.marker(&truth, 9.0, Shape::Ring, Role::Truth);
    for (point, shape) in estimates.points.iter().zip(SHAPES) {
        if let Ok(point) = point {
            space.marker(point, 5.0, shape, METHOD_ROLE);
        }
    }
    let per_cm = 0.01 * space.scale();
    space.draw(canvas, panel);
    draw_bar(canvas, panel.rect, (per_cm, "cm"), false);
    draw_handles(canvas, panel, &model.orbit);
}

/// Draws the two-sigma ellipsoid by its outlines in the planes of its axes.
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
