//! The run that the figure replays: least squares, and RANSAC to some number of samples.

use epipole::math::Line2;
use epipole::robust::{
    Budget, LineEstimator, Ransac, RansacOptions, ScoreKind, Step, fit_line_total_least_squares,
};
use nalgebra::Point2;

const CONFIDENCE: f64 = 0.99;
pub(super) const MAX_SAMPLES: usize = 500;

/// The last sample and its line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    /// Indices into the points.
    pub(super) sample: Vec<usize>,
    pub(super) line: Option<Line2>,
    pub(super) is_inlier: Vec<bool>,
}

/// The largest consensus so far.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Best {
    /// Total least squares through the consensus.
    pub(super) line: Line2,
    pub(super) is_inlier: Vec<bool>,
    pub(super) num_inliers: usize,
}

/// What follows from the settings, the points and the number of samples.
#[derive(Debug, Clone, Default)]
pub(super) struct Outcome {
    pub(super) least_squares: Option<Line2>,
    pub(super) candidate: Option<Candidate>,
    pub(super) best: Option<Best>,
    /// Samples really drawn: no more than the budget asked for.
    pub(super) iterations: usize,
    pub(super) budget: Option<u64>,
    pub(super) finished: bool,
    /// Why there is no run, as a sentence.
    pub(super) problem: Option<String>,
}

/// What is asked of a run.
pub(super) struct Question<'a> {
    pub(super) places: &'a [Point2<f64>],
    pub(super) epsilon_px: f64,
    pub(super) seed: u64,
    /// Samples to draw; fewer are drawn if the budget asks for fewer.
    pub(super) iterations: usize,
}

/// Fits both ways and draws the samples.
pub(super) fn run(question: &Question<'_>) -> Outcome {
    let mut outcome = Outcome::default();
    match fit_line_total_least_squares(question.places) {
        Ok(line) => outcome.least_squares = Some(line),
        Err(error) => outcome.problem = Some(format!("There is no fit: {error}.")),
    }
    let options = RansacOptions {
        max_error_px: question.epsilon_px,
        confidence: CONFIDENCE,
        min_iterations: 1,
        max_iterations: MAX_SAMPLES,
        seed: question.seed,
        score: ScoreKind::InlierCount,
        budget: Budget::WithReplacement,
        // The reader sees the plain loop: candidates come straight from two points.
        local_optimization: false,
        score_every_trial: true,
        ..RansacOptions::default()
    };
    let run = LineEstimator::new(question.places.to_vec()).and_then(|e| Ransac::new(e, options));
    match run {
        Ok(mut run) => replay(&mut run, question, &mut outcome),
        Err(error) => outcome.problem = Some(format!("There is no fit: {error}.")),
    }
    outcome
}

fn replay(run: &mut Ransac<LineEstimator<'_>>, question: &Question<'_>, outcome: &mut Outcome) {
    let Question {
        places, epsilon_px, ..
    } = *question;
    let consensus = |line: &Line2| -> Vec<bool> {
        places
            .iter()
            .map(|place| line.signed_distance(place).abs() < epsilon_px)
            .collect()
    };
    let (mut best_line, mut last) = (None, None);
    for _ in 0..question.iterations {
        let Step::Trial(trial) = run.step() else {
            break;
        };
        outcome.iterations = trial.iteration;
        if trial.is_best {
            best_line = trial.model;
        }
        last = Some((trial.sample.to_vec(), trial.model));
    }
    outcome.candidate = last.map(|(sample, line)| Candidate {
        sample,
        is_inlier: line.as_ref().map_or_else(Vec::new, consensus),
        line,
    });
    if let Some(line) = best_line {
        let is_inlier = consensus(&line);
        let chosen: Vec<Point2<f64>> = places
            .iter()
            .zip(&is_inlier)
            .filter(|(_, is)| **is)
            .map(|(p, _)| *p)
            .collect();
        // A consensus without a direction of its own keeps the line of its sample.
        let line = fit_line_total_least_squares(&chosen).unwrap_or(line);
        outcome.best = Some(Best {
            line,
            num_inliers: chosen.len(),
            is_inlier,
        });
    }
    let required = run.required_iterations();
    outcome.budget = (required <= 1_000_000).then_some(required);
    outcome.finished = match outcome.budget {
        Some(budget) => outcome.iterations as u64 >= budget.min(MAX_SAMPLES as u64),
        None => outcome.iterations >= MAX_SAMPLES,
    };
}
