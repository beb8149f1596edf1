//! The plane with its points and lines, the votes above, and a legend below.

use super::fits::Ending;
use super::model::RansacRace;
use crate::canvas::{Canvas, Stroke};
use crate::contract::{Layout, Panel, View};
use crate::kit::grid::{self, GAP, Grid};
use crate::kit::legend::{self, Entry, Swatch};
use crate::kit::line_plane::{self, INLIER, OUTLIER, band, draw_line, draw_point};
use crate::kit::line_points::{Consensus, HEIGHT_PX, WIDTH_PX};
use crate::kit::tally::Tally;
use crate::theme::Role;

/// Maximum height of the plane, CSS pixels, to leave room for the rest.
const TALLEST: f64 = 460.0;
const WHOLE_SCREEN: f64 = 680.0;

const LEAST_SQUARES: Stroke = Stroke::solid(Role::Reference, 2.5).dashed();
const CANDIDATE: Stroke = Stroke::solid(Role::Candidate, 1.75);
const BEST: Stroke = Stroke::solid(Role::Best, 3.5);
const TRUTH: Stroke = Stroke::solid(Role::Truth, 2.0).dotted();
const LEGEND: [Entry; 6] = [
    (Swatch::Line(LEAST_SQUARES), "least squares"),
    (Swatch::Line(CANDIDATE), "this sample"),
    (Swatch::Line(BEST), "best so far"),
    (Swatch::Line(TRUTH), "hidden line"),
    (INLIER, "inlier of the best"),
    (OUTLIER, "outlier"),
];

/// Draws [`RansacRace`].
#[derive(Default)]
pub struct RansacRaceView;

impl View for RansacRaceView {
    type Model = RansacRace;

    fn layout(&self, _: &RansacRace, width: f64) -> Layout {
        let mut grid = Grid::new(width);
        // On a wide page a tall picture would fill the whole screen.
        let is_broad = grid::is_broad(width);
        let tallest = if is_broad { WHOLE_SCREEN } else { TALLEST };
        let [plane] = grid.row([HEIGHT_PX / WIDTH_PX], tallest);
        grid.strip(GAP / 2.0 + legend::height(&LEGEND, width, 0.0));
        grid.layout(vec![line_plane::panel("plane", plane).clickable()])
    }

    fn draw(&mut self, model: &RansacRace, layout: &Layout, canvas: &mut Canvas) {
        let plane = layout.panel("plane");
        canvas.panel(plane.rect);
        canvas.clipped(plane.rect.inset(1.0), |canvas| {
            let fits = &model.fits;
            let [candidate, best] = [fits.candidate(), fits.best()];
            if let Some(candidate) = candidate {
                band(canvas, plane, &candidate.line, model.epsilon_px());
            }
            let lines = [
                (Some(&fits.truth.line), TRUTH),
                (fits.least_squares.as_ref(), LEAST_SQUARES),
                (candidate.map(|candidate| &candidate.line), CANDIDATE),
                (best.map(|best| &best.line), BEST),
            ];
            for (line, stroke) in lines {
                if let Some(line) = line {
                    draw_line(canvas, plane, line, stroke);
                }
            }
            draw_points(canvas, plane, model);
        });
        match &model.fits.problem {
            Some(problem) => grid::notice(canvas, plane.rect, problem),
            None => grid::title(canvas, plane.rect, &standing(model)),
        }
        let top = plane.rect.bottom() + GAP / 2.0;
        legend::draw(canvas, &LEGEND, layout.width, 0.0, top);
    }
}

fn draw_points(canvas: &mut Canvas, plane: &Panel, model: &RansacRace) {
    let radius = (plane.scale_x() * 4.5).clamp(3.0, 4.5);
    let (candidate, best) = (model.fits.candidate(), model.fits.best());
    let sample = model.fits.tally.as_ref().map_or(&[][..], Tally::sample);
    for (index, point) in model.points.iter().enumerate() {
        let place = plane.place_of(&point.place);
        draw_point(
            canvas,
            place,
            radius,
            best.map(|best| best.is_inlier[index]),
        );
        if candidate.is_some_and(|candidate| candidate.is_inlier[index]) {
            canvas.circle(place, radius + 2.5, Stroke::solid(Role::Candidate, 1.25));
        }
        if sample.contains(&index) {
            canvas.circle(place, radius + 5.5, Stroke::solid(Role::Candidate, 3.0));
        }
    }
}

/// Returns the current votes as a sentence.
fn standing(model: &RansacRace) -> String {
    let (fits, num_points) = (&model.fits, model.points.len());
    let votes = |consensus: Option<&Consensus>| consensus.map_or(0, Consensus::num_votes);
    let best = votes(fits.best());
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
            let now = votes(fits.candidate());
            format!("Sample {count}: {now} votes. Best so far: {best} of {num_points}")
        }
    }
}
