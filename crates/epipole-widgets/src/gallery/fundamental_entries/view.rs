//! Both photographs with the matches and their lines; beside or below them the nine entries of F
//! and its singular values.

use super::entries::{Entries, Truth, cameras};
use super::model::{FundamentalEntries, MATRIX};
use super::words::NO_LINES;
use crate::canvas::{Canvas, Shape, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::cells::fitting_size;
use crate::kit::grid::{self, Grid, SMALL, TEXT};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::matches::line2;
use crate::kit::meeting::Meeting;
use crate::kit::pair::{Photos, draw_epipole, draw_line, series};
use crate::kit::plot::{self, List, Ruler};
use crate::kit::scenes::{PHOTO_ASPECT, PHOTO_SIZE, in_picture};
use crate::theme::Role;
use epipole::epipolar::epipoles;
use nalgebra::Matrix3;

const MARKER: f64 = 5.0;
const SINGULAR_VALUES: &[&str] = &["s₁", "s₂", "s₃"];
const DECADES: [f64; 2] = [-8.0, 0.6];
/// Mark of an entry before its change.
const BEFORE: Stroke = Stroke::solid(Role::Truth, 2.0);
const RESIDUAL: Stroke = Stroke::solid(Role::Ink, 2.0).dotted();

/// Draws [`FundamentalEntries`].
#[derive(Default)]
pub(crate) struct FundamentalEntriesView {
    photos: Photos,
}

fn rulers() -> [Ruler; 2] {
    [
        Ruler::things(SINGULAR_VALUES),
        Ruler::decades(DECADES[0], DECADES[1]),
    ]
}

fn legend_entries() -> [Entry; 3] {
    [
        (Swatch::Line(RESIDUAL), "distance"),
        (Swatch::Marker(Shape::Ring, Role::Grip), "probe's match"),
        (Swatch::Line(BEFORE), "before"),
    ]
}

impl View for FundamentalEntriesView {
    type Model = FundamentalEntries;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, _: &FundamentalEntries, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let shares = [[1.0, 0.9], [1.7, 1.0]];
        let [first, second, matrix, values] = grid.photographs_and_two(PHOTO_ASPECT, shares);
        grid.strip(legend::height(&legend_entries(), width, 0.0) + 4.0);
        let [x, y] = rulers();
        grid.layout(vec![
            Panel::photograph("first", first, PHOTO_SIZE).clickable(),
            Panel::photograph("second", second, PHOTO_SIZE),
            Panel::new(MATRIX, matrix, [0.0, 3.0], [0.0, 3.0]).clickable(),
            plot::panel("values", values, &x, &y),
        ])
    }

    fn draw(&mut self, model: &FundamentalEntries, layout: &Layout, canvas: &mut Canvas) {
        let matrix_titles: &[_] = if model.change().is_normalized {
            &["F, normalized: click an entry", "F, normalized"]
        } else {
            &["F, in pixels: click an entry", "F, in pixels"]
        };
        let titles: [(_, &[_]); 3] = [
            ("first", &["Photograph 1: drag the probe", "Photograph 1"]),
            ("second", &["Photograph 2: the lines of F", "Photograph 2"]),
            (MATRIX, matrix_titles),
        ];
        let [first, second, matrix] = grid::open_all(canvas, layout, titles);
        let values = layout.panel("values");
        plot::title_from_left(canvas, values, &["Singular values of F", "Singular values"]);
        self.photos.draw(canvas, [first, second], &cameras());
        let [x, y] = rulers();
        plot::draw_axes(canvas, values, &x, &y);
        legend::draw_last(canvas, &legend_entries(), layout, 0.0, 4.0);
        let (Ok(entries), Some(truth)) = (model.entries(), model.truth()) else {
            return grid::notice(
                canvas,
                second.rect,
                model.entries().err().unwrap_or_default(),
            );
        };
        canvas.clipped(first.rect, |canvas| draw_first(model, truth, first, canvas));
        canvas.clipped(second.rect, |canvas| {
            draw_second(model, entries, truth, second, canvas);
        });
        draw_matrix(model, entries, truth, matrix, canvas);
        draw_values(entries, values, canvas);
        if entries.mean_px.is_none() {
            grid::notice(canvas, second.rect, NO_LINES);
        }
    }

    fn prepare(&mut self, _: &FundamentalEntries) -> bool {
        self.photos.prepare(&cameras())
    }

    fn refine(&mut self, _: &FundamentalEntries) -> bool {
        self.photos.refine(&cameras())
    }
}

fn draw_first(model: &FundamentalEntries, truth: &Truth, panel: &Panel, canvas: &mut Canvas) {
    for (index, (pixel1, _)) in truth.matches.iter().enumerate() {
        let (role, shape) = series(index);
        canvas.marker(panel.place_of(pixel1), MARKER, shape, role, true);
    }
    canvas.grip(panel.place_of(&model.probe()), Role::Grip);
}

/// Draws the lines, the distances of the matches from them, and their intersection.
fn draw_second(
    model: &FundamentalEntries,
    entries: &Entries,
    truth: &Truth,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    for (index, (pixel1, pixel2)) in truth.matches.iter().enumerate() {
        let Some(line) = line2(&entries.fundamental, pixel1) else {
            continue;
        };
        let stroke = Stroke::solid(series(index).0, 1.5).cased();
        draw_line(canvas, panel, &line, stroke);
        // The residual, perpendicular from the match to its line.
        let [from, to] = [*pixel2, line.nearest(pixel2)].map(|pixel| panel.place_of(&pixel));
        canvas.line(from, to, RESIDUAL.cased());
    }
    if let Some(line) = model.probe_line() {
        draw_line(canvas, panel, &line, Stroke::solid(Role::Grip, 3.0).cased());
    }
    let mut labels = Labels::new(panel.rect);
    for (index, (_, pixel2)) in truth.matches.iter().enumerate() {
        let (role, shape) = series(index);
        let place = panel.place_of(pixel2);
        canvas.marker(place, MARKER, shape, role, true);
        labels.keep_free(place, MARKER + 2.0);
    }
    if let Some(pixel2) = model.probe_match() {
        let place = panel.place_of(&pixel2);
        canvas.marker(place, 6.5, Shape::Ring, Role::Grip, true);
        canvas.marker(place, 2.0, Shape::Disk, Role::Grip, true);
        labels.keep_free(place, 9.0);
    }
    if let Some(meeting) = &entries.meeting {
        draw_meeting(meeting, &entries.fundamental, panel, &mut labels, canvas);
    }
}

/// Draws the epipole, or a circle with the lines' mean distance as its radius.
fn draw_meeting(
    meeting: &Meeting,
    fundamental: &Matrix3<f64>,
    panel: &Panel,
    labels: &mut Labels,
    canvas: &mut Canvas,
) {
    if meeting.is_exact() {
        if let Ok((_, epipole2)) = epipoles(fundamental) {
            draw_epipole(canvas, panel, labels, &epipole2, "e′");
        }
        return;
    }
    let place = panel.place_of(&meeting.place);
    let radius = (meeting.miss_px * panel.scale_x()).max(4.0);
    canvas.circle(place, radius, Stroke::solid(Role::Ink, 2.0).cased());
    if in_picture(&meeting.place) {
        let digits = usize::from(meeting.miss_px < 10.0);
        let text = format!("miss by {} px", format_number(meeting.miss_px, digits));
        labels.name(
            canvas,
            (place, radius.min(30.0) + 4.0),
            &text,
            (Role::Ink, TEXT),
        );
    }
}

/// Draws each entry as a number and as a bar from zero, with a tick at its unchanged value.
fn draw_matrix(
    model: &FundamentalEntries,
    entries: &Entries,
    truth: &Truth,
    panel: &Panel,
    canvas: &mut Canvas,
) {
    let change = model.change();
    let before = truth.numbers(change.is_normalized);
    // Entries for pixels differ by orders of magnitude.
    let digits = if change.is_normalized { 3 } else { 6 };
    let largest = entries.numbers.amax().max(before.amax());
    let cell_at = |(row, column): (usize, usize)| {
        let (x, y) = (column as f64, row as f64);
        panel.rect_between((x, y), (x + 1.0, y + 1.0))
    };
    for place in (0..9).map(|index| (index / 3, index % 3)) {
        let cell = cell_at(place);
        canvas.stroke_rect(cell, Stroke::solid(Role::Edge, 1.0));
        let value = entries.numbers[place];
        let is_changed = change.by[place] != 0.0;
        let role = if is_changed { Role::Outlier } else { Role::Ink };
        let text = format_number(value, digits);
        let style = TextStyle::new(role, fitting_size(&text, cell.width - 8.0)).middle();
        let (middle, bar) = (cell.center().0, cell.y + 0.8 * cell.height);
        canvas.label((middle, cell.y + 0.4 * cell.height), &text, style);
        let at = |value: f64| middle + (0.5 * cell.width - 6.0) * value / largest;
        let tick = |x: f64| [(x, bar - 5.0), (x, bar + 5.0)];
        let (zero, end) = (at(0.0), at(value));
        let rect = Rect::new(zero.min(end), bar - 2.5, (end - zero).abs(), 5.0);
        canvas.fill_rect(rect, role, 1.0);
        canvas.polyline(&tick(zero), Stroke::solid(Role::Muted, 1.5));
        if is_changed {
            canvas.polyline(&tick(at(before[place])), BEFORE);
        }
    }
    let selected = cell_at(model.selected_place()).inset(1.5);
    canvas.stroke_rect(selected, Stroke::solid(Role::Grip, 3.0));
}

/// Draws the singular values on a logarithmic axis, zero at its lower end, and the rank.
fn draw_values(entries: &Entries, panel: &Panel, canvas: &mut Canvas) {
    let list = List {
        values: entries.singular_values.as_slice(),
        stroke: Stroke::solid(Role::Inlier, 2.5),
        mark: (Shape::Disk, 4.5),
        name: ("", 0),
    };
    plot::draw_lists(canvas, panel, &[list]);
    // Singular values decrease, so the lower left corner is free.
    let corner = (panel.rect.x + 6.0, panel.rect.bottom() - 11.0);
    let style = TextStyle::new(Role::Inlier, SMALL).cased();
    canvas.label(corner, &format!("rank {}", entries.rank()), style);
}
