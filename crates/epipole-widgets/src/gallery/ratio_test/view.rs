//! Two photographs and their matches, the curve of all settings, and the patches under the probe.

use super::model::RatioTest;
use super::question::{Answer, Candidate};
use super::tally::Tally;
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::features::SIZE;
use crate::kit::grid::{self, GAP, Grid, SMALL, TITLE};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::patch::{self, Cuts};
use crate::kit::plot::{self, Ruler};
use crate::theme::Role;

/// Stride over correct matches drawn, to keep the photographs visible.
const EVERY: usize = 3;
/// Height of the text below a patch, CSS pixels.
const BELOW: f64 = 20.0;
/// Marks of the three patches, in the photographs and beside them.
const MARKS: [(Role, Shape); 3] = [
    (Role::Grip, Shape::Ring),
    (Role::Series(0), Shape::Disk),
    (Role::Series(3), Shape::Square),
];

const RIGHT: Stroke = Stroke::solid(Role::Inlier, 1.25);
const WRONG: Stroke = Stroke::solid(Role::Outlier, 1.5).dashed();
/// Legend entry of a match that would be rejected next.
const FAINT: Stroke = Stroke::solid(Role::Muted, 0.75);
const LEGEND: [Entry; 3] = [
    (Swatch::Line(RIGHT), "right"),
    (Swatch::Line(WRONG), "wrong"),
    (Swatch::Line(FAINT), "next to go"),
];

/// Draws [`RatioTest`].
#[derive(Default)]
pub(crate) struct RatioTestView {
    cuts: Cuts,
}

fn rulers() -> [Ruler; 2] {
    let percent = |ruler: Ruler| ruler.shown(100.0, "%");
    [
        percent(Ruler::linear(0.2, 0.6)).named("recall"),
        percent(Ruler::linear(0.2, 1.0)),
    ]
}

impl View for RatioTestView {
    type Model = RatioTest;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &RatioTest, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let aspect = grid::aspect(SIZE);
        let [x, y] = rulers();
        let (photographs, curve, patches);
        if grid::is_broad(width) {
            let [first, second, column] = grid.row([aspect, aspect, 1.3], 330.0);
            photographs = [first, second];
            let patches_height = (column.width - 2.0 * GAP) / 3.0 + BELOW;
            let shares = [column.height - patches_height - GAP - TITLE, patches_height];
            [curve, patches] = grid::stack(column, shares);
        } else {
            photographs = grid.row([aspect; 2], 330.0);
            let height = if grid::is_narrow(width) { 128.0 } else { 172.0 };
            [curve, patches] = grid.shares([1.0, 1.0], height);
        }
        grid.strip(legend::height(&LEGEND, width, 0.0) + 4.0);
        let mut panels = vec![
            Panel::photograph("first", photographs[0], SIZE).clickable(),
            Panel::photograph("second", photographs[1], SIZE),
            plot::panel("curve", curve, &x, &y),
        ];
        let names = ["feature", "nearest", "second-nearest"].into_iter();
        let patches = names.zip(squares(patches));
        panels.extend(patches.map(|(id, rect)| Panel::photograph(id, rect, (1, 1))));
        grid.layout(panels)
    }

    fn draw(&mut self, model: &RatioTest, layout: &Layout, canvas: &mut Canvas) {
        let titles: [(_, &[_]); 2] = [
            ("first", &["Photograph 1: click a feature", "Photograph 1"]),
            ("second", &["Photograph 2: its two nearest", "Photograph 2"]),
        ];
        let photographs = grid::open_all(canvas, layout, titles);
        let titles = ["Precision against recall", "Precision"];
        let curve = plot::open(canvas, layout, "curve", &titles, &rulers());
        legend::draw_last(canvas, &LEGEND, layout, 0.0, 1.0);
        let Some(answer) = model.asked.answer() else {
            return grid::notice(canvas, photographs[0].rect, model.asked.stand_in());
        };
        for (panel, photograph) in photographs.into_iter().zip(&answer.photographs) {
            canvas.photograph(panel.rect, photograph.image());
        }
        draw_matches(model, answer, photographs, canvas);
        draw_curves(model, curve, canvas);
        self.draw_probed(model, answer, layout, canvas);
    }
}

/// Returns three squares in a row, with room for text below them.
fn squares(rect: Rect) -> [Rect; 3] {
    let room = rect.height - BELOW;
    let side = ((rect.width - 2.0 * GAP) / 3.0).min(room);
    let all = 3.0 * side + 2.0 * GAP;
    let left = rect.x + (rect.width - all) / 2.0;
    let top = rect.y + (room - side) / 2.0;
    [0.0, 1.0, 2.0].map(|k| Rect::new(left + k * (side + GAP), top, side, side))
}

/// Returns both ends of a match on the page.
fn ends(answer: &Answer, index1: usize, found: &Candidate, panels: [&Panel; 2]) -> [Place; 2] {
    let [u, v] = answer.spots[0][index1].place;
    let [x, y] = answer.spots[1][found.nearest[0] as usize].place;
    let [first, second] = panels;
    [
        first.canvas_from_world((u, v)),
        second.canvas_from_world((x, y)),
    ]
}

fn draw_matches(model: &RatioTest, answer: &Answer, panels: [&Panel; 2], canvas: &mut Canvas) {
    let rules = model.rules();
    let is_small = panels[0].rect.width < 250.0;
    let every = if is_small { 2 * EVERY } else { EVERY };
    let radius = if is_small { 1.5 } else { 2.25 };
    // Faint matches first, so that they cover nothing, then correct ones, then wrong ones.
    for pass in 0..3 {
        for (index1, found) in answer.candidates.iter().enumerate() {
            let is_faint = model.is_on_the_brink(found);
            let wanted = match pass {
                0 => is_faint,
                1 => !is_faint && found.is_right,
                _ => !is_faint && !found.is_right,
            };
            if !(wanted && rules.keep(found)) {
                continue;
            }
            let (stroke, shape) = match found.is_right {
                true => (RIGHT, Shape::Disk),
                false => (WRONG, Shape::Cross),
            };
            let dash = stroke.dash;
            let stroke = if is_faint {
                Stroke { dash, ..FAINT }
            } else {
                stroke
            };
            let [from, to] = ends(answer, index1, found, panels);
            // The selection does not depend on τ, to avoid flicker.
            if !found.is_right && !is_small || index1 % every == 0 {
                canvas.line(from, to, stroke);
            }
            for place in [from, to] {
                canvas.marker(place, radius, shape, stroke.role, !is_small && !is_faint);
            }
        }
    }
}

fn draw_curves(model: &RatioTest, panel: &Panel, canvas: &mut Canvas) {
    let place = |tally: &Tally| Some((tally.recall(), tally.precision()?));
    let is_mutual = model.rules().is_mutual;
    let [without, with] = &model.curves;
    let (now, other) = match is_mutual {
        true => (with, without),
        false => (without, with),
    };
    let style = |is_now| match is_now {
        true => Stroke::solid(Role::Best, 2.0),
        false => Stroke::solid(Role::Reference, 1.25).dashed(),
    };
    for (curve, is_now) in [(other, false), (now, true)] {
        plot::draw_curve(canvas, panel, curve.iter().filter_map(place), style(is_now));
    }
    let Some((recall, precision)) = model.tally().as_ref().and_then(place) else {
        return;
    };
    let at = panel.canvas_from_world((recall, precision));
    canvas.marker(at, 5.0, Shape::Disk, Role::Grip, true);
    let mut labels = Labels::new(panel.rect.inset(3.0));
    for curve in [without, with] {
        for place in curve.iter().filter_map(place) {
            labels.keep_free(panel.canvas_from_world(place), 2.0);
        }
    }
    let ratio = format_number(f64::from(model.rules().max_ratio), 2);
    labels.name(
        canvas,
        (at, 8.0),
        &format!("τ = {ratio}"),
        (Role::Ink, SMALL),
    );
}

impl RatioTestView {
    /// Draws the feature under the probe, its two nearest neighbors, and their patches.
    fn draw_probed(
        &mut self,
        model: &RatioTest,
        answer: &Answer,
        layout: &Layout,
        canvas: &mut Canvas,
    ) {
        let Some((index1, found)) = model.probed() else {
            return;
        };
        let [near, far] = found.nearest.map(|index| answer.spots[1][index as usize]);
        let version = 2 * model.asked.version();
        let three = [
            (answer.spots[0][index1], 0, "first", "feature"),
            (near, 1, "second", "nearest"),
            (far, 1, "second", "second-nearest"),
        ];
        let [d1, d2] = found.distances.map(|d| format_number(f64::from(d), 2));
        let texts = [&*format!("d₁ = {d1}"), &format!("d₂ = {d2}")];
        let texts = ["feature", texts[0], texts[1]];
        let patches = layout.panel("feature").rect;
        let is_kept = model.rules().keep(found);
        let verdict = if is_kept { "keep" } else { "reject" };
        let ratio = format_number(f64::from(found.ratio), 3);
        grid::title(canvas, patches, &format!("d₁/d₂ = {ratio}: {verdict}"));
        for (k, (spot, photograph, panel, id)) in three.into_iter().enumerate() {
            let (role, shape) = MARKS[k];
            let panel = layout.panel(panel);
            patch::draw_window(canvas, panel, &spot, Stroke::solid(role, 2.0).cased());
            let rect = layout.panel(id).rect;
            let picture = &answer.photographs[photograph];
            let version = version + photograph as u64;
            self.cuts.draw(canvas, rect, picture, &spot, version);
            canvas.stroke_rect(rect, Stroke::solid(role, 2.0));
            let place = (rect.center().0, rect.bottom() + BELOW / 2.0 + 1.0);
            canvas.label(place, texts[k], TextStyle::new(Role::Ink, SMALL).middle());
            if k > 0 {
                let corner = (rect.x + 9.0, rect.y + 9.0);
                canvas.marker(corner, 4.5, shape, role, true);
                let place = panel.canvas_from_world((spot.place[0], spot.place[1]));
                canvas.marker(place, 4.0, shape, role, true);
            }
        }
        let probe = layout.panel("first").canvas_from_world(model.probe.place());
        let [u, v] = three[0].0.place;
        let feature = layout.panel("first").canvas_from_world((u, v));
        canvas.line(probe, feature, Stroke::solid(Role::Grip, 1.5).cased());
        canvas.grip(probe, Role::Grip);
    }
}
