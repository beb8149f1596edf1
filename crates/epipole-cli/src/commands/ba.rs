//! `epipole ba`: bundle adjustment of a problem file.

use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::progress::Progress;
use crate::refinement::RefinementArguments;
use crate::report::Report;
use clap::Args;
use epipole::Error;
use epipole::optim::Termination;
use epipole::sfm::adjust_bal;
use epipole_io::bundle::{read_bal, write_bal};
use std::path::{Path, PathBuf};

/// Refine the cameras and points of a bundle adjustment problem.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole ba problem-49-7776-pre.txt -o refined.txt\n\n\
    JSON: initial_cost and final_cost (half the sum of squares over all observations, pixels²),\n\
    iterations, termination (why it stopped), history ([iteration, cost] of each step)."
)]
pub(crate) struct Arguments {
    /// Problem in the BAL text format.
    problem: PathBuf,
    /// Write the refined problem.
    #[arg(short, long, value_name = "OUT.txt")]
    output: Option<PathBuf>,
    /// Maximum number of steps.
    #[arg(long, default_value_t = 200, value_name = "N")]
    max_iterations: usize,
    #[command(flatten)]
    refinement: RefinementArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let text = files::read_text(&arguments.problem)?;
    let parsed = read_bal(&text);
    let mut problem = parsed.map_err(|error| Failure::from(error).about(&arguments.problem))?;
    let options = arguments.refinement.options(arguments.max_iterations);
    let loss = arguments.refinement.loss();
    let progress = Progress::new(context, "bundle adjustment");
    let initial_cost = problem.cost(loss);
    let mut num_reports = 0;
    let report = adjust_bal(&mut problem, &options, loss, &mut |status| {
        num_reports += 1;
        progress.show(status)
    });
    drop(progress);
    let outcome = match report {
        Ok(report) => Outcome {
            initial_cost: report.initial_cost,
            final_cost: report.final_cost,
            iterations: report.iterations,
            termination: termination(report.termination),
            history: (report.history.iter())
                .map(|step| (step.index, step.cost))
                .collect(),
        },
        // The first report comes before the first step.
        Err(Error::Canceled) => {
            Outcome::canceled(initial_cost, problem.cost(loss), num_reports - 1)
        }
        Err(error) => return Err(cannot_begin(error, &arguments.problem)),
    };
    let mut report = Report::default();
    if let Some(path) = &arguments.output {
        report = report.file(path, write_bal(&problem).into_bytes())?;
    }
    Ok(report
        .field("initial_cost", outcome.initial_cost)
        .field("final_cost", outcome.final_cost)
        .field("iterations", outcome.iterations)
        .field("termination", outcome.termination)
        .field("history", outcome.history)
        .row("initial cost", format!("{:.4}", outcome.initial_cost))
        .row("final cost", format!("{:.6}", outcome.final_cost))
        .row("iterations", outcome.iterations)
        .row("ended by", outcome.termination))
}

/// Result of an adjustment, finished or canceled.
struct Outcome {
    initial_cost: f64,
    final_cost: f64,
    iterations: usize,
    termination: &'static str,
    /// Index and cost of each step.
    history: Vec<(usize, f64)>,
}

impl Outcome {
    fn canceled(initial_cost: f64, final_cost: f64, iterations: usize) -> Self {
        let mut history = vec![(0, initial_cost)];
        if iterations > 0 {
            history.push((iterations, final_cost));
        }
        Self {
            initial_cost,
            final_cost,
            iterations,
            termination: CANCELED,
            history,
        }
    }
}

/// Termination of a canceled loop, for scripts.
pub(super) const CANCELED: &str = "canceled";

/// Returns the error for a problem without an initial cost.
fn cannot_begin(error: Error, path: &Path) -> Failure {
    match error {
        Error::NotFinite { .. } => Failure::new(
            "not-finite",
            "the errors at the start are no finite numbers: a point is level with the center of a camera that sees it, or \
             a number is far too large",
        )
        .about(path),
        Error::TooFew { .. } => Failure::from(error).about(path),
        error => error.into(),
    }
}

/// Returns the reason why a loop stopped, as a word for scripts.
pub(super) fn termination(termination: Termination) -> &'static str {
    match termination {
        Termination::SmallGradient => "small-gradient",
        Termination::SmallStep => "small-step",
        Termination::SmallCostChange => "small-cost-change",
        Termination::MaxIterations => "max-iterations",
        Termination::Stuck => "stuck",
    }
}
