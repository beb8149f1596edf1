//! Both matrices at one scale: the whole system, and the reduced camera system.

use super::blocks::{PER_CAMERA, PER_POINT};
use super::model::Schur;
use crate::canvas::{Align, Canvas, TextStyle};
use crate::contract::{Layout, Panel, Rect, View};
use crate::kit::grid::{self, GAP, Grid, TEXT};
use crate::kit::labels::Labels;
use crate::theme::Role;

/// Maximum side of the larger matrix, CSS pixels.
const LARGEST: f64 = 420.0;
const CAMERA: Role = Role::Series(0);
const POINT: Role = Role::Series(1);
const BOTH: Role = Role::Series(2);

/// Draws [`Schur`].
#[derive(Default)]
pub(crate) struct SchurView;

fn panel(id: &'static str, rect: Rect, size: usize) -> Panel {
    let axis = [0.0, size.max(1) as f64];
    Panel::new(id, rect, axis, axis)
}

impl View for SchurView {
    type Model = Schur;

    fn layout(&self, model: &Schur, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [cameras, points] = model.blocks.unknowns();
        // Beside the larger matrix there is room for half of its width.
        let side = ((width - GAP) / 1.55).min(LARGEST);
        let [row] = grid.shares([1.0], side);
        let large = Rect::new(row.x, row.y, side, side);
        let unit = side / (cameras + points).max(1) as f64;
        let small = (unit * cameras as f64).min(width - large.right() - GAP);
        let left = Rect::new(large.right() + GAP, row.y, small, small);
        grid.layout(vec![
            panel("all", large, cameras + points),
            panel("cameras", left, cameras),
        ])
    }

    fn draw(&mut self, model: &Schur, layout: &Layout, canvas: &mut Canvas) {
        let (all, left) = (layout.panel("all"), layout.panel("cameras"));
        let blocks = &model.blocks;
        let [cameras, _] = blocks.unknowns();
        grid::fitting_title(canvas, all.rect, &["Everything at once", "All"]);
        let place = (left.rect.x, all.rect.y - grid::TITLE / 2.0);
        let style = TextStyle::new(Role::Ink, TEXT);
        let is_narrow = grid::is_narrow(layout.width);
        canvas.label(
            place,
            if is_narrow {
                "Left"
            } else {
                "Left for the cameras"
            },
            style,
        );
        canvas.panel(all.rect);
        canvas.panel(left.rect);
        let point = |index: usize| cameras + PER_POINT * index;
        for camera in 0..blocks.num_cameras {
            let at = PER_CAMERA * camera;
            fill(canvas, all, (at, PER_CAMERA), (at, PER_CAMERA), CAMERA);
            for other in 0..blocks.num_cameras {
                if blocks.are_coupled(camera, other) {
                    let across = (PER_CAMERA * other, PER_CAMERA);
                    fill(canvas, left, across, (at, PER_CAMERA), CAMERA);
                }
            }
        }
        for (index, seen) in blocks.seen_by.iter().enumerate() {
            let own = (point(index), PER_POINT);
            fill(canvas, all, own, own, POINT);
            for camera in seen {
                let camera = (PER_CAMERA * camera, PER_CAMERA);
                fill(canvas, all, own, camera, BOTH);
                fill(canvas, all, camera, own, BOTH);
            }
        }
        let mut labels = Labels::new(all.rect.inset(2.0));
        let middle = cameras as f64 + 1.5 * blocks.num_points() as f64;
        let names = [
            ("A", (0.5 * cameras as f64, 0.5 * cameras as f64)),
            ("B", (middle, 0.5 * cameras as f64)),
            ("P", (middle, middle)),
        ];
        for (name, place) in names {
            let place = (all.canvas_from_world(place), Align::Middle);
            labels.draw(
                canvas,
                &[place],
                name,
                TextStyle::new(Role::Ink, 15.0).cased(),
            );
        }
    }
}

/// Fills a block from its first column and row.
fn fill(
    canvas: &mut Canvas,
    panel: &Panel,
    (column, width): (usize, usize),
    (row, height): (usize, usize),
    role: Role,
) {
    let (x, y) = panel.canvas_from_world((column as f64, row as f64));
    let (right, bottom) = panel.canvas_from_world(((column + width) as f64, (row + height) as f64));
    canvas.fill_rect(Rect::new(x, y, right - x, bottom - y), role, 0.85);
}
