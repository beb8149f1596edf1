//! The plane with its points and lines, how the vote stands above, and a legend below.

use super::fits::Ending;
use super::model::RansacRace;
use crate::canvas::{Canvas, Shape, Stroke};
use crate::contract::{Layout, Panel, View};
use crate::kit::grid::{self, GAP, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::line_plane::{self, band, draw_line};
use crate::kit::line_points::{Consensus, HEIGHT_PX, WIDTH_PX};
use crate::theme::Role;

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
        let plane = line_plane::panel("plane", plane).clickable();
        grid.layout(vec![plane])
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
