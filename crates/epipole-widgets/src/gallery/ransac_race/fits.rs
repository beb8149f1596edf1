//! Both fits to the points as they are: least squares, and RANSAC after some number of samples.

use crate::kit::line_points::{Consensus, angle_between_deg};
use crate::kit::samples::{Rules, Samples};
use epipole::math::Line2;
use epipole::robust::{LineEstimator, fit_line_total_least_squares};
use nalgebra::Point2;

/// A line farther from the hidden one is a wrong line, degrees.
const WRONG_DEG: f64 = 5.0;

/// What follows from the points, the rules and the number of samples. A few hundred samples take well
/// under a millisecond, so all is computed anew after each event.
pub(super) struct Fits {
    /// The hidden line, with the points near it.
    pub(super) truth: Consensus,
    pub(super) least_squares: Option<Line2>,
    pub(super) samples: Option<Samples<LineEstimator<'static>>>,
    /// The line of the last sample.
    pub(super) candidate: Option<Consensus>,
    /// The line with the most votes so far, fitted to them.
    pub(super) best: Option<Consensus>,
    /// Why there is no fit, as a sentence.
    pub(super) problem: Option<String>,
}

/// Acute angles between lines, degrees; `None` for what has no line yet.
pub(super) struct Angles {
    pub(super) between: Option<f64>,
    /// From the hidden line.
    pub(super) least_squares: Option<f64>,
    /// From the hidden line.
    pub(super) ransac: Option<f64>,
}

/// How a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    /// Near the hidden line.
    Right,
    /// On a wrong line, which has at least as many votes as the hidden one.
    Outvoted,
    /// On a wrong line, because no sample came near the hidden one.
    Missed,
}

impl Fits {
    /// Fits both ways, and draws so many samples, or fewer if they are enough.
    pub(super) fn new(
        places: &[Point2<f64>],
        truth: Line2,
        rules: Rules,
        num_samples: usize,
    ) -> Self {
        let mut fits = Self {
            truth: Consensus::of(truth, places, rules.epsilon_px),
            least_squares: None,
            samples: None,
            candidate: None,
            best: None,
            problem: None,
        };
        if let Err(error) = fits.fit(places, rules, num_samples) {
            fits.problem = Some(format!("There is no fit: {error}."));
        }
        fits
    }

    pub(super) fn angles_deg(&self) -> Angles {
        let truth = Some(&self.truth.line);
        let least_squares = self.least_squares.as_ref();
        let ransac = self.best.as_ref().map(|best| &best.line);
        let angle = |a: Option<&Line2>, b: Option<&Line2>| Some(angle_between_deg(a?, b?));
        Angles {
            between: angle(least_squares, ransac),
            least_squares: angle(least_squares, truth),
            ransac: angle(ransac, truth),
        }
    }

    /// How the loop has ended, if it has.
    pub(super) fn ending(&self) -> Option<Ending> {
        let best = self.best.as_ref().filter(|_| self.is_finished())?;
        if self.angles_deg().ransac? <= WRONG_DEG {
            Some(Ending::Right)
        } else if best.num_votes() >= self.truth.num_votes() {
            Some(Ending::Outvoted)
        } else {
            Some(Ending::Missed)
        }
    }

    fn fit(
        &mut self,
        places: &[Point2<f64>],
        rules: Rules,
        num_samples: usize,
    ) -> Result<(), epipole::Error> {
        // Points that have no least-squares line, such as a square's corners, may still be sampled.
        let least_squares = fit_line_total_least_squares(places);
        self.least_squares = least_squares.as_ref().ok().copied();
        let mut samples = Samples::new(LineEstimator::new(places.to_vec())?, rules)?;
        samples.draw_to(num_samples);
        let consensus = |line: &Line2| Consensus::of(*line, places, rules.epsilon_px);
        let last = samples.last().and_then(|last| last.model.as_ref());
        self.candidate = last.map(consensus);
        self.best = (samples.best()).map(|line| consensus(line).refitted(places));
        self.samples = Some(samples);
        least_squares.map(|_| ())
    }

    /// Whether no more samples are drawn.
    pub(super) fn is_finished(&self) -> bool {
        self.samples.as_ref().is_some_and(Samples::is_finished)
    }

    /// Samples drawn so far.
    pub(super) fn num_samples(&self) -> usize {
        self.samples.as_ref().map_or(0, Samples::count)
    }

    /// The points of the last sample, as indices.
    pub(super) fn sample(&self) -> &[usize] {
        let last = self.samples.as_ref().and_then(Samples::last);
        last.map_or(&[], |last| &last.sample)
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
        let best = fits.best.as_ref().unwrap();
        assert_eq!(best.num_votes(), 9);
        assert!(best.line.signed_distance(&Point2::new(100.0, 2.0)).abs() < 1e-9);
        assert_eq!(fits.ending(), Some(Ending::Right));
        assert!(fits.angles_deg().least_squares.unwrap() > 1.0);
        assert!(fits.is_finished() && fits.num_samples() < 10 && fits.sample().len() == 2);
    }

    #[test]
    fn too_few_points_are_a_sentence() {
        let fits = Fits::new(&[Point2::new(1.0, 1.0)], LEVEL, RULES, 5);
        assert!(fits.problem.unwrap().starts_with("There is no fit"));
    }
}
