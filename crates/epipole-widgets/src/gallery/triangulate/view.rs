//! Top view of cameras and point; an enlarged view around the point with the rays and all
//! estimates; and beside it either the reprojection errors of each estimate, or the growth of the
//! uncertainty.

mod beside;
mod region;
mod style;

use self::style::{METHOD_ROLE, SHAPES};
use super::estimates::METHODS;
use super::model::{ASIDE_M, FOCAL_PX, SIZE, Triangulate};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Swatch};
use crate::kit::orbit::Orbit;
use crate::kit::pair::CAMERAS;
use crate::kit::plan::{self, PlanCamera};
use crate::theme::Role;
use nalgebra::Point2;

/// Distance of the drawn image planes from the centers, meters.
const IMAGE_M: f64 = 0.35;

/// Draws [`Triangulate`].
#[derive(Default)]
pub(crate) struct TriangulateView;

impl View for TriangulateView {
    type Model = Triangulate;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &Triangulate, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [top, space, cell] = if grid::is_narrow(width) {
            let [top, space] = grid.shares([1.0, 1.15], 165.0);
            let [cell] = grid.shares([1.0], 104.0);
            [top, space, cell]
        } else {
            grid.shares(
                [1.0, 1.25, 0.85],
                if grid::is_broad(width) { 336.0 } else { 300.0 },
            )
        };
        grid.strip(legend::height(&legend_entries(), width, 0.0) + 4.0);
        let mut panels = vec![
            plan::panel_of("top", top, [ASIDE_M, [-0.3, 3.4]], 0.25),
            Orbit::panel(space),
        ];
        panels.extend(beside::panels(model, cell));
        grid.layout(panels)
    }

    fn draw(&mut self, model: &Triangulate, layout: &Layout, canvas: &mut Canvas) {
        let [top, space] = layout.panels_named(["top", "space"]);
        grid::open(canvas, top, &["From above"]);
        let titles = [
            "Around P, enlarged: drag to turn",
            "Around P, enlarged",
            "Around P",
        ];
        grid::open(canvas, space, &titles);
        beside::draw(model, layout, canvas);
        legend::draw_last(canvas, &legend_entries(), layout, 0.0, 4.0);
        canvas.clipped(top.rect.inset(1.0), |canvas| draw_top(model, top, canvas));
        match model.estimates() {
            Ok(estimates) => {
                region::draw(model, estimates, space, canvas);
                if let Some(Err(error)) = estimates.points.last() {
                    grid::notice(
                        canvas,
                        space.rect,
                        &format!("There is no point, since {error}."),
                    );
                }
            }
            Err(sentence) => grid::notice(canvas, space.rect, sentence),
        }
    }
}

fn legend_entries() -> [legend::Entry; 5] {
    let marker = |index: usize| Swatch::Marker(SHAPES[index], METHOD_ROLE);
    [
        (marker(0), METHODS[0]),
        (marker(1), METHODS[1]),
        (marker(2), METHODS[2]),
        (marker(3), METHODS[3]),
        (Swatch::Marker(Shape::Ring, Role::Truth), "P itself"),
    ]
}

fn draw_top(model: &Triangulate, panel: &Panel, canvas: &mut Canvas) {
    plan::draw_distances(canvas, panel, "m");
    let [point, second] = model.pins();
    let mut labels = Labels::new(panel.rect.inset(3.0));
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
        labels.name(canvas, (place, 10.0), name, (Role::Ink, TEXT));
    }
    let place = panel.canvas_from_world(point);
    canvas.grip(place, Role::Grip);
    labels.keep_free(place, 9.0);
    labels.name(canvas, (place, 10.0), "P", (Role::Ink, TEXT));
}
