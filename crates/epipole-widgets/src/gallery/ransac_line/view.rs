//! The plane with the last sample, its band and its inliers; the votes of the last samples, one
//! column each, to which votes fly; and the errors of a hundred runs of each kind.

use super::model::RansacLine;
use super::question::NUM_KINDS;
use crate::canvas::{Align, Canvas, Place, Stroke, TextStyle};
use crate::contract::{Aspect, Layout, Panel, Rect, View, format_number};
use crate::kit::grid::{self, Grid, SMALL};
use crate::kit::labels::Labels;
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::line_plane::{self, INLIER, OUTLIER, band, draw_line, draw_point};
use crate::kit::line_points::{Consensus, HEIGHT_PX, WIDTH_PX};
use crate::kit::plot::{self, Ruler};
use crate::kit::tally::Tally;
use crate::theme::Role;

/// Number of last samples shown in the tally.
const SHOWN: usize = 40;
/// Phases, as fractions of a sample's time, at which the band appears, and the first and the last
/// vote depart.
const BANDED: f64 = 0.3;
const FIRST: f64 = 0.35;
const LAST: f64 = 0.72;
/// Flight time of a vote, as a fraction of a sample's time.
const FLIGHT: f64 = 0.26;
const DECADES: [f64; 2] = [-1.7, 1.95];
/// End of the axis, in decades, with room for a number beyond the dots.
const AXIS_END: f64 = 2.75;

const CANDIDATE: Stroke = Stroke::solid(Role::Candidate, 2.0);
const BEST: Stroke = Stroke::solid(Role::Best, 3.0);
const TRUTH: Stroke = Stroke::solid(Role::Truth, 2.0).dotted();
const LEGEND: [Entry; 5] = [
    (Swatch::Line(CANDIDATE), "this sample"),
    (Swatch::Line(BEST), "best so far"),
    (Swatch::Line(TRUTH), "hidden line"),
    (INLIER, "votes"),
    (OUTLIER, "no vote"),
];

/// Draws [`RansacLine`].
#[derive(Default)]
pub(crate) struct RansacLineView;

fn tally_rulers(model: &RansacLine) -> [Ruler; 2] {
    let drawn = model.tally().map_or(0, |tally| tally.votes.len());
    let last = drawn.max(SHOWN) as f64;
    let first = last - SHOWN as f64;
    [
        Ruler::linear(first + 0.5, last + 0.5),
        Ruler::linear(0.0, model.scattered.points.len() as f64),
    ]
}

fn run_rulers() -> [Ruler; 2] {
    [
        Ruler::decades(DECADES[0], AXIS_END),
        Ruler::things(&["count", "MSAC", "local", "both"]),
    ]
}

/// Adds the cells of the plane, the tally and the runs.
fn cells(grid: &mut Grid, width: f64) -> [Rect; 3] {
    const ASPECT: f64 = HEIGHT_PX / WIDTH_PX;
    if grid::is_narrow(width) {
        let [plane] = grid.row([ASPECT], 144.0);
        let [tally, runs] = grid.shares([1.0, 1.0], 106.0);
        return [plane, tally, runs];
    }
    let [plane, side] = grid.row([ASPECT, 0.82], 400.0);
    let [tally, runs] = grid::stack(side, [1.0, 1.1]);
    [plane, tally, runs]
}

impl View for RansacLineView {
    type Model = RansacLine;
    const ASPECT: Aspect = Aspect::Broad;

    fn layout(&self, model: &RansacLine, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        let [plane, tally, runs] = cells(&mut grid, width);
        grid.strip(legend::height(&LEGEND, width, 0.0) + 4.0);
        let ([x, y], [error, kinds]) = (tally_rulers(model), run_rulers());
        grid.layout(vec![
            line_plane::panel("plane", plane),
            plot::panel("tally", tally, &x, &y),
            plot::panel("runs", runs, &error, &kinds),
        ])
    }

    fn draw(&mut self, model: &RansacLine, layout: &Layout, canvas: &mut Canvas) {
        let plane = layout.panel("plane");
        let titles = match model.is_decided() {
            true => [
                "The best line, its band, and who is in it",
                "The best line, its voters",
            ],
            false => [
                "Two points, the band around their line, and who is in it",
                "Two points, a band, votes",
            ],
        };
        grid::open(canvas, plane, &titles);
        let votes = ["Votes for each sample", "Votes"];
        let tally = plot::open(canvas, layout, "tally", &votes, &tally_rulers(model));
        let titles = [
            "100 runs each: degrees off, and how many within 1°",
            "100 runs each: degrees off",
            "100 runs: ° off",
        ];
        let runs = plot::open(canvas, layout, "runs", &titles, &run_rulers());
        draw_runs(model, runs, canvas);
        legend::draw_last(canvas, &LEGEND, layout, 0.0, 4.0);
        match model.tally() {
            Ok(counted) => {
                canvas.clipped(plane.rect.inset(1.0), |canvas| {
                    draw_plane(model, counted, plane, canvas);
                });
                draw_tally(model, counted, tally, canvas);
                draw_flight(model, counted, [plane, tally], canvas);
            }
            Err(sentence) => grid::notice(canvas, plane.rect, sentence),
        }
    }
}

/// Interpolates from 0 to 1 between `start` and `end`, slowly at both ends.
fn eased(phase: f64, start: f64, end: f64) -> f64 {
    let share = ((phase - start) / (end - start)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

fn draw_plane(model: &RansacLine, tally: &Tally, panel: &Panel, canvas: &mut Canvas) {
    let (phase, scattered) = (model.phase(), &model.scattered);
    let region = scattered.region;
    let region_rect = panel.rect_between((region.x, region.y), (region.right(), region.bottom()));
    let good = scattered.points.len() - scattered.num_outliers.min(scattered.points.len());
    let outliers = scattered.points.iter().skip(good);
    let in_region = outliers.filter(|point| region.contains((point.x, point.y)));
    let num_in_region = in_region.count();
    if num_in_region > 0 {
        let stroke = Stroke::solid(Role::Outlier, 1.25).dashed();
        canvas.polygon_outline(&region_rect.corners(), stroke);
        let style = TextStyle::new(Role::Outlier, SMALL).cased();
        let above = region_rect.y - 9.0;
        let has_room = above > panel.rect.y + 8.0;
        let row = if has_room {
            above
        } else {
            region_rect.bottom() + 9.0
        };
        let text = format!("{num_in_region} of {} outliers", scattered.num_outliers);
        canvas.label((region_rect.x, row), &text, style);
    }
    // At the end the winner and its inliers are shown, not the last sample.
    let is_decided = model.is_decided();
    let candidate = match is_decided {
        true => tally.best.as_ref(),
        false => tally.candidate.as_ref(),
    };
    if let Some(candidate) = candidate {
        let width_px = model.epsilon_px() * eased(phase, 0.1, BANDED);
        if width_px > 0.0 {
            band(canvas, panel, &candidate.line, width_px);
        }
    }
    draw_line(canvas, panel, &scattered.truth, TRUTH);
    if let Some(candidate) = candidate.filter(|_| !is_decided) {
        draw_line(canvas, panel, &candidate.line, CANDIDATE);
    }
    // The best line is known once the votes are counted.
    if let Some(best) = tally.best.as_ref().filter(|_| phase >= 1.0) {
        draw_line(canvas, panel, &best.line, BEST);
    }
    let radius = (panel.scale_x() * 4.5).clamp(2.5, 4.5);
    for (index, point) in scattered.points.iter().enumerate() {
        let place = panel.place_of(point);
        let banded = candidate.filter(|_| phase >= BANDED);
        draw_point(
            canvas,
            place,
            radius,
            banded.map(|line| line.is_inlier[index]),
        );
        if !is_decided && tally.sample().contains(&index) {
            canvas.circle(place, radius + 5.0, Stroke::solid(Role::Candidate, 3.0));
        }
    }
}

/// Returns the number of the last sample's votes that have arrived.
fn num_landed(phase: f64, num_votes: usize) -> usize {
    (0..num_votes)
        .filter(|index| flown(phase, *index, num_votes) >= 1.0)
        .count()
}

/// Returns the fraction of its flight that a vote has completed.
fn flown(phase: f64, index: usize, num_votes: usize) -> f64 {
    if phase >= 1.0 {
        return 1.0;
    }
    let start = FIRST + (LAST - FIRST) * index as f64 / num_votes.max(1) as f64;
    eased(phase, start, start + FLIGHT)
}

fn draw_tally(model: &RansacLine, tally: &Tally, panel: &Panel, canvas: &mut Canvas) {
    let (phase, drawn) = (model.phase(), tally.votes.len());
    let first = drawn.saturating_sub(SHOWN);
    let kept = tally.votes[..first].iter().filter(|vote| vote.is_best);
    let mut best = kept.map(|vote| vote.num_votes).max().unwrap_or(0);
    let mut steps: Vec<(f64, f64)> = Vec::new();
    for (index, vote) in tally.votes.iter().enumerate().skip(first) {
        let is_last = index + 1 == drawn;
        let height = match is_last {
            true => num_landed(phase, vote.num_votes),
            false => vote.num_votes,
        };
        let number = index as f64 + 1.0;
        let mut column = panel.rect_between((number - 0.36, height as f64), (number + 0.36, 0.0));
        column.width = column.width.max(1.0);
        let counts = vote.is_best && (!is_last || phase >= 1.0);
        let role = if counts { Role::Best } else { Role::Candidate };
        canvas.fill_rect(column, role, if counts { 1.0 } else { 0.55 });
        if counts {
            best = best.max(vote.num_votes);
        }
        steps.push((number - 0.5, best as f64));
        steps.push((number + 0.5, best as f64));
    }
    if best > 0 {
        plot::draw_curve(canvas, panel, steps, Stroke::solid(Role::Best, 1.5));
    }
    let truth = tally.truth.num_votes() as f64;
    let ends = [panel.x_axis.start, panel.x_axis.end].map(|x| (x, truth));
    plot::draw_curve(canvas, panel, ends, TRUTH);
    let mut labels = Labels::new(panel.rect.inset(2.0));
    let (x, y) = panel.canvas_from_world((panel.x_axis.end, truth));
    let style = TextStyle::new(Role::Truth, SMALL).cased();
    let places = [
        ((x - 4.0, y - 10.0), Align::End),
        ((x - 4.0, y + 10.0), Align::End),
    ];
    labels.draw(canvas, &places, "hidden line", style);
}

/// Draws the votes of the last sample in flight from the plane to its column.
fn draw_flight(
    model: &RansacLine,
    tally: &Tally,
    [plane, panel]: [&Panel; 2],
    canvas: &mut Canvas,
) {
    let (phase, drawn) = (model.phase(), tally.votes.len());
    let Some(candidate) = tally.candidate.as_ref().filter(|_| phase < 1.0) else {
        return;
    };
    let num_votes = Consensus::num_votes(candidate);
    let points = model.scattered.points.iter().zip(&candidate.is_inlier);
    let voters = points.filter(|(_, votes)| **votes);
    for (index, (point, _)) in voters.enumerate() {
        let share = flown(phase, index, num_votes);
        if share <= 0.0 || share >= 1.0 {
            continue;
        }
        let from = plane.place_of(point);
        let to = panel.canvas_from_world((drawn as f64, index as f64 + 0.5));
        canvas.disk(between(from, to, share), 3.5, Role::Inlier, 1.0);
    }
}

/// Interpolates between two positions along a slightly rising path.
fn between(from: Place, to: Place, share: f64) -> Place {
    let mix = |a: f64, b: f64| a + (b - a) * share;
    let rise = 26.0 * 4.0 * share * (1.0 - share);
    (mix(from.0, to.0), mix(from.1, to.1) - rise)
}

fn draw_runs(model: &RansacLine, panel: &Panel, canvas: &mut Canvas) {
    let Some(runs) = model.runs() else {
        let text = model.asked.problem().unwrap_or("Running a hundred times …");
        return grid::notice(canvas, panel.rect, text);
    };
    let at = |error_deg: f64, row: f64| {
        let decade = plot::decade(error_deg).clamp(DECADES[0], DECADES[1]);
        panel.canvas_from_world((decade, row))
    };
    canvas.clipped(panel.rect.inset(1.0), |canvas| {
        for kind in 0..NUM_KINDS {
            let row = kind as f64 + 1.0;
            let is_chosen = kind == model.kind();
            let role = if is_chosen {
                Role::Best
            } else {
                Role::Reference
            };
            for (index, run) in runs.0[kind].iter().enumerate() {
                // Spread over the row, to avoid overlaps.
                let aside = 0.6 * ((index * 37 % 100) as f64 / 100.0 - 0.5);
                canvas.disk(at(run.error_deg, row + aside), 1.7, role, 0.8);
            }
            if let Some(median) = runs.median_deg(kind) {
                let ends = [-0.42, 0.42].map(|aside| at(median, row + aside));
                canvas.line(ends[0], ends[1], Stroke::solid(Role::Grip, 3.0).cased());
            }
        }
    });
    let mut labels = Labels::new(panel.rect.inset(2.0));
    for kind in 0..NUM_KINDS {
        let place = (panel.rect.right() - 4.0, at(1.0, kind as f64 + 1.0).1);
        let text = format_number(runs.num_near(kind) as f64, 0);
        let is_chosen = kind == model.kind();
        let role = if is_chosen { Role::Best } else { Role::Muted };
        let style = TextStyle::new(role, SMALL).cased();
        labels.draw(canvas, &[(place, Align::End)], &text, style);
    }
}
