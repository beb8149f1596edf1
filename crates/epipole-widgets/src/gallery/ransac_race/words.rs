//! Readouts and description of `ransac-race`.

use super::fits::Ending;
use super::model::RansacRace;
use crate::contract::{Readout, Words, format_number};
use crate::kit::line_points::Consensus;
use crate::kit::samples::Drawn;

impl Words for RansacRace {
    fn readouts(&self) -> Vec<Readout> {
        let fits = &self.fits;
        let votes = |id, label, consensus: Option<&Consensus>| {
            let of = |count: usize| format!("{count} of {}", self.points.len());
            let votes = consensus.map(Consensus::num_votes);
            Readout::words(id, label, votes.map_or("none yet".to_owned(), of))
        };
        let angle =
            |id, label, angle: Option<f64>| Readout::number(id, label, angle, 1, "°").or("no line");
        let angles = fits.angles_deg();
        let least_squares = angles.least_squares;
        let [drawn, needed] = Drawn::readouts(fits.drawn(), "none");
        vec![
            angle("ransac-error", "RANSAC error", angles.ransac).main(),
            angle("least-squares-error", "Least-squares error", least_squares).main(),
            drawn.main(),
            needed.main(),
            votes("inliers", "Votes now", fits.candidate()),
            votes("best", "Best votes", fits.best()),
            votes("truth-votes", "Hidden line", Some(&fits.truth)),
            angle("between", "Angle between", angles.between),
        ]
    }

    fn describe(&self) -> String {
        let fits = &self.fits;
        if let Some(problem) = &fits.problem {
            return problem.clone();
        }
        let (angles, count) = (fits.angles_deg(), self.points.len());
        let [least_squares, ransac] = [angles.least_squares, angles.ransac]
            .map(|angle| format_number(angle.unwrap_or(0.0), 1));
        let (Some(drawn), Some(best)) = (fits.drawn(), fits.best()) else {
            return format!(
                "{count} points, no sample drawn yet. Least squares is {least_squares}° from the hidden line."
            );
        };
        let truth = fits.truth.num_votes();
        let end = match fits.ending() {
            Some(Ending::Outvoted) => {
                format!("A wrong line has won: the hidden one has only {truth} votes.")
            }
            Some(Ending::Missed) => format!(
                "A wrong line has won: no sample came near the hidden one, which has {truth} votes."
            ),
            _ => drawn.outlook(),
        };
        format!(
            "After {}, the best line has {} of {count} points within {} px and is {ransac}° from the hidden \
             line; least squares is {least_squares}° off. {end}",
            drawn.count_words(),
            best.num_votes(),
            format_number(self.epsilon_px(), 0),
        )
    }
}
