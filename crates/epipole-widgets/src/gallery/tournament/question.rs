//! A batch of runs of all rivals at every outlier ratio.

use super::rivals::{NUM_RIVALS, Pair, fit_lines};
use crate::contract::{Problem, Progress};
use crate::kit::question::{self, tell};
use serde::{Deserialize, Serialize};

/// Number of outlier ratios: 0, 0.1, 0.2 …
pub(super) const NUM_RATIOS: usize = 9;
/// Number of runs per batch: small, so that curves grow and an interrupted tournament keeps its
/// results.
pub(super) const RUNS_AT_ONCE: usize = 20;
/// Number of batches.
pub(super) const NUM_BATCHES: usize = 10;
/// Distance between the run seeds of consecutive seeds of the reader, so that they share no run.
const APART: u64 = 10_000;

/// Estimated model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Subject {
    /// A line from points.
    Line,
    /// F from matches.
    Fundamental,
}

/// Input of a batch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Question {
    pub(super) subject: Subject,
    /// Threshold of the voting rivals, in standard deviations of the noise.
    pub(super) threshold: f64,
    pub(super) seed: u64,
    /// Index of the batch, from 0.
    pub(super) batch: usize,
}

/// Number of successes of each rival at each outlier ratio.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Wins(pub(super) Vec<[usize; NUM_RIVALS]>);

impl Wins {
    /// Creates counts of zero.
    pub(super) fn none() -> Self {
        Self(vec![[0; NUM_RIVALS]; NUM_RATIOS])
    }

    pub(super) fn add(&mut self, more: &Self) {
        let counts = more.0.as_flattened();
        for (sum, count) in self.0.as_flattened_mut().iter_mut().zip(counts) {
            *sum += count;
        }
    }
}

/// Returns the outlier ratio of an index, 0 to 1.
pub(super) fn outlier_ratio(index: usize) -> f64 {
    index as f64 / 10.0
}

impl question::Question for Question {
    type Answer = Wins;
    const LABEL: &'static str = "Running the tournament";
    const FAILED: &'static str = "There are no runs";

    fn answer(&self, progress: Progress<'_>) -> Result<Wins, Problem> {
        let mut wins = Wins::none();
        let first = (self.seed.wrapping_mul(APART)).wrapping_add((self.batch as u64) << 5);
        for run in 0..RUNS_AT_ONCE {
            let seed = first.wrapping_add(run as u64);
            let pair = (self.subject == Subject::Fundamental).then(|| Pair::new(seed));
            for ratio in 0..NUM_RATIOS {
                let share = (run * NUM_RATIOS + ratio) as f64 / (RUNS_AT_ONCE * NUM_RATIOS) as f64;
                tell(progress, share)?;
                let outliers = outlier_ratio(ratio);
                let successes = match &pair {
                    Some(pair) => pair.fit(outliers, self.threshold),
                    None => fit_lines(seed, outliers, self.threshold),
                };
                for (sum, success) in wins.0[ratio].iter_mut().zip(successes) {
                    *sum += usize::from(success);
                }
            }
        }
        Ok(wins)
    }

    fn fits(&self, answer: &Wins) -> bool {
        let mut counts = answer.0.iter().flatten();
        answer.0.len() == NUM_RATIOS && counts.all(|count| *count <= RUNS_AT_ONCE)
    }
}
