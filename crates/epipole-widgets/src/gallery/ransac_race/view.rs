//! The plane with its points and lines, how the vote stands above, and a legend below.

use super::fits::{Consensus, Ending};
use super::model::RansacRace;
use super::points::{HEIGHT_PX, WIDTH_PX};
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Axis, Layout, Panel, View};
use crate::kit::grid::{self, GAP, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::theme::Role;
use epipole::math::Line2;

/// The plane must not push everything else off the screen.
const TALLEST: f64 = 460.0;
const WHOLE_SCREEN: f64 = 680.0;

/// Draws [`RansacRace`].
#[derive(Default)]
pub struct RansacRaceView;

fn legend() -> [Entry; 6] {
    [
        (Swatch::Line(least_squares_stroke()), "least squares"),
        (Swatch::Line(candidate_stroke()), "this sample"),
        (Swatch::Line(best_stroke()), "best so far"),
        (Swatch::Line(truth_stroke()), "hidden line"),
        (
            Swatch::Marker(Shape::Disk, Role::Inlier),
            "inlier of the best",
        ),
        (Swatch::Marker(Shape::Cross, Role::Outlier), "outlier"),
    ]
}

fn least_squares_stroke() -> Stroke {
    Stroke::solid(Role::Reference, 2.5).dashed()
}

fn candidate_stroke() -> Stroke {
    Stroke::solid(Role::Candidate, 1.75)
}

fn best_stroke() -> Stroke {
    Stroke::solid(Role::Best, 3.5)
}

fn truth_stroke() -> Stroke {
    Stroke::solid(Role::Truth, 2.0).dotted()
}

impl View for RansacRaceView {
    type Model = RansacRace;

    fn layout(&self, _: &RansacRace, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        // A broad room for a tall picture is a whole screen.
        let tallest = if grid::is_broad(width) {
            WHOLE_SCREEN
        } else {
            TALLEST
        };
        let [plane] = grid.row([HEIGHT_PX / WIDTH_PX], tallest);
        grid.strip(GAP / 2.0 + legend::height(&legend(), width, 0.0));
        grid.layout(vec![Panel {
            id: "plane",
            rect: plane,
            x_axis: Axis {
                start: 0.0,
                end: WIDTH_PX,
            },
            y_axis: Axis {
                start: 0.0,
                end: HEIGHT_PX,
            },
            clickable: true,
        }])
    }

    fn draw(&mut self, model: &RansacRace, layout: &Layout, canvas: &mut Canvas) {
        let plane = layout.panel("plane");
        canvas.panel(plane.rect);
        canvas.clipped(plane.rect.inset(1.0), |canvas| {
            let fits = model.fits();
            let candidate = fits.candidate.as_ref().map(|candidate| candidate.line);
            if let Some(line) = &candidate {
                band(canvas, plane, line, model.epsilon_px());
            }
            draw_line(canvas, plane, &fits.truth.line, truth_stroke());
            if let Some(line) = &fits.least_squares {
                draw_line(canvas, plane, line, least_squares_stroke());
            }
            if let Some(line) = &candidate {
                draw_line(canvas, plane, line, candidate_stroke());
            }
            if let Some(best) = &fits.best {
                draw_line(canvas, plane, &best.line, best_stroke());
            }
            draw_points(canvas, plane, model);
        });
        match &model.fits().problem {
            Some(problem) => grid::notice(canvas, plane.rect, problem),
            None => grid::title(canvas, plane.rect, &standing(model)),
        }
        let top = plane.rect.bottom() + GAP / 2.0;
        legend::draw(canvas, &legend(), layout.width, 0.0, top);
    }
}

/// Both ends of a line, beyond the panel.
fn ends(plane: &Panel, line: &Line2, offset_px: f64) -> [(f64, f64); 2] {
    let foot = (
        -(line.c - offset_px) * line.a,
        -(line.c - offset_px) * line.b,
    );
    let reach = 4.0 * WIDTH_PX;
    [-reach, reach]
        .map(|along| plane.canvas_from_world((foot.0 - along * line.b, foot.1 + along * line.a)))
}

fn draw_line(canvas: &mut Canvas, plane: &Panel, line: &Line2, stroke: Stroke) {
    let [from, to] = ends(plane, line, 0.0);
    canvas.line(from, to, stroke);
}

/// The strip of places within the threshold of the sample's line.
fn band(canvas: &mut Canvas, plane: &Panel, line: &Line2, epsilon_px: f64) {
    let [a, b] = ends(plane, line, -epsilon_px);
    let [d, c] = ends(plane, line, epsilon_px);
    canvas.polygon(&[a, b, c, d], Role::Candidate, 0.13);
    for (from, to) in [(a, b), (d, c)] {
        canvas.line(from, to, Stroke::solid(Role::Candidate, 1.0).dotted());
    }
}

fn draw_points(canvas: &mut Canvas, plane: &Panel, model: &RansacRace) {
    let radius = (plane.scale_x() * 4.5).clamp(3.0, 4.5);
    let fits = model.fits();
    for (index, point) in model.points().iter().enumerate() {
        let place = plane.canvas_from_world((point.place.x, point.place.y));
        let (shape, role) = match fits.best.as_ref().map(|best| best.is_inlier[index]) {
            Some(true) => (Shape::Disk, Role::Inlier),
            Some(false) => (Shape::Cross, Role::Outlier),
            None => (Shape::Disk, Role::Muted),
        };
        canvas.marker(place, radius, shape, role, false);
        let candidate = fits.candidate.as_ref();
        if candidate.is_some_and(|candidate| candidate.is_inlier[index]) {
            canvas.circle(place, radius + 2.5, Stroke::solid(Role::Candidate, 1.25));
        }
        if fits.sample().contains(&index) {
            canvas.circle(place, radius + 5.5, Stroke::solid(Role::Candidate, 3.0));
        }
    }
}

/// How the vote stands.
fn standing(model: &RansacRace) -> String {
    let (fits, num_points) = (model.fits(), model.points().len());
    let votes = |consensus: &Option<Consensus>| consensus.as_ref().map_or(0, Consensus::num_votes);
    let best = votes(&fits.best);
    match (fits.ending(), fits.num_samples()) {
        (_, 0) => "No sample yet: press Run or Step".to_owned(),
        (Some(Ending::Right), count) => {
            format!("{count} samples are enough: {best} of {num_points} votes")
        }
        (Some(Ending::Outvoted | Ending::Missed), _) => {
            let truth = fits.truth.num_votes();
            format!("A wrong line has won: {best} votes, hidden line {truth}")
        }
        (None, count) => {
            let now = votes(&fits.candidate);
            format!("Sample {count}: {now} votes. Best so far: {best} of {num_points}")
        }
    }
}
