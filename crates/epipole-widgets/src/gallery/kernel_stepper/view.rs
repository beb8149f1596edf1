//! The pixels with their values, the nine products in the window, and the output at every pixel.

use super::model::KernelStepper;
use super::pixels::SIZE;
use crate::canvas::{Canvas, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::cells::{self, gray};
use crate::kit::grid::{self, Grid};
use crate::kit::heat::Signed;
use crate::kit::words::short;
use crate::theme::{Rgb, Role, mix};

/// Maximum height of the pixels, CSS pixels.
const TALLEST: f64 = 332.0;
/// Height of both rows on a phone, CSS pixels.
const PHONE: [f64; 2] = [204.0, 100.0];
/// Height of the line with the sum.
const SUM: f64 = 26.0;

/// Draws [`KernelStepper`].
#[derive(Default)]
pub(crate) struct KernelStepperView;

impl View for KernelStepperView {
    type Model = KernelStepper;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &KernelStepper, width: f64) -> Layout {
        let (columns, rows) = (f64::from(SIZE.0), f64::from(SIZE.1));
        let around = (rows + 2.0) / (columns + 2.0);
        let mut grid = Grid::new(width);
        let (pixels, sum, answer);
        if grid::is_narrow(width) {
            [pixels] = grid.row([around], PHONE[0]);
            [sum, answer] = grid.shares([2.5, 1.0], PHONE[1]);
        } else {
            [pixels, sum, answer] = grid.row([around, 2.1, rows / columns], TALLEST);
        }
        let height = answer.width * rows / columns;
        let answer = Rect::new(answer.x, answer.y, answer.width, height.min(answer.height));
        grid.layout(vec![
            Panel::new("pixels", pixels, [-1.5, columns + 0.5], [-1.5, rows + 0.5]).clickable(),
            Panel::photograph("sum", sum, (1, 1)),
            Panel::photograph("answer", answer, SIZE),
        ])
    }

    fn draw(&mut self, model: &KernelStepper, layout: &Layout, canvas: &mut Canvas) {
        let [pixels, sum, answer] = layout.panels_named(["pixels", "sum", "answer"]);
        let narrow = grid::is_narrow(layout.width);
        let titles = [
            "Pixels, and what lies beyond the border",
            "Pixels and border",
        ];
        grid::open(canvas, pixels, &titles);
        let long = "The answer at every pixel";
        grid::title(canvas, answer.rect, if narrow { "Answers" } else { long });
        draw_pixels(model, pixels, canvas);
        draw_products(model, sum.rect, narrow, canvas);
        draw_answers(model, answer, canvas);
        if let Some(remark) = model.remark() {
            grid::notice(canvas, pixels.rect, remark);
        }
    }
}

fn draw_pixels(model: &KernelStepper, panel: &Panel, canvas: &mut Canvas) {
    let (columns, rows) = (SIZE.0 as i32, SIZE.1 as i32);
    let surface = canvas.theme().color(Role::Surface);
    for v in -1..=rows {
        for u in -1..=columns {
            let level = f64::from(model.level(u, v));
            let is_inside = (0..columns).contains(&u) && (0..rows).contains(&v);
            let rect = cells::around(panel, (f64::from(u), f64::from(v)), 0);
            if is_inside {
                cells::draw(canvas, rect, gray(level), &short(level));
            } else {
                // Beyond the border: paler and smaller, to differ from pixels of the image.
                let color = mix(gray(level), surface, 0.6);
                cells::draw(canvas, rect.inset(0.13 * rect.width), color, &short(level));
            }
        }
    }
    let (right, bottom) = (f64::from(columns) - 0.5, f64::from(rows) - 0.5);
    let image = panel.rect_between((-0.5, -0.5), (right, bottom));
    canvas.stroke_rect(image, Stroke::solid(Role::Ink, 1.5).dashed());
    let pixel = model.window.place();
    let [middle, window] = [0, 1].map(|reach| cells::around(panel, pixel, reach));
    canvas.stroke_rect(window, Stroke::solid(Role::Grip, 3.0).cased());
    canvas.stroke_rect(middle.inset(1.0), Stroke::solid(Role::Grip, 1.5));
}

/// Draws window, weights and products, in a column or, on a phone, side by side, and their sum.
fn draw_products(model: &KernelStepper, rect: Rect, narrow: bool, canvas: &mut Canvas) {
    let (window, kernel) = (model.window(), model.kernel());
    let products: [f32; 9] = std::array::from_fn(|index| window[index] * kernel.weights[index]);
    let room = Rect::new(rect.x, rect.y, rect.width, rect.height - SUM);
    // In a column each title is above its table, and the first one above the panel.
    let tables = match narrow {
        true => grid::columns(room, [1.0; 3]),
        false => grid::stack(room, [1.0; 3]),
    };
    let surface = canvas.theme().color(Role::Surface);
    let signed = Signed::of(canvas.theme());
    let titles = ["Window", "× weights", "= products"];
    for (index, (room, title)) in tables.into_iter().zip(titles).enumerate() {
        let cells = cells::three_by_three(room, if narrow { f64::INFINITY } else { 1.5 });
        let x = cells[0].x;
        grid::title(canvas, Rect { x, ..room }, title);
        for (k, cell) in cells.into_iter().enumerate() {
            let value = f64::from([window[k], kernel.weights[k], products[k]][index]);
            let color = match index {
                0 => gray(value),
                1 => surface,
                _ => shade(&signed, value, 300.0),
            };
            cells::draw(canvas, cell, color, &short(value));
            canvas.stroke_rect(cell, Stroke::solid(Role::Edge, 1.0));
        }
    }
    let (pixel, divisor) = (model.window.pixel(), f64::from(kernel.divisor));
    let [sum, divisor, answer] = [model.sum(pixel), divisor, model.answer(pixel)].map(short);
    let long = format!("sum {sum}, ÷ {divisor} = {answer}");
    let brief = format!("{sum} ÷ {divisor} = {answer}");
    let text = grid::fitting(rect.width, &[&long, &brief]);
    let size = cells::fitting_size(text, rect.width - 2.0);
    let place = (rect.center().0, rect.bottom() - SUM / 2.0 + 2.0);
    canvas.label(place, text, TextStyle::new(Role::Ink, size).middle());
}

/// Returns the color of a signed value; its printed number repeats the sign.
fn shade(colors: &Signed, value: f64, most: f64) -> Rgb {
    let share = 0.65 * (value.abs() / most.max(1e-9)).min(1.0);
    colors.color(value < 0.0, share as f32)
}

fn draw_answers(model: &KernelStepper, panel: &Panel, canvas: &mut Canvas) {
    let pixels = || (0..SIZE.1).flat_map(|v| (0..SIZE.0).map(move |u| (u, v)));
    let sizes = pixels().map(|pixel| model.answer(pixel).abs());
    let most = sizes.fold(0.0, f64::max);
    let signed = Signed::of(canvas.theme());
    let is_difference = model.kernel().is_difference();
    for (u, v) in pixels() {
        let answer = model.answer((u, v));
        let color = match is_difference {
            true => shade(&signed, answer, most),
            false => gray(answer),
        };
        let rect = cells::around(panel, (f64::from(u), f64::from(v)), 0);
        let text = match rect.width {
            50.0.. => short(answer),
            30.0.. if answer.fract() != 0.0 => format_number(answer, 1),
            _ => format_number(answer, 0),
        };
        cells::draw(canvas, rect, color, &text);
    }
    canvas.stroke_rect(panel.rect, Stroke::solid(Role::Edge, 1.0));
    let here = cells::around(panel, model.window.place(), 0);
    canvas.stroke_rect(here, Stroke::solid(Role::Grip, 3.0).cased());
}
