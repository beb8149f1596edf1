//! What `ransac-race` says.

use super::fits::Ending;
use super::model::RansacRace;
use crate::contract::{Readout, Words, format_number};

impl Words for RansacRace {
    fn readouts(&self) -> Vec<Readout> {
        let fits = self.fits();
        let of = |count: usize| format!("{count} of {}", self.points().len());
        let votes = |consensus: Option<usize>| consensus.map_or_else(|| "none yet".to_owned(), of);
        let angle = |id, label, angle: Option<f64>| match angle {
            Some(degrees) => Readout::number(id, label, degrees, 1, "°"),
            None => Readout::words(id, label, "no line"),
        };
        let angles = fits.angles_deg();
        let [drawn, needed] = fits.samples.as_ref().map_or_else(
            || {
                [
                    ("iterations", "Samples drawn"),
                    ("budget", "Samples needed"),
                ]
                .map(|(id, label)| Readout::words(id, label, "none"))
            },
            |samples| samples.drawn().readouts(),
        );
        vec![
            angle("ransac-error", "RANSAC error", angles.ransac).main(),
            angle(
                "least-squares-error",
                "Least-squares error",
                angles.least_squares,
            )
            .main(),
            drawn.main(),
            needed.main(),
            Readout::words(
                "inliers",
                "Votes now",
                votes(fits.candidate.as_ref().map(|line| line.num_votes())),
            ),
            Readout::words(
                "best",
                "Best votes",
                votes(fits.best.as_ref().map(|line| line.num_votes())),
            ),
            Readout::words("truth-votes", "Hidden line", of(fits.truth.num_votes())),
            angle("between", "Angle between", angles.between),
        ]
    }

    fn describe(&self) -> String {
        let fits = self.fits();
        if let Some(problem) = &fits.problem {
            return problem.clone();
        }
        let angles = fits.angles_deg();
        let degrees = |angle: Option<f64>| format_number(angle.unwrap_or(0.0), 1);
        let least_squares = degrees(angles.least_squares);
        let (Some(samples), Some(best)) = (&fits.samples, &fits.best) else {
            return format!(
                "{} points, no sample drawn yet. Least squares is {least_squares}° from the hidden \
                 line.",
                self.points().len()
            );
        };
        let end = match fits.ending() {
            Some(Ending::Outvoted) => format!(
                "A wrong line has won: the hidden one has only {} votes.",
                fits.truth.num_votes()
            ),
            Some(Ending::Missed) => format!(
                "A wrong line has won: no sample came near the hidden one, which has {} votes.",
                fits.truth.num_votes()
            ),
            _ => samples.drawn().outlook(),
        };
        format!(
            "After {}, the best line has {} of {} points within {} px and is {}° from the hidden \
             line; least squares is {least_squares}° off. {end}",
            samples.drawn().count_words(),
            best.num_votes(),
            self.points().len(),
            format_number(self.epsilon_px(), 0),
            degrees(angles.ransac),
        )
    }
}
