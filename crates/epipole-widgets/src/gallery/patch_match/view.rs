//! A row for each patch: the patch itself, and its four candidates.

use super::model::{OPTIONS, PatchMatch};
use super::question::{NUM_OPTIONS, NUM_ROUNDS, Round};
use crate::canvas::{Align, Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, SMALL, TEXT};
use crate::kit::patch::Cuts;
use crate::theme::Role;

/// Gap between the patches of a row and between rows, CSS pixels.
const BETWEEN: f64 = 7.0;
/// Gap between the feature and its candidates, CSS pixels.
const APART: f64 = 22.0;
const FEATURES: [&str; NUM_ROUNDS] = ["1", "2", "3", "4", "5"];

/// Draws [`PatchMatch`].
#[derive(Default)]
pub(crate) struct PatchMatchView {
    cuts: Cuts,
}

impl View for PatchMatchView {
    type Model = PatchMatch;

    fn layout(&self, _: &PatchMatch, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let tallest = if grid::is_narrow(width) { 64.0 } else { 99.0 };
        let room = width - APART - (NUM_OPTIONS as f64 - 1.0) * BETWEEN;
        let side = (room / (NUM_OPTIONS as f64 + 1.0)).min(tallest);
        let rows = NUM_ROUNDS as f64;
        let [cell] = grid.shares([1.0], rows * side + (rows - 1.0) * BETWEEN);
        let all = (NUM_OPTIONS as f64 + 1.0) * side + width - room;
        let left = cell.x + (cell.width - all) / 2.0;
        let mut panels = Vec::new();
        for (round, names) in OPTIONS.iter().enumerate() {
            let y = cell.y + round as f64 * (side + BETWEEN);
            let mut add = |id, x, clickable| {
                let mut panel = Panel::photograph(id, Rect::new(x, y, side, side), (1, 1));
                panel.clickable = clickable;
                panels.push(panel);
            };
            add(FEATURES[round], left, false);
            for (option, name) in names.iter().enumerate() {
                let x = left + side + APART + option as f64 * (side + BETWEEN);
                add(name, x, true);
            }
        }
        grid.layout(panels)
    }

    fn draw(&mut self, model: &PatchMatch, layout: &Layout, canvas: &mut Canvas) {
        let first = layout.panel(FEATURES[0]).rect;
        let others = layout.panel(OPTIONS[0][0]).rect;
        grid::fitting_title(canvas, first, &["Photograph 1", "Patch"]);
        let wordings = ["Photograph 2: which one is it?", "Which one is it?"];
        let all = Rect {
            width: 4.0 * others.width,
            ..others
        };
        grid::fitting_title(canvas, all, &wordings);
        let Some(answer) = model.asked.answer() else {
            let notice = model.asked.stand_in();
            let whole = Rect::new(0.0, first.y, layout.width, layout.height - first.y);
            canvas.panel(whole);
            return grid::notice(canvas, whole, notice);
        };
        let version = 2 * model.asked.version();
        let [photograph1, photograph2] = &answer.photographs;
        for (k, round) in answer.rounds.iter().enumerate() {
            let rect = layout.panel(FEATURES[k]).rect;
            self.cuts
                .draw(canvas, rect, photograph1, &round.feature, version);
            canvas.stroke_rect(rect, Stroke::solid(Role::Grip, 2.0));
            draw_name(canvas, rect, FEATURES[k]);
            for (option, name) in OPTIONS[k].iter().enumerate() {
                let rect = layout.panel(name).rect;
                let spot = &round.options[option];
                self.cuts.draw(canvas, rect, photograph2, spot, version + 1);
                canvas.stroke_rect(rect, Stroke::solid(Role::Edge, 1.0));
                draw_name(canvas, rect, ["A", "B", "C", "D"][option]);
                draw_verdict(model, k, round, option, rect, canvas);
            }
        }
    }
}

/// Draws the name of a patch in its corner.
fn draw_name(canvas: &mut Canvas, rect: Rect, name: &str) {
    let style = TextStyle::new(Role::Ink, TEXT).cased();
    canvas.label((rect.x + 5.0, rect.y + 10.0), name, style);
}

/// Marks the correct option once its round is decided, and shows the descriptor distances once all
/// are.
fn draw_verdict(
    model: &PatchMatch,
    index: usize,
    round: &Round,
    option: usize,
    rect: Rect,
    canvas: &mut Canvas,
) {
    let Some(picked) = model.picked(index) else {
        return;
    };
    let is_right = option == usize::from(round.right);
    let corner = (rect.right() - 10.0, rect.y + 10.0);
    if is_right {
        canvas.stroke_rect(rect.inset(1.5), Stroke::solid(Role::Inlier, 3.0));
        canvas.marker(corner, 5.0, Shape::Disk, Role::Inlier, true);
    } else if option == picked {
        canvas.stroke_rect(rect.inset(1.5), Stroke::solid(Role::Outlier, 3.0).dashed());
        canvas.marker(corner, 5.0, Shape::Cross, Role::Outlier, true);
    }
    if model.is_finished() {
        let is_nearest = option == round.machine();
        let distance = format_number(f64::from(round.distances[option]), 2);
        let text = if is_nearest {
            format!("d = {distance}")
        } else {
            distance
        };
        let style = TextStyle {
            align: Align::Middle,
            ..TextStyle::new(Role::Ink, SMALL).cased()
        };
        canvas.label((rect.center().0, rect.bottom() - 9.0), &text, style);
        if is_nearest {
            let place = (rect.x + 10.0, rect.bottom() - 10.0);
            let place = if rect.width < 80.0 {
                (rect.x + 6.0, place.1 - 14.0)
            } else {
                place
            };
            canvas.marker(place, 4.5, Shape::Diamond, Role::Candidate, true);
        }
    }
}
