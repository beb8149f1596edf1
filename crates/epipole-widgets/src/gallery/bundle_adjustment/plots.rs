//! The two curves: what the cost and the damping were after each step, on logarithmic scales.

use super::answer::State;
use super::model::BundleAdjustment;
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Axis, Panel, Rect};
use crate::theme::Role;

const SMALL: f64 = 12.0;
const TEXT: f64 = 13.0;
/// Room for the labels of the vertical axis and of the horizontal one.
const LEFT: f64 = 42.0;
const BELOW: f64 = 20.0;
const TITLE: f64 = 24.0;
/// Room for the number of a step.
const LABEL: f64 = 28.0;
/// Decades that each plot spans; every third has a line.
const COST: [i32; 2] = [-1, 9];
const DAMPING: [i32; 2] = [-8, 5];
/// The horizontal axis is never shorter than this many steps.
const FEWEST: usize = 8;

/// A plot for each curve within `rect`, side by side.
pub(super) fn panels(model: &BundleAdjustment, rect: Rect, gap: f64) -> [Panel; 2] {
    let cell = (rect.width - gap) / 2.0;
    let num_steps = model.answer().map_or(FEWEST, |answer| answer.num_steps());
    let panel = |index: usize, id, [low, high]: [i32; 2]| Panel {
        id,
        rect: Rect::new(
            rect.x + index as f64 * (cell + gap) + LEFT,
            rect.y + TITLE,
            (cell - LEFT - 4.0).max(1.0),
            (rect.height - TITLE - BELOW).max(1.0),
        ),
        x_axis: Axis {
            start: -0.6,
            end: num_steps.max(FEWEST) as f64 + 0.6,
        },
        y_axis: Axis {
            start: f64::from(high),
            end: f64::from(low),
        },
        clickable: true,
    };
    [panel(0, "cost", COST), panel(1, "damping", DAMPING)]
}

/// Draws both.
pub(super) fn draw(model: &BundleAdjustment, panels: [&Panel; 2], canvas: &mut Canvas) {
    let narrow = panels[0].rect.width < 200.0;
    let cost = if narrow {
        "Cost"
    } else {
        "Cost after each step, px²"
    };
    let damping = if narrow {
        "Damping λ"
    } else {
        "Damping λ of each step"
    };
    draw_axes(panels[0], COST, cost, canvas);
    draw_axes(panels[1], DAMPING, damping, canvas);
    draw_curve(model, panels[0], 0, |state| state.cost, canvas);
    draw_curve(model, panels[1], 1, |state| state.damping, canvas);
}

fn draw_axes(panel: &Panel, [low, high]: [i32; 2], title: &str, canvas: &mut Canvas) {
    let rect = panel.rect;
    canvas.panel(rect);
    let place = (rect.x - LEFT + 2.0, rect.y - TITLE / 2.0);
    canvas.label(place, title, TextStyle::new(Role::Ink, TEXT));
    let muted = TextStyle::new(Role::Muted, SMALL);
    let grid = Stroke::solid(Role::Grid, 1.0);
    for decade in (low..=high).filter(|decade| decade % 3 == 0) {
        let y = panel.canvas_from_world((0.0, f64::from(decade))).1;
        canvas.line((rect.x + 1.0, y), (rect.right() - 1.0, y), grid);
        let text = match decade {
            // The font has no raised minus.
            -6 => "1e−6",
            -3 => "0.001",
            0 => "1",
            3 => "1000",
            6 => "10⁶",
            9 => "10⁹",
            _ => "",
        };
        canvas.label((rect.x - 6.0, y), text, muted.end());
    }
    let last = panel.x_axis.end as usize;
    let room = (rect.width / LABEL).max(1.0) as usize;
    let stride = last.div_ceil(room).max(2);
    for step in (0..=last).step_by(stride) {
        let x = panel.canvas_from_world((step as f64, 0.0)).0;
        let text = step.to_string();
        canvas.label((x, rect.bottom() + 11.0), &text, muted.middle());
    }
}

fn draw_curve(
    model: &BundleAdjustment,
    panel: &Panel,
    series: u8,
    value: fn(&State) -> f64,
    canvas: &mut Canvas,
) {
    let Some(answer) = model.answer() else {
        return;
    };
    let place = |(step, state): (usize, &State)| -> Place {
        // What is beyond the axis, or zero, is drawn at its edge.
        let (low, high) = (panel.y_axis.end, panel.y_axis.start);
        let decade = libm::log10(value(state).max(1e-300)).clamp(low, high);
        panel.canvas_from_world((step as f64, decade))
    };
    let places: Vec<Place> = answer.states.iter().enumerate().map(place).collect();
    let role = Role::Series(series);
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        let taken = model.num_taken();
        let x = places[taken].0;
        let now = Stroke::solid(Role::Grip, 1.5).dashed();
        canvas.line((x, panel.rect.y), (x, panel.rect.bottom()), now);
        canvas.polyline(&places, Stroke::solid(role, 2.0));
        for (step, (place, state)) in places.iter().zip(&answer.states).enumerate() {
            match state.accepted {
                true => canvas.marker(*place, 3.5, Shape::Disk, role, true),
                false => canvas.marker(*place, 4.5, Shape::Cross, Role::Outlier, true),
            }
            if step == taken {
                canvas.circle(*place, 7.0, Stroke::solid(Role::Grip, 2.0));
            }
        }
    });
}
