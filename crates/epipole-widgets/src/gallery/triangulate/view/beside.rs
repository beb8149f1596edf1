//! Panels beside the region: projections of the estimates in the photographs, or the growth of the
//! uncertainty.

use super::style::{METHOD_ROLE, REGION, SHAPES, draw_bar};
use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Layout, Panel, Rect};
use crate::gallery::triangulate::estimates::{Estimates, METHODS};
use crate::gallery::triangulate::model::{Show, Triangulate};
use crate::gallery::triangulate::uncertainty::{ANGLES_DEG, DISTANCES};
use crate::kit::grid::{self, SMALL};
use crate::kit::labels::Labels;
use crate::kit::pair::CAMERAS;
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;

const PATCHES: [&str; 2] = ["first", "second"];
const RAYS: [&str; 2] = ["ray of camera 1", "ray of camera 2"];
/// Radii of the methods' marks, CSS pixels.
const RADII: [f64; 4] = [5.5, 5.5, 8.5, 4.0];
/// Minimum half size of a patch without its margin, pixels.
const LEAST_PX: f64 = 0.5;
/// Maximum half size of a patch without its margin, pixels.
const FARTHEST_PX: f64 = 500.0;
/// Width below which a patch does not name the other ray, CSS pixels.
const WORDY: f64 = 180.0;
/// Range of uncertainties in the plots, powers of ten of a centimeter.
const OVER_ANGLE: [f64; 2] = [-1.0, 2.3];
const OVER_DISTANCE: [f64; 2] = [-1.3, 4.3];

fn rulers(show: Show) -> [Ruler; 2] {
    match show {
        Show::Distance => [
            Ruler::decades(DISTANCES[0], DISTANCES[1]).named("distance of P, m"),
            Ruler::decades(OVER_DISTANCE[0], OVER_DISTANCE[1]),
        ],
        _ => [
            Ruler::linear(ANGLES_DEG[0], ANGLES_DEG[1])
                .shown(1.0, "°")
                .named("angle between the rays"),
            Ruler::decades(OVER_ANGLE[0], OVER_ANGLE[1]),
        ],
    }
}

/// Creates the panels in a cell of the picture.
pub(super) fn panels(model: &Triangulate, cell: Rect) -> Vec<Panel> {
    if model.show() != Show::Misses {
        let [x, y] = rulers(model.show());
        let plot = plot::panel("plot", cell, &x, &y);
        return vec![if model.guess().is_some() {
            plot.clickable()
        } else {
            plot
        }];
    }
    let estimates = model.estimates().ok();
    let rects = if cell.width > cell.height {
        grid::columns(cell, [1.0; 2])
    } else {
        grid::stack(cell, [1.0; 2])
    };
    // One scale for both patches, to compare their distances.
    let half_px = estimates.map_or(LEAST_PX, |estimates| {
        half_px(estimates, 0).max(half_px(estimates, 1))
    });
    let patch = |(camera, rect): (usize, Rect)| {
        let per_px = 0.5 * rect.width.min(rect.height) / half_px;
        let around = |length: f64| [-0.5 * length / per_px, 0.5 * length / per_px];
        Panel::new(
            PATCHES[camera],
            rect,
            around(rect.width),
            around(rect.height),
        )
    };
    rects.into_iter().enumerate().map(patch).collect()
}

/// Returns half of the side of a patch that shows all estimates and the other ray, pixels.
fn half_px(estimates: &Estimates, camera: usize) -> f64 {
    let mut most = LEAST_PX;
    for method in 0..METHODS.len() {
        let miss = estimates.miss_px(method, camera);
        most = most.max(miss.map_or(0.0, |miss| miss.amax()));
    }
    if let Some(lines) = &estimates.lines {
        most = most.max(
            lines[camera]
                .signed_distance(&estimates.pixels[camera])
                .abs(),
        );
    }
    1.4 * most.min(FARTHEST_PX)
}

pub(super) fn draw(model: &Triangulate, layout: &Layout, canvas: &mut Canvas) {
    let estimates = model.estimates().ok();
    if model.show() == Show::Misses {
        for (camera, id) in PATCHES.into_iter().enumerate() {
            let panel = layout.panel(id);
            let titles = [
                ["Photograph 1, enlarged", "Photograph 1"],
                ["Photograph 2, enlarged", "Photograph 2"],
            ];
            grid::open(canvas, panel, &titles[camera]);
            if let Some(estimates) = estimates {
                draw_patch(estimates, camera, panel, canvas);
            }
        }
        return;
    }
    let panel = layout.panel("plot");
    let [x, y] = rulers(model.show());
    let title = match model.show() {
        Show::Distance if !model.reveal().shows_answer() => "Your guess of 1 σ, cm",
        Show::Distance => "1 σ, cm (dashed: Z²)",
        _ => "1 σ along the rays, cm",
    };
    grid::title(canvas, panel.rect, title);
    plot::draw_axes(canvas, panel, &x, &y);
    if let Some(estimates) = estimates {
        draw_curves(model, estimates, panel, canvas);
    }
    if let Some(guess) = model.guess() {
        guess.draw(canvas, panel);
    }
}

/// Draws the pixel in the middle, its epipolar line, and the projection of every estimate.
fn draw_patch(estimates: &Estimates, camera: usize, panel: &Panel, canvas: &mut Canvas) {
    let (role, shape) = CAMERAS[camera];
    let other = CAMERAS[1 - camera].0;
    let middle = panel.canvas_from_world((0.0, 0.0));
    let line = estimates.lines.as_ref().map(|lines| &lines[camera]);
    let foot = line.map(|line| line.nearest(&estimates.pixels[camera]) - estimates.pixels[camera]);
    let images: Vec<_> = (0..METHODS.len())
        .filter_map(|method| {
            let miss = estimates.miss_px(method, camera)?;
            Some((method, panel.canvas_from_world((miss.x, miss.y))))
        })
        .collect();
    let mut labels = Labels::new(panel.rect.inset(3.0));
    labels.keep_free(middle, 7.0);
    for (_, place) in &images {
        labels.keep_free(*place, 9.0);
    }
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        if let Some((line, foot)) = line.zip(foot) {
            let reach = 3.0 * panel.x_axis.end.max(panel.y_axis.end);
            let ends = [-reach, reach].map(|along| {
                panel.canvas_from_world((foot.x - line.b * along, foot.y + line.a * along))
            });
            canvas.line(ends[0], ends[1], Stroke::solid(other, 1.5));
        }
        canvas.marker(middle, 4.5, shape, role, true);
        for (method, place) in &images {
            let (shape, radius) = (SHAPES[*method], RADII[*method]);
            // Nested marks, since these methods agree.
            if shape == Shape::Triangle {
                canvas.hollow_marker(*place, radius, shape, METHOD_ROLE, false);
            } else {
                canvas.marker(*place, radius, shape, METHOD_ROLE, false);
            }
        }
        let style = TextStyle::new(role, SMALL).cased();
        labels.draw(canvas, &Labels::around(middle, 8.0), "measured", style);
        if let Some(foot) = foot.filter(|_| panel.rect.width >= WORDY) {
            let (_, v) = panel.canvas_from_world((foot.x, foot.y));
            let x = panel.rect.right() - 6.0;
            let places = [-11.0, 11.0].map(|up| ((x, v + up), Align::End));
            let style = TextStyle::new(other, SMALL).cased();
            labels.draw(canvas, &places, RAYS[1 - camera], style);
        }
    });
    let is_above = foot.is_some_and(|foot| foot.y > 0.0);
    draw_bar(canvas, panel.rect, (panel.scale_x(), "px"), is_above);
}

/// Draws the growth of the uncertainty, unless it is hidden, and the current position.
fn draw_curves(model: &Triangulate, estimates: &Estimates, panel: &Panel, canvas: &mut Canvas) {
    let (show, is_shown) = (model.show(), model.reveal().shows_answer());
    let curves = &estimates.curves;
    let in_panel = |&(x, long_m): &(f64, f64)| {
        let x = if show == Show::Distance {
            plot::decade(x)
        } else {
            x
        };
        (x, plot::decade(100.0 * long_m))
    };
    let (curve, now) = match show {
        Show::Distance => {
            if is_shown {
                let square = curves.square.iter().map(in_panel);
                let dashed = Stroke::solid(Role::Reference, 1.5).dashed();
                plot::draw_curve(canvas, panel, square, dashed);
            }
            let distance_m = (estimates.truth - estimates.cameras[0].center_in_world()).norm();
            (&curves.distance, plot::decade(distance_m))
        }
        _ => (&curves.angle, estimates.angle_deg),
    };
    if is_shown {
        let curve = curve.iter().map(in_panel);
        plot::draw_curve(canvas, panel, curve, Stroke::solid(REGION, 2.0));
    }
    plot::draw_now(canvas, panel, now);
    if let Some(long_m) = estimates.uncertainty_m() {
        let place = panel.canvas_from_world((now, plot::decade(100.0 * long_m)));
        let inside = panel.rect.inset(-1.0);
        canvas.clipped(inside, |canvas| {
            canvas.marker(place, 5.0, Shape::Disk, Role::Grip, true)
        });
    }
}
