//! Top view of the cameras and their rays; beside it the rows of their photographs, and the
//! singular values.

use super::model::{FOCAL_PX, MIDDLE_PX, NUM_CAMERAS, POINT_M, ROWS, ThreeRays, WIDTH_PX};
use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View};
use crate::kit::grid::{self, Grid, SMALL, TEXT};
use crate::kit::labels::Labels;
use crate::kit::pair::series;
use crate::kit::plan::{self, PlanCamera};
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;
use nalgebra::Point2;

/// Distance of the drawn image planes from the centers, meters.
const IMAGE_M: f64 = 0.3;
/// Center of the top view, and half of its depth, meters.
const MIDDLE_M: (f64, f64) = (0.4, 1.05);
const HALF_DEPTH_M: f64 = 1.5;
/// Height of a photograph's row, CSS pixels.
const ROW: f64 = 20.0;
const FOUND: Role = Role::Ink;

/// Draws [`ThreeRays`].
#[derive(Default)]
pub(crate) struct ThreeRaysView;

fn rulers() -> [Ruler; 2] {
    [
        Ruler::things(&["σ₁", "σ₂", "σ₃"]),
        Ruler::decades(-4.0, 1.0),
    ]
}

impl View for ThreeRaysView {
    type Model = ThreeRays;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &ThreeRays, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let (top, rows, values);
        if grid::is_narrow(width) {
            [top] = grid.shares([1.0], 186.0);
            [rows, values] = grid.shares([0.6, 0.4], 3.0 * ROW + 2.0 * (grid::GAP + grid::TITLE));
        } else {
            let height = (0.5 * width).min(400.0);
            let [left, right] = grid.shares([0.44, 0.56], height);
            let strips = 3.0 * ROW + 2.0 * (grid::GAP + grid::TITLE);
            let below = right.y + strips + grid::GAP + grid::TITLE;
            (top, rows) = (
                left,
                Rect {
                    height: strips,
                    ..right
                },
            );
            values = Rect::new(right.x, below, right.width, right.bottom() - below);
        }
        let mut panels = vec![plan::panel("top", top, MIDDLE_M, HALF_DEPTH_M)];
        for (id, rect) in ROWS.into_iter().zip(grid::stack(rows, [1.0; NUM_CAMERAS])) {
            panels.push(Panel::new(id, rect, [-0.5, WIDTH_PX - 0.5], [-1.0, 1.0]).clickable());
        }
        let [x, y] = rulers();
        panels.push(plot::panel("values", values, &x, &y));
        grid.layout(panels)
    }

    fn draw(&mut self, model: &ThreeRays, layout: &Layout, canvas: &mut Canvas) {
        let top = layout.panel("top");
        grid::open(canvas, top, &["From above"]);
        canvas.clipped(top.rect.inset(1.0), |canvas| draw_top(model, top, canvas));
        for (camera, id) in ROWS.into_iter().enumerate() {
            draw_row(model, camera, layout.panel(id), canvas);
        }
        let values = layout.panel("values");
        let [x, y] = rulers();
        plot::draw_axes(canvas, values, &x, &y);
        plot::title_from_left(canvas, values, &["Singular values"]);
        let [low, high] = [values.y_axis.end, values.y_axis.start];
        for (index, sigma) in model
            .meeting()
            .iter()
            .flat_map(|found| found.sigma)
            .enumerate()
        {
            let at = |decade: f64| values.canvas_from_world((index as f64 + 1.0, decade));
            let end = at(plot::decade(sigma).clamp(low, high));
            let role = if index + 1 == NUM_CAMERAS {
                Role::Outlier
            } else {
                FOUND
            };
            canvas.line(at(low), end, Stroke::solid(role, 3.0));
            canvas.marker(end, 4.5, Shape::Disk, role, true);
        }
    }
}

fn draw_top(model: &ThreeRays, panel: &Panel, canvas: &mut Canvas) {
    plan::draw_distances(canvas, panel, "m");
    let mut labels = Labels::new(panel.rect.inset(3.0));
    let directions = model.directions();
    for (camera, center) in model
        .centers_m()
        .into_iter()
        .enumerate()
        .take(model.num_used())
    {
        let sight = PlanCamera {
            center: Point2::new(center, 0.0),
            heading_rad: 0.0,
            half_width: WIDTH_PX / 2.0 / FOCAL_PX,
            mark: series(camera),
        };
        sight.draw(canvas, panel, IMAGE_M);
        let stroke = Stroke::solid(series(camera).0, 1.75);
        plan::draw_ray(canvas, panel, &sight.center, &directions[camera], stroke);
        let name = ["1", "2", "3"][camera];
        let place = panel.place_of(&sight.center);
        let style = TextStyle::new(series(camera).0, TEXT).cased();
        labels.draw(
            canvas,
            &[((place.0, place.1 + 17.0), Align::Middle)],
            name,
            style,
        );
    }
    let truth = panel.place_of(&POINT_M);
    canvas.marker(truth, 6.0, Shape::Ring, Role::Truth, true);
    labels.keep_free(truth, 8.0);
    let found = model.meeting().and_then(|found| found.place());
    if let Some(place) = found.map(|found| panel.place_of(&found)) {
        canvas.marker(place, 5.0, Shape::Diamond, FOUND, true);
        labels.keep_free(place, 7.0);
    }
    labels.name(canvas, (truth, 12.0), "P", (Role::Truth, TEXT));
}

/// Draws the row of a photograph: its ends, the true column and the measured one.
fn draw_row(model: &ThreeRays, camera: usize, panel: &Panel, canvas: &mut Canvas) {
    let (role, _) = series(camera);
    let names = [
        ["Row of camera 1", "Camera 1"],
        ["Row of camera 2", "Camera 2"],
        ["Row of camera 3", "Camera 3"],
    ];
    grid::open(canvas, panel, &names[camera]);
    let at = |u: f64| panel.canvas_from_world((u, 0.0));
    let role = if camera < model.num_used() {
        role
    } else {
        Role::Muted
    };
    canvas.line(at(0.0), at(WIDTH_PX - 1.0), Stroke::solid(role, 2.0));
    let tick = |u: f64, half: f64, stroke: Stroke, canvas: &mut Canvas| {
        let (x, y) = at(u);
        canvas.line((x, y - half), (x, y + half), stroke);
    };
    tick(MIDDLE_PX, 4.0, Stroke::solid(Role::Muted, 1.0), canvas);
    tick(
        model.true_column(camera),
        8.0,
        Stroke::solid(Role::Truth, 2.0).dotted(),
        canvas,
    );
    let u = model.columns()[camera];
    canvas.grip(at(u), Role::Grip);
    let beside = if u < MIDDLE_PX {
        (14.0, Align::Start)
    } else {
        (-14.0, Align::End)
    };
    let style = TextStyle::new(Role::Ink, SMALL).cased();
    let (x, y) = at(u);
    let text = format!("{u:.0}");
    let style = if beside.1 == Align::End {
        style.end()
    } else {
        style
    };
    canvas.label((x + beside.0, y - 1.0), &text, style);
}
