//! Say what is drawn where.

use super::model::NewFigure;
use crate::canvas::{Canvas, Stroke};
use crate::contract::{Axis, Layout, Model, Panel, Rect, View};
use crate::theme::Role;

const MARGIN: f64 = 8.0;

/// Draws [`NewFigure`].
#[derive(Default)]
pub struct NewFigureView;

impl View for NewFigureView {
    type Model = NewFigure;

    fn layout(&self, _: &NewFigure, width: f64) -> Layout {
        let side = (width - 2.0 * MARGIN).clamp(1.0, 420.0);
        let left = (width - side) / 2.0;
        Layout {
            width,
            height: side + 2.0 * MARGIN,
            panels: vec![Panel {
                id: "plane",
                rect: Rect::new(left, MARGIN, side, side),
                x_axis: Axis {
                    start: -1.0,
                    end: 1.0,
                },
                y_axis: Axis {
                    start: 1.0,
                    end: -1.0,
                },
                clickable: false,
            }],
        }
    }

    fn draw(&mut self, model: &NewFigure, layout: &Layout, canvas: &mut Canvas) {
        let plane = layout.panel("plane");
        canvas.panel(plane.rect);
        let middle = plane.canvas_from_world((0.0, 0.0));
        let radius = model.radius_m() * plane.scale_x();
        canvas.circle(middle, radius, Stroke::solid(Role::Best, 2.0));
        for handle in model.handles() {
            canvas.grip(plane.canvas_from_world((handle.x, handle.y)), Role::Grip);
        }
    }
}
