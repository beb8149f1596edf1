//! Both fits to the current points: least squares, and RANSAC after a number of samples.

use crate::kit::line_points::{Consensus, angle_between_deg};
use crate::kit::samples::{Drawn, Rules};
use crate::kit::tally::Tally;
use epipole::math::Line2;
use epipole::robust::fit_line_total_least_squares;
use nalgebra::Point2;

/// Angle from the hidden line above which a line is wrong, degrees.
const WRONG_DEG: f64 = 5.0;

/// Fits for the current points, settings and number of samples, recomputed after each event: a few
/// hundred samples take well under a millisecond.
pub(super) struct Fits {
    /// The hidden line, with the points near it.
    pub(super) truth: Consensus,
    /// Least-squares line; `None` for points without one, such as a square's corners, which RANSAC
    /// can still sample.
    pub(super) least_squares: Option<Line2>,
    pub(super) tally: Option<Tally>,
    /// Message why there is no fit.
    pub(super) problem: Option<String>,
}

/// Acute angles between lines, degrees; `None` if a line is missing.
pub(super) struct Angles {
    pub(super) between: Option<f64>,
    /// From the hidden line.
    pub(super) least_squares: Option<f64>,
    /// From the hidden line.
    pub(super) ransac: Option<f64>,
}

/// Outcome of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    /// Near the hidden line.
    Right,
    /// On a wrong line, which has at least as many votes as the hidden one.
    Outvoted,
    /// On a wrong line, since no sample came near the hidden one.
    Missed,
}

impl Fits {
    /// Fits both ways, drawing `num_samples` samples, or fewer if they are sufficient.
    pub(super) fn new(
        places: &[Point2<f64>],
        truth: Line2,
        rules: Rules,
        num_samples: usize,
    ) -> Self {
        let least_squares = fit_line_total_least_squares(places);
        let tally = Tally::new(places, truth, rules, num_samples);
        let problem = tally.as_ref().err().or(least_squares.as_ref().err());
        Self {
            problem: problem.map(|error| format!("There is no fit: {error}.")),
            truth: Consensus::of(truth, places, rules.epsilon_px),
            least_squares: least_squares.ok(),
            tally: tally.ok(),
        }
    }

    /// Returns the line of the last sample.
    pub(super) fn candidate(&self) -> Option<&Consensus> {
        self.tally.as_ref()?.candidate.as_ref()
    }

    /// Returns the line with the most votes so far, refitted to its inliers.
    pub(super) fn best(&self) -> Option<&Consensus> {
        self.tally.as_ref()?.best.as_ref()
    }

    /// Returns the progress of the loop.
    pub(super) fn drawn(&self) -> Option<Drawn> {
        Some(self.tally.as_ref()?.samples.drawn())
    }

    /// Returns whether the loop has ended.
    pub(super) fn is_finished(&self) -> bool {
        self.drawn().is_some_and(|drawn| drawn.is_finished())
    }

    /// Returns the number of samples drawn so far.
    pub(super) fn num_samples(&self) -> usize {
        self.drawn().map_or(0, |drawn| drawn.count)
    }

    pub(super) fn angles_deg(&self) -> Angles {
        let truth = Some(&self.truth.line);
        let least_squares = self.least_squares.as_ref();
        let ransac = self.best().map(|best| &best.line);
        let angle = |a: Option<&Line2>, b: Option<&Line2>| Some(angle_between_deg(a?, b?));
        Angles {
            between: angle(least_squares, ransac),
            least_squares: angle(least_squares, truth),
            ransac: angle(ransac, truth),
        }
    }

    /// Returns the outcome of the loop, if it has ended.
    pub(super) fn ending(&self) -> Option<Ending> {
        let best = self.best().filter(|_| self.is_finished())?;
        if self.angles_deg().ransac? <= WRONG_DEG {
            Some(Ending::Right)
        } else if best.num_votes() >= self.truth.num_votes() {
            Some(Ending::Outvoted)
        } else {
            Some(Ending::Missed)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULES: Rules = Rules {
        epsilon_px: 1.0,
        seed: 1,
        max_samples: 100,
        msac: false,
        local_optimization: false,
    };

    const LEVEL: Line2 = Line2 {
        a: 0.0,
        b: 1.0,
        c: -2.0,
    };

    #[test]
    fn votes_are_counted_and_the_line_is_fitted_to_them() {
        let mut places: Vec<_> = (0..9).map(|k| Point2::new(f64::from(k), 2.0)).collect();
        places.push(Point2::new(4.0, 90.0));
        let fits = Fits::new(&places, LEVEL, RULES, 100);
        let best = fits.best().unwrap();
        assert_eq!(best.num_votes(), 9);
        assert!(best.line.signed_distance(&Point2::new(100.0, 2.0)).abs() < 1e-9);
        assert_eq!(fits.ending(), Some(Ending::Right));
        assert!(fits.angles_deg().least_squares.unwrap() > 1.0);
        assert!(
            fits.is_finished()
                && fits.num_samples() < 10
                && fits.tally.as_ref().unwrap().sample().len() == 2
        );
    }

    #[test]
    fn too_few_points_are_a_sentence() {
        let fits = Fits::new(&[Point2::new(1.0, 1.0)], LEVEL, RULES, 5);
        assert!(fits.problem.unwrap().starts_with("There is no fit"));
    }
}
