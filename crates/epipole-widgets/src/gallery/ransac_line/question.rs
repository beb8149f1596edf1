//! A hundred runs of each kind, each with its own points.

use crate::contract::{Problem, Progress};
use crate::kit::line_points::{angle_between_deg, scatter};
use crate::kit::question::{self, tell};
use crate::kit::samples::{Rules, inliers_of};
use epipole::Error;
use epipole::robust::{LineEstimator, fit_line_total_least_squares};
use serde::{Deserialize, Serialize};

/// Number of runs of each kind.
pub(super) const NUM_RUNS: usize = 100;
/// Number of kinds of run: MSAC off and on, without and with local optimization; see [`kind`].
pub(super) const NUM_KINDS: usize = 4;
/// Maximum number of samples per run.
pub(super) const MAX_SAMPLES: usize = 500;

/// Returns the index of a kind of run.
pub(super) fn kind(msac: bool, local: bool) -> usize {
    usize::from(msac) + 2 * usize::from(local)
}

/// Errors of the lines of many runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) outlier_ratio: f64,
    pub(super) epsilon_px: f64,
    pub(super) count: usize,
}

/// Result of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Run {
    /// Angle from the hidden line, degrees.
    pub(super) error_deg: f64,
    pub(super) num_samples: usize,
}

/// All runs, by kind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Runs(pub(super) Vec<Vec<Run>>);

impl Runs {
    /// Returns the median error of a kind, degrees.
    pub(super) fn median_deg(&self, kind: usize) -> Option<f64> {
        let mut errors: Vec<f64> = self.0.get(kind)?.iter().map(|run| run.error_deg).collect();
        errors.sort_by(f64::total_cmp);
        let half = errors.len() / 2;
        Some(0.5 * (errors.get(half.checked_sub(1)?)? + errors.get(half)?))
    }

    /// Returns the number of runs of a kind within 1° of the hidden line.
    pub(super) fn num_near(&self, kind: usize) -> usize {
        let runs = self.0.get(kind).map_or(&[][..], Vec::as_slice);
        runs.iter().filter(|run| run.error_deg <= 1.0).count()
    }

    /// Returns the mean number of samples of a kind.
    pub(super) fn mean_samples(&self, kind: usize) -> Option<f64> {
        let runs = self.0.get(kind).filter(|runs| !runs.is_empty())?;
        let sum: usize = runs.iter().map(|run| run.num_samples).sum();
        Some(sum as f64 / runs.len() as f64)
    }
}

impl Question {
    fn run(&self, seed: u64, msac: bool, local: bool) -> Result<Run, Error> {
        let scattered = scatter(seed, self.count, self.outlier_ratio);
        let places = &scattered.points;
        let rules = Rules {
            epsilon_px: self.epsilon_px,
            seed,
            max_samples: MAX_SAMPLES,
            msac,
            local_optimization: local,
        };
        let refit = |is: &[bool]| fit_line_total_least_squares(&inliers_of(places, is));
        let (line, num_samples) = rules.run(LineEstimator::new(places)?, refit)?;
        Ok(Run {
            error_deg: angle_between_deg(&line, &scattered.truth),
            num_samples,
        })
    }
}

impl question::Question for Question {
    type Answer = Runs;
    const LABEL: &'static str = "Running a hundred times";
    const FAILED: &'static str = "There are no runs";

    fn answer(&self, progress: Progress<'_>) -> Result<Runs, Problem> {
        let mut runs = vec![Vec::new(); NUM_KINDS];
        for seed in 1..=NUM_RUNS as u64 {
            tell(progress, seed as f64 / NUM_RUNS as f64)?;
            for (msac, local) in [(false, false), (true, false), (false, true), (true, true)] {
                runs[kind(msac, local)].push(self.run(seed, msac, local)?);
            }
        }
        Ok(Runs(runs))
    }

    fn fits(&self, answer: &Runs) -> bool {
        let is_good = |run: &Run| (0.0..=90.0).contains(&run.error_deg);
        answer.0.len() == NUM_KINDS
            && (answer.0.iter()).all(|runs| runs.len() == NUM_RUNS && runs.iter().all(is_good))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::Question as _;
    use std::ops::ControlFlow;

    #[test]
    fn a_hundred_runs_of_each_kind_are_told_and_can_be_ended() {
        let question = Question {
            outlier_ratio: 0.5,
            epsilon_px: 10.0,
            count: 60,
        };
        let runs = question.answer(&mut |_| ControlFlow::Continue(())).unwrap();
        assert!(question.fits(&runs));
        for kind in 0..NUM_KINDS {
            let median = runs.median_deg(kind).unwrap();
            assert!(median > 0.05 && median < 2.0, "{kind}: {median}");
            assert!(runs.num_near(kind) > 50 && runs.mean_samples(kind).unwrap() > 3.0);
        }
        assert!(question.answer(&mut |_| ControlFlow::Break(())).is_err());
        assert!(!question.fits(&Runs(vec![Vec::new(); NUM_KINDS])));
        assert_eq!(Runs(Vec::new()).median_deg(0), None);
    }
}
