//! The sizes of the columns, raw and normalized, on a logarithmic axis.

use super::model::{ColumnSizes, Sizes};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Layout, Panel, View};
use crate::kit::grid::{self, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;

/// Maximum height of the plot with its labels, CSS pixels.
const HEIGHT: f64 = 300.0;
/// Gap between the plot and the legend, CSS pixels.
const MARGIN: f64 = 4.0;
const RAW: (Role, Shape) = (Role::Outlier, Shape::Square);
const NORMALIZED: (Role, Shape) = (Role::Inlier, Shape::Disk);

/// Draws [`ColumnSizes`].
#[derive(Default)]
pub(crate) struct ColumnSizesView;

fn rulers() -> [Ruler; 2] {
    let names = &["u′u", "u′v", "u′", "v′u", "v′v", "v′", "u", "v", "1"];
    [Ruler::things(names), Ruler::decades(-0.6, 7.2)]
}

const LEGEND: [Entry; 2] = [
    (Swatch::Marker(RAW.1, RAW.0), "raw pixels"),
    (Swatch::Marker(NORMALIZED.1, NORMALIZED.0), "normalized"),
];

impl View for ColumnSizesView {
    type Model = ColumnSizes;

    fn layout(&self, _: &ColumnSizes, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [cell] = grid.shares([1.0], (0.3 * width + 120.0).min(HEIGHT));
        let [x, y] = rulers();
        let plot = plot::panel("plot", cell, &x, &y);
        grid.strip(MARGIN + legend::height(&LEGEND, width, plot::LEFT));
        grid.layout(vec![plot])
    }

    fn draw(&mut self, model: &ColumnSizes, layout: &Layout, canvas: &mut Canvas) {
        let titles = [
            "Size of each column: root mean square of its entries",
            "Size of each column",
        ];
        let plot = plot::open(canvas, layout, "plot", &titles, &rulers());
        match model.both() {
            Ok(both) => {
                draw_sizes(&both.raw, RAW, -0.13, plot, canvas);
                draw_sizes(&both.normalized, NORMALIZED, 0.13, plot, canvas);
            }
            Err(sentence) => grid::notice(canvas, plot.rect, sentence),
        }
        legend::draw_last(canvas, &LEGEND, layout, plot::LEFT, 1.0);
    }
}

/// Draws a stem from 1 to each size, shifted by `beside` columns from the column's name (negative:
/// left).
fn draw_sizes(
    sizes: &Sizes,
    (role, shape): (Role, Shape),
    beside: f64,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let [low, high] = [panel.y_axis.end, panel.y_axis.start];
    for (index, size) in sizes.0.iter().enumerate() {
        let at = |decade: f64| panel.canvas_from_world((index as f64 + 1.0 + beside, decade));
        let end = at(plot::decade(*size).clamp(low, high));
        canvas.line(at(0.0), end, Stroke::solid(role, 3.0));
        canvas.marker(end, 4.5, shape, role, true);
    }
}
