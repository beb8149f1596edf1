//! Say what is drawn where.

use super::model::NewFigure;
use crate::canvas::{Canvas, Stroke};
use crate::contract::{Layout, View};
use crate::kit::grid::{self, Grid};
use crate::kit::plan;
use crate::theme::Role;

/// Draws [`NewFigure`].
#[derive(Default)]
pub(crate) struct NewFigureView;

impl View for NewFigureView {
    type Model = NewFigure;

    fn layout(&self, _: &NewFigure, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [cell] = grid.row([0.75], 480.0);
        grid.layout(vec![plan::panel("plan", cell, (0.0, 0.0), 1.1)])
    }

    fn draw(&mut self, model: &NewFigure, layout: &Layout, canvas: &mut Canvas) {
        let [plan] = grid::open_all(canvas, layout, [("plan", &["From above"])]);
        let middle = plan.canvas_from_world((0.0, 0.0));
        let radius = model.radius_m() * plan.scale_x();
        canvas.circle(middle, radius, Stroke::solid(Role::Best, 2.0));
        canvas.grip(plan.canvas_from_world(model.point.place()), Role::Grip);
    }
}
