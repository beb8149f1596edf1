//! `epipole ba`: bundle adjustment of a problem file.

use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::progress::Progress;
use crate::refinement::RefinementArguments;
use crate::report::Report;
use clap::Args;
use epipole::optim::Termination;
use epipole::progress::{Stage, Status};
use epipole::sfm::{BalProblem, adjust_bal};
use std::path::{Path, PathBuf};

/// Refine the cameras and points of a bundle adjustment problem.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole ba problem-49-7776-pre.txt -o refined.txt\n\n\
    JSON: initial_cost and final_cost (half the sum of squares over all observations, pixels²),\n\
    iterations, termination (why it ended), history ([iteration, cost] of each step)."
)]
pub(crate) struct Arguments {
    /// A problem in the BAL text format.
    problem: PathBuf,
    /// Write the refined problem here.
    #[arg(short, long, value_name = "OUT.txt")]
    output: Option<PathBuf>,
    /// Steps tried at most.
    #[arg(long, default_value_t = 200, value_name = "N")]
    max_iterations: usize,
    #[command(flatten)]
    refinement: RefinementArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let text = files::read_text(&arguments.problem)?;
    let parsed = BalProblem::parse(&text);
    let mut problem = parsed.map_err(|error| Failure::from(error).about(&arguments.problem))?;
    let options = arguments.refinement.options(arguments.max_iterations);
    let loss = arguments.refinement.loss();
    let progress = Progress::new(context, "bundle adjustment");
    let mut history = Vec::new();
    let report = adjust_bal(&mut problem, &options, loss, &mut |iteration| {
        history.push((iteration.index, iteration.cost));
        progress.show(Status {
            stage: Stage::BundleAdjustment,
            share: iteration.index as f32 / arguments.max_iterations.max(1) as f32,
        })
    });
    let report = report.map_err(|error| cannot_begin(error, &arguments.problem))?;
    drop(progress);
    if let Some(path) = &arguments.output {
        files::write(path, problem.to_text().as_bytes())?;
    }
    Ok(Report::default()
        .field("initial_cost", report.initial_cost)
        .field("final_cost", report.final_cost)
        .field("iterations", report.iterations)
        .field("termination", termination(report.termination))
        .field("history", history)
        .row("initial cost", format!("{:.4}", report.initial_cost))
        .row("final cost", format!("{:.6}", report.final_cost))
        .row("iterations", report.iterations)
        .row("ended by", termination(report.termination)))
}

/// What is wrong with the file, where the problem has no cost to begin with.
fn cannot_begin(error: epipole::Error, path: &Path) -> Failure {
    match error {
        epipole::Error::NotFinite { .. } => Failure::new(
            "not-finite",
            "the errors at the start are no finite numbers: a point is level with the center of a camera that sees it, or \
             a number is far too large",
        )
        .about(path),
        epipole::Error::TooFew { .. } => Failure::from(error).about(path),
        error => error.into(),
    }
}

/// Why a loop ended, as a word for scripts.
pub(super) fn termination(termination: Termination) -> &'static str {
    match termination {
        Termination::SmallGradient => "small-gradient",
        Termination::SmallStep => "small-step",
        Termination::SmallCostChange => "small-cost-change",
        Termination::MaxIterations => "max-iterations",
        Termination::Canceled => "canceled",
        Termination::Stuck => "stuck",
    }
}
