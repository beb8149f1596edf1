//! Two photographs, their matches from one to the other, and what the votes make of them.

use super::model::{RansacEpipolar, Show};
use crate::canvas::{Canvas, Place, Shape, Stroke, TextStyle};
use crate::contract::{Layout, Panel, View};
use crate::legend::{self, Entry, Swatch};
use crate::pair::{self, TEXT, draw_line};
use crate::theme::Role;
use epipole::epipolar::epipolar_line2;
use nalgebra::Point2;

/// Room to the sides of the legend.
const MARGIN: f64 = 2.0;
/// So many inliers and so many outliers have their connection drawn on a wide page; more would hide
/// everything.
const NUM_CONNECTED: f64 = 70.0;
/// So many inliers have their epipolar line drawn.
const NUM_LINES: usize = 12;

/// Draws [`RansacEpipolar`].
#[derive(Default)]
pub struct RansacEpipolarView;

fn legend_of(model: &RansacEpipolar) -> Vec<Entry> {
    let inlier = match model.show() {
        Show::Lines => (
            Swatch::Line(Stroke::solid(Role::Series(0), 2.0)),
            "epipolar line of an inlier",
        ),
        _ => (Swatch::Line(inlier_stroke()), "inlier of the best F"),
    };
    let mut entries = vec![
        inlier,
        (Swatch::Line(outlier_stroke()), "outlier"),
        (Swatch::Line(sample_stroke()), "last sample of seven"),
    ];
    match model.show() {
        Show::Matches => {}
        Show::Outliers => drop(entries.remove(0)),
        Show::Lines => drop(entries.remove(1)),
    }
    entries
}

fn inlier_stroke() -> Stroke {
    Stroke::solid(Role::Inlier, 1.25)
}

fn outlier_stroke() -> Stroke {
    Stroke::solid(Role::Outlier, 1.25).dashed()
}

fn sample_stroke() -> Stroke {
    Stroke::solid(Role::Candidate, 2.75)
}

impl View for RansacEpipolarView {
    type Model = RansacEpipolar;

    fn layout(&self, model: &RansacEpipolar, width: f64) -> Layout {
        let [first, second] = pair::panels(width, model.sizes());
        let bottom = first.rect.bottom().max(second.rect.bottom());
        Layout {
            width,
            height: bottom + 8.0 + legend::height(&legend_of(model), width, MARGIN),
            panels: vec![first, second],
        }
    }

    fn draw(&mut self, model: &RansacEpipolar, layout: &Layout, canvas: &mut Canvas) {
        let panels = [layout.panel("first"), layout.panel("second")];
        for (index, panel) in panels.iter().enumerate() {
            canvas.panel(panel.rect);
            if let Some(photographs) = model.photographs() {
                canvas.photograph(panel.rect, &photographs[index]);
            } else if model.problem().is_none() {
                let style = TextStyle::new(Role::Muted, TEXT).middle();
                canvas.label(panel.rect.center(), "matching features …", style);
            }
        }
        match model.show() {
            Show::Lines => draw_lines(model, panels, canvas),
            show => draw_matches(model, show, panels, canvas),
        }
        draw_sample(model, panels, canvas);
        draw_probe(model, panels, canvas);
        for (panel, title) in panels.iter().zip(["Photograph 1", "Photograph 2"]) {
            pair::draw_title(canvas, panel.rect, title);
        }
        if let Some(problem) = model.problem() {
            pair::draw_notice(canvas, panels[0].rect, problem);
        } else if let Some(status) = status(model) {
            let place = (panels[0].rect.x + 10.0, panels[0].rect.y + 20.0);
            canvas.text(place, status, TextStyle::new(Role::Ink, TEXT).cased());
        }
        let top = layout.height - legend::height(&legend_of(model), layout.width, MARGIN);
        legend::draw(canvas, &legend_of(model), layout.width, MARGIN, top);
    }
}

/// Both ends of a match, on the page.
type Ends = [Place; 2];

fn ends(model: &RansacEpipolar, [first, second]: [&Panel; 2]) -> Vec<Ends> {
    let matches = model.matches();
    let places = matches.iter().map(|found| {
        [
            first.canvas_from_world((found.pixel1.x, found.pixel1.y)),
            second.canvas_from_world((found.pixel2.x, found.pixel2.y)),
        ]
    });
    places.collect()
}

/// At most `count` of a list, evenly from all of it.
fn thinned<T: Copy>(list: &[T], count: usize) -> Vec<T> {
    let every = list.len().div_ceil(count).max(1);
    list.iter().step_by(every).copied().collect()
}

fn draw_matches(model: &RansacEpipolar, show: Show, panels: [&Panel; 2], canvas: &mut Canvas) {
    let ends = ends(model, panels);
    let Some(best) = model.run().and_then(|run| run.best()) else {
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
        (&outliers, outlier_stroke(), Shape::Cross),
        (&inliers, inlier_stroke(), Shape::Disk),
    ];
    let num_groups = if show == Show::Outliers { 1 } else { 2 };
    // On a phone the photographs are small and below each other.
    let smaller = (panels[0].rect.width.max(panels[0].rect.height) / 370.0).min(1.0);
    let is_stacked = panels[1].rect.y > panels[0].rect.bottom();
    let share = if is_stacked { 0.4 } else { smaller };
    let num_connected = (NUM_CONNECTED * share) as usize;
    for (group, stroke, _) in &groups[..num_groups] {
        for [from, to] in thinned(group, num_connected) {
            canvas.line(from, to, *stroke);
        }
    }
    for (group, stroke, shape) in &groups[..num_groups] {
        for place in group.iter().flatten() {
            canvas.marker(
                *place,
                if is_stacked { 2.0 } else { 2.5 },
                *shape,
                stroke.role,
                true,
            );
        }
    }
}

/// The epipolar lines of some inliers, and the inliers on them.
fn draw_lines(model: &RansacEpipolar, panels: [&Panel; 2], canvas: &mut Canvas) {
    let Some(best) = model.run().and_then(|run| run.best()) else {
        return;
    };
    let matches = model.matches();
    let indices: Vec<usize> = (0..matches.len()).filter(|&k| best.is_inlier[k]).collect();
    let chosen = thinned(&indices, NUM_LINES);
    canvas.clipped(panels[1].rect, |canvas| {
        for (k, &index) in chosen.iter().enumerate() {
            if let Ok(line) = epipolar_line2(&best.fundamental, &matches[index].pixel1) {
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

/// While the loop goes on, the seven matches of the last sample.
fn draw_sample(model: &RansacEpipolar, panels: [&Panel; 2], canvas: &mut Canvas) {
    let candidate = model.run().and_then(|run| run.candidate());
    let Some(candidate) = candidate.filter(|_| !model.is_finished()) else {
        return;
    };
    let ends = ends(model, panels);
    for &index in &candidate.sample {
        let [from, to] = ends[index];
        canvas.line(from, to, sample_stroke().cased());
        for place in [from, to] {
            canvas.circle(place, 5.5, Stroke::solid(Role::Candidate, 2.5).cased());
        }
    }
}

/// A place in photograph 1, and the line on which the best F expects its match.
fn draw_probe(model: &RansacEpipolar, [first, second]: [&Panel; 2], canvas: &mut Canvas) {
    if model.photographs().is_none() {
        return;
    }
    let (u, v) = model.probe();
    let best = model.run().and_then(|run| run.best());
    let line = best.and_then(|best| epipolar_line2(&best.fundamental, &Point2::new(u, v)).ok());
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
    canvas.marker(
        first.canvas_from_world((u, v)),
        6.0,
        Shape::Ring,
        Role::Grip,
        true,
    );
}

/// A word on where the loop stands.
fn status(model: &RansacEpipolar) -> Option<&'static str> {
    let run = model.run()?;
    if model.is_finished() {
        Some(if run.is_confident() {
            "enough samples drawn"
        } else {
            "as many samples as it may draw"
        })
    } else if run.candidate().is_none() {
        Some("press Run or Step")
    } else {
        None
    }
}
