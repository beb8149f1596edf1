//! `epipole posegraph`: optimization of a pose graph.

use super::ba::{CANCELED, termination};
use crate::context::Context;
use crate::failure::Failure;
use crate::files;
use crate::progress::Progress;
use crate::refinement::RefinementArguments;
use crate::report::Report;
use clap::Args;
use epipole::progress::Part;
use epipole_io::pose_graph::{read_g2o, write_g2o};
use std::path::PathBuf;

/// Optimize a pose graph.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: epipole posegraph INTEL.g2o -o optimized.g2o\n\n\
    JSON: initial_chi2 (with --initialize after it) and final_chi2, sums of squares weighted by information\n\
    regardless of the loss, iterations, termination (why it stopped), num_vertices, num_edges,\n\
    num_landmarks, num_priors, notes (what was left out)."
)]
pub(crate) struct Arguments {
    /// g2o file of poses; scales, pose priors and point landmarks are read too.
    graph: PathBuf,
    /// Place the vertices from the measurements first (ignoring their poses in the file).
    #[arg(long)]
    initialize: bool,
    /// Maximum number of steps.
    #[arg(long, default_value_t = 100, value_name = "N")]
    max_iterations: usize,
    /// Write the optimized graph.
    #[arg(short, long, value_name = "OUT.g2o")]
    output: Option<PathBuf>,
    #[command(flatten)]
    refinement: RefinementArguments,
}

pub(crate) fn run(arguments: &Arguments, context: &Context) -> Result<Report, Failure> {
    let text = files::read_text(&arguments.graph)?;
    let parsed = read_g2o(&text);
    let read = parsed.map_err(|error| Failure::from(error).about(&arguments.graph))?;
    for note in &read.notes {
        context.warn(note);
    }
    let mut graph = read.graph;
    let progress = Progress::new(context, "pose graph");
    if arguments.initialize {
        let watch = &mut |status| progress.show(status);
        graph.initialize(&mut Part::new(watch, 0.0, 0.0))?;
    }
    let options = arguments.refinement.options(arguments.max_iterations);
    let loss = arguments.refinement.loss();
    let initial_chi2 = graph.chi2();
    let mut num_reports = 0;
    let report = graph.optimize(&options, loss, &mut |status| {
        num_reports += 1;
        progress.show(status)
    });
    drop(progress);
    let (iterations, ended_by) = match report {
        Ok(report) => (report.iterations, termination(report.termination)),
        // The first report comes before the first step.
        Err(epipole::Error::Canceled) => (num_reports - 1, CANCELED),
        Err(error) => return Err(error.into()),
    };
    let final_chi2 = graph.chi2();
    let mut result = Report::default();
    if let Some(path) = &arguments.output {
        result = result.file(path, write_g2o(&graph).into_bytes())?;
    }
    let (num_vertices, edges) = graph.size();
    let landmarks = graph.num_landmarks();
    let vertices = num_vertices - landmarks;
    Ok(result
        .field("initial_chi2", initial_chi2)
        .field("final_chi2", final_chi2)
        .field("iterations", iterations)
        .field("termination", ended_by)
        .field("num_vertices", vertices)
        .field("num_landmarks", landmarks)
        .field("num_edges", edges)
        .field("num_priors", graph.num_priors())
        .field("notes", read.notes)
        .row("vertices and edges", format!("{vertices} and {edges}"))
        .row("landmarks", landmarks)
        .row("priors", graph.num_priors())
        .row("initial χ²", format!("{:.3}", initial_chi2))
        .row("final χ²", format!("{:.3}", final_chi2))
        .row("iterations", iterations)
        .row("ended by", ended_by))
}
