//! Two photographs, the matches between them, and the result of the votes.

use super::model::{RansacEpipolar, Show};
use super::words;
use crate::canvas::{Canvas, Place, Shape, Stroke};
use crate::contract::{Aspect, Layout, Panel, View};
use crate::kit::grid::{self, GAP, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::pair::{draw_line, spread};
use crate::theme::Role;
use epipole::epipolar::epipolar_line2;
use image::RgbImage;

/// Maximum height of a photograph, CSS pixels, to leave room for the rest.
const TALLEST: f64 = 372.0;
/// Maximum number of inliers, and of outliers, drawn as lines on a wide page, to keep the
/// photographs visible.
const NUM_CONNECTED: f64 = 70.0;
/// Number of inliers with their epipolar lines drawn.
const NUM_LINES: usize = 12;

/// Draws [`RansacEpipolar`].
#[derive(Default)]
pub struct RansacEpipolarView;

fn legend_of(model: &RansacEpipolar) -> Vec<Entry> {
    let inlier = match model.show() {
        Show::Lines => (
            Swatch::Line(Stroke::solid(Role::Series(0), 2.0)),
            "line of an inlier",
        ),
        _ => (Swatch::Line(INLIER), "inlier"),
    };
    let mut entries = vec![
        inlier,
        (Swatch::Line(OUTLIER), "outlier"),
        (Swatch::Line(SAMPLE), "last sample"),
    ];
    match model.show() {
        Show::Matches => {}
        Show::Outliers => drop(entries.remove(0)),
        Show::Lines => drop(entries.remove(1)),
    }
    entries
}

const INLIER: Stroke = Stroke::solid(Role::Inlier, 1.25);
const OUTLIER: Stroke = Stroke::solid(Role::Outlier, 1.25).dashed();
const SAMPLE: Stroke = Stroke::solid(Role::Candidate, 2.75);

impl View for RansacEpipolarView {
    type Model = RansacEpipolar;

    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &RansacEpipolar, width: f64) -> Layout {
        let sizes = model.sizes();
        let mut grid = Grid::new(width);
        let [left, right] = grid.row(sizes.map(grid::aspect), TALLEST);
        grid.strip(GAP / 2.0 + legend::height(&legend_of(model), width, 0.0));
        let first = Panel::photograph("first", left, sizes[0]).clickable();
        let second = Panel::photograph("second", right, sizes[1]);
        grid.layout(vec![first, second])
    }

    fn photograph(&mut self, model: &RansacEpipolar, panel: &str) -> Option<RgbImage> {
        let index = ["first", "second"].iter().position(|&name| name == panel)?;
        Some(model.matched()?.photographs[index].image().clone())
    }

    fn draw(&mut self, model: &RansacEpipolar, layout: &Layout, canvas: &mut Canvas) {
        let panels = layout.panels_named(["first", "second"]);
        for (index, panel) in panels.iter().enumerate() {
            canvas.panel(panel.rect);
            if let Some(found) = model.matched() {
                canvas.photograph(panel.rect, found.photographs[index].image());
            }
        }
        match model.show() {
            Show::Lines => draw_lines(model, panels, canvas),
            show => draw_matches(model, show, panels, canvas),
        }
        draw_sample(model, panels, canvas);
        draw_probe(model, panels, canvas);
        let titles: [&[&str]; 2] = [
            &["Photograph 1: drag the probe", "Photograph 1"],
            &["Photograph 2: its epipolar line", "Photograph 2"],
        ];
        for (panel, wordings) in panels.into_iter().zip(titles) {
            grid::fitting_title(canvas, panel.rect, wordings);
        }
        if let Some(notice) = notice(model) {
            grid::notice(canvas, panels[0].rect, &notice);
        }
        let top = panels[0].rect.bottom().max(panels[1].rect.bottom()) + GAP / 2.0;
        legend::draw(canvas, &legend_of(model), layout.width, 0.0, top);
    }
}

/// Both ends of a match, on the page.
type Ends = [Place; 2];

fn ends(model: &RansacEpipolar, [first, second]: [&Panel; 2]) -> Vec<Ends> {
    let matches = model.matches();
    let places = matches.iter().map(|found| {
        [
            first.canvas_from_world((found.places[0][0], found.places[0][1])),
            second.canvas_from_world((found.places[1][0], found.places[1][1])),
        ]
    });
    places.collect()
}

fn draw_matches(model: &RansacEpipolar, show: Show, panels: [&Panel; 2], canvas: &mut Canvas) {
    let ends = ends(model, panels);
    let Some(best) = model.best() else {
        for place in ends.iter().flatten() {
            canvas.marker(*place, 3.0, Shape::Disk, Role::Muted, true);
        }
        return;
    };
    let votes = |wanted: bool| -> Vec<Ends> {
        let marked = ends.iter().zip(&best.is_inlier);
        marked
            .filter(|(_, is)| **is == wanted)
            .map(|(ends, _)| *ends)
            .collect()
    };
    let (inliers, outliers) = (votes(true), votes(false));
    let groups = [
        (&outliers, OUTLIER, Shape::Cross),
        (&inliers, INLIER, Shape::Disk),
    ];
    let num_groups = if show == Show::Outliers { 1 } else { 2 };
    // On a phone the photographs are small.
    let side = panels[0].rect.width.max(panels[0].rect.height);
    let num_connected = (NUM_CONNECTED * (side / 370.0).min(1.0)) as usize;
    let is_small = side < 250.0;
    let radius = if is_small { 1.75 } else { 2.5 };
    for (group, stroke, _) in &groups[..num_groups] {
        for [from, to] in spread(group, num_connected) {
            canvas.line(*from, *to, *stroke);
        }
    }
    for (group, stroke, shape) in &groups[..num_groups] {
        for place in group.iter().flatten() {
            canvas.marker(*place, radius, *shape, stroke.role, !is_small);
        }
    }
}

/// Draws the epipolar lines of some inliers, with the inliers.
fn draw_lines(model: &RansacEpipolar, panels: [&Panel; 2], canvas: &mut Canvas) {
    let Some(best) = model.best() else {
        return;
    };
    let matches = model.matches();
    let indices: Vec<usize> = (0..matches.len()).filter(|&k| best.is_inlier[k]).collect();
    let chosen: Vec<usize> = spread(&indices, NUM_LINES).copied().collect();
    canvas.clipped(panels[1].rect, |canvas| {
        for (k, &index) in chosen.iter().enumerate() {
            if let Ok(line) = epipolar_line2(&best.fundamental, &matches[index].pixel1()) {
                let stroke = Stroke::solid(Role::Series(k as u8), 1.75).cased();
                draw_line(canvas, panels[1], &line, stroke);
            }
        }
    });
    let ends = ends(model, panels);
    for (k, &index) in chosen.iter().enumerate() {
        for place in ends[index] {
            let (role, shape) = (Role::Series(k as u8), Shape::of_series(k));
            canvas.marker(place, 5.0, shape, role, true);
        }
    }
}

/// During the loop, draws the seven matches of the last sample.
fn draw_sample(model: &RansacEpipolar, panels: [&Panel; 2], canvas: &mut Canvas) {
    let last = model.moment().and_then(|moment| moment.last);
    let Some(last) = last.filter(|_| !model.is_finished()) else {
        return;
    };
    let ends = ends(model, panels);
    for &index in &last.sample {
        let [from, to] = ends[index];
        canvas.line(from, to, SAMPLE.cased());
        for place in [from, to] {
            canvas.circle(place, 5.5, Stroke::solid(Role::Candidate, 2.5).cased());
        }
    }
}

/// Draws the probe in photograph 1, and its epipolar line by the best F.
fn draw_probe(model: &RansacEpipolar, [first, second]: [&Panel; 2], canvas: &mut Canvas) {
    if model.matched().is_none() {
        return;
    }
    let probe = model.probe();
    let line = model
        .best()
        .and_then(|best| epipolar_line2(&best.fundamental, &probe).ok());
    if let Some(line) = line {
        canvas.clipped(second.rect, |canvas| {
            draw_line(
                canvas,
                second,
                &line,
                Stroke::solid(Role::Grip, 2.0).cased(),
            );
        });
    }
    canvas.grip(first.place_of(&probe), Role::Grip);
}

/// Returns a hint before there is an F, or a warning about a meaningless one.
fn notice(model: &RansacEpipolar) -> Option<String> {
    let is_untouched = model.num_samples() == 0;
    let before = model.problem().or(model.label());
    let before = before.or(is_untouched.then_some("Press Run or Step."));
    before
        .map(str::to_owned)
        .or_else(|| words::left_open(model))
}
