//! The pixels with their numbers, the nine products under the window, and the answer at every pixel.

use super::model::KernelStepper;
use super::pixels::SIZE;
use super::words::short;
use crate::canvas::{Canvas, Stroke, TextStyle, text_width};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, TEXT};
use crate::theme::{Rgb, Role, Theme, mix};

/// Height of the pixels where there is room; of both rows on a phone, CSS pixels.
const TALLEST: f64 = 332.0;
const PHONE: [f64; 2] = [204.0, 100.0];
/// Height of the line with the sum.
const SUM: f64 = 26.0;
/// Cells narrower than this have no numbers.
const SMALLEST: f64 = 17.0;

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
        grid::fitting_title(canvas, pixels.rect, &titles);
        let long = "The answer at every pixel";
        grid::title(canvas, answer.rect, if narrow { "Answers" } else { long });
        canvas.panel(pixels.rect);
        draw_pixels(model, pixels, canvas);
        draw_products(model, sum.rect, narrow, canvas);
        draw_answers(model, answer, canvas);
        if let Some(remark) = model.remark() {
            grid::notice(canvas, pixels.rect, remark);
        }
    }
}

/// The rectangle of a pixel.
fn cell(panel: &Panel, (u, v): (i32, i32)) -> Rect {
    let (u, v) = (f64::from(u), f64::from(v));
    panel.rect_between((u - 0.5, v - 0.5), (u + 0.5, v + 0.5))
}

fn gray(level: f64) -> Rgb {
    [level.round().clamp(0.0, 255.0) as u8; 3]
}

/// A filled cell with its number, if there is room for one.
fn draw_cell(canvas: &mut Canvas, rect: Rect, color: Rgb, text: &str) {
    canvas.fill_color(rect, color);
    if rect.width < SMALLEST {
        return;
    }
    let role = canvas.theme().readable_on(color);
    let fitting = (rect.width - 4.0) / text_width(text, 1.0).max(1e-9);
    let size = fitting.min(TEXT).min(rect.height * 0.8);
    canvas.label(rect.center(), text, TextStyle::new(role, size).middle());
}

fn draw_pixels(model: &KernelStepper, panel: &Panel, canvas: &mut Canvas) {
    let (columns, rows) = (SIZE.0 as i32, SIZE.1 as i32);
    let surface = canvas.theme().color(Role::Surface);
    for v in -1..=rows {
        for u in -1..=columns {
            let level = f64::from(model.level(u, v));
            let is_inside = (0..columns).contains(&u) && (0..rows).contains(&v);
            let rect = cell(panel, (u, v));
            if is_inside {
                draw_cell(canvas, rect, gray(level), &short(level));
            } else {
                // Beyond the border: paler and smaller, so that nobody takes it for a pixel.
                let color = mix(gray(level), surface, 0.6);
                draw_cell(canvas, rect.inset(0.13 * rect.width), color, &short(level));
            }
        }
    }
    let (right, bottom) = (f64::from(columns) - 0.5, f64::from(rows) - 0.5);
    let image = panel.rect_between((-0.5, -0.5), (right, bottom));
    canvas.stroke_rect(image, Stroke::solid(Role::Ink, 1.5).dashed());
    let (u, v) = model.pixel();
    let middle = cell(panel, (u as i32, v as i32));
    let (u, v) = (f64::from(u), f64::from(v));
    let window = panel.rect_between((u - 1.5, v - 1.5), (u + 1.5, v + 1.5));
    canvas.stroke_rect(window, Stroke::solid(Role::Grip, 3.0).cased());
    canvas.stroke_rect(middle.inset(1.0), Stroke::solid(Role::Grip, 1.5));
}

/// Window, weights and products: below each other, on a phone side by side; and the sum.
fn draw_products(model: &KernelStepper, rect: Rect, narrow: bool, canvas: &mut Canvas) {
    let (window, kernel) = (model.window(), model.kernel());
    let products: [f32; 9] = std::array::from_fn(|index| window[index] * kernel.weights[index]);
    let room = Rect::new(rect.x, rect.y, rect.width, rect.height - SUM);
    // Below each other, their titles stand above them, the first one above the panel.
    let tables = match narrow {
        true => grid::columns(room, [1.0; 3]),
        false => grid::stack(room, [1.0; 3]),
    };
    let surface = canvas.theme().color(Role::Surface);
    let titles = ["Window", "× weights", "= products"];
    for (index, (table, title)) in tables.into_iter().zip(titles).enumerate() {
        let side = (table.width / 3.0).min(table.height / 3.0);
        let most = if narrow { f64::INFINITY } else { 1.5 * side };
        let wide = most.min(table.width / 3.0);
        let left = table.center().0 - 1.5 * wide;
        grid::title(canvas, Rect { x: left, ..table }, title);
        for k in 0..9 {
            let (column, row) = ((k % 3) as f64, (k / 3) as f64);
            let at = Rect::new(left + column * wide, table.y + row * side, wide, side);
            let value = f64::from([window[k], kernel.weights[k], products[k]][index]);
            let text = short(value);
            match index {
                0 => draw_cell(canvas, at, gray(value), &text),
                1 => draw_cell(canvas, at, surface, &text),
                _ => draw_cell(canvas, at, shade(canvas.theme(), value, 300.0), &text),
            }
            canvas.stroke_rect(at, Stroke::solid(Role::Edge, 1.0));
        }
    }
    let (sum, answer) = (model.sum(model.pixel()), model.answer(model.pixel()));
    let [sum, divisor, answer] = [sum, f64::from(kernel.divisor), answer].map(short);
    let long = format!("sum {sum}, ÷ {divisor} = {answer}");
    let brief = format!("{sum} ÷ {divisor} = {answer}");
    let fits = text_width(&long, TEXT) <= rect.width;
    let text = if fits { long } else { brief };
    let size = TEXT.min((rect.width - 2.0) / text_width(&text, 1.0).max(1e-9));
    let place = (rect.center().0, rect.bottom() - SUM / 2.0 + 2.0);
    canvas.label(place, &text, TextStyle::new(Role::Ink, size).middle());
}

/// Warm where positive, cool where negative; the sign is in the number, too.
fn shade(theme: Theme, value: f64, most: f64) -> Rgb {
    let is_negative = value < 0.0;
    let role = if is_negative {
        Role::Candidate
    } else {
        Role::Outlier
    };
    let share = 0.65 * (value.abs() / most.max(1e-9)).min(1.0);
    mix(theme.color(Role::Surface), theme.color(role), share as f32)
}

fn draw_answers(model: &KernelStepper, panel: &Panel, canvas: &mut Canvas) {
    let pixels = || (0..SIZE.1).flat_map(|v| (0..SIZE.0).map(move |u| (u, v)));
    let sizes = pixels().map(|pixel| model.answer(pixel).abs());
    let most = sizes.fold(0.0, f64::max);
    let is_difference = model.kernel().is_difference();
    for (u, v) in pixels() {
        let answer = model.answer((u, v));
        let color = match is_difference {
            true => shade(canvas.theme(), answer, most),
            false => gray(answer),
        };
        let rect = cell(panel, (u as i32, v as i32));
        let text = match rect.width {
            50.0.. => short(answer),
            30.0.. if answer.fract() != 0.0 => format_number(answer, 1),
            _ => format_number(answer, 0),
        };
        draw_cell(canvas, rect, color, &text);
    }
    canvas.stroke_rect(panel.rect, Stroke::solid(Role::Edge, 1.0));
    let (u, v) = model.pixel();
    let here = cell(panel, (u as i32, v as i32));
    canvas.stroke_rect(here, Stroke::solid(Role::Grip, 3.0).cased());
}
