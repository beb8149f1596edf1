//! The command line `epipole`: features, matches, two-view geometry, stereo, structure from motion
//! and the book's figures, from files to a table or to JSON.
//!
//! Standard output carries only the result; warnings and progress go to standard error. Exit
//! status: 0 success, 1 failure, 2 wrong usage.

mod camera;
mod commands;
mod config;
mod content;
mod context;
mod failure;
mod features;
mod files;
#[cfg(test)]
mod fuzz;
mod interrupt;
mod known_camera;
mod lens;
mod listing;
mod match_file;
mod matrices;
mod model;
mod model_images;
mod output_folder;
mod pattern;
mod photo;
mod picture;
mod progress;
mod reading;
mod refinement;
mod report;
mod robust;
mod rotation_only;
mod short_help;
mod units;

use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser};
use commands::Command;
use context::Context;
use failure::Failure;
use report::Report;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

/// Display order after the options of a single command.
const LAST: usize = 900;

/// Multi-view geometry on your own photos.
#[derive(Debug, Parser)]
#[command(name = "epipole", version, propagate_version = true)]
struct Cli {
    /// Print one JSON object on standard output.
    #[arg(long, global = true, display_order = LAST)]
    json: bool,
    /// Suppress progress and warnings.
    #[arg(long, global = true, display_order = LAST)]
    quiet: bool,
    /// Random seed; equal seeds give equal results.
    #[arg(long, global = true, display_order = LAST, default_value_t = 0, value_name = "N")]
    seed: u64,
    /// Number of threads [default: all cores].
    #[arg(long, global = true, display_order = LAST, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// TOML file of options. Keys before the first table apply to every command, those of [sfm] to
    /// sfm; options on the command line take precedence.
    #[arg(long, global = true, display_order = LAST, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Print the options of the command as TOML for --config, and exit.
    #[arg(long, global = true, display_order = LAST)]
    dump_config: bool,
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    let mut command = command();
    if std::env::args().any(|argument| argument == "-h") {
        command = short_help::shorten(command);
    }
    command.build();
    let arguments = match config::with_file(&command, std::env::args_os().collect()) {
        Ok(arguments) => arguments,
        Err(failure) => {
            print_failure(&failure, is_json_requested());
            return failure.exit_code();
        }
    };
    let parsed = command.clone().try_get_matches_from(&arguments);
    if let Some(dumped) = dump_options(&command, &arguments, &parsed) {
        return dumped;
    }
    let cli = match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => return wrong_usage(&error),
    };
    let context = Context {
        quiet: cli.quiet,
        seed: cli.seed,
    };
    interrupt::listen();
    let start = Instant::now();
    let outcome = set_threads(cli.threads).and_then(|()| cli.command.run(&context));
    let time_ms = start.elapsed().as_secs_f64() * 1e3;
    match outcome {
        Ok(report) => print_report(report, time_ms, cli.json),
        Err(failure) => {
            print_failure(&failure, cli.json);
            failure.exit_code()
        }
    }
}

/// Returns the command line. An option takes the next argument as its value even if it is a
/// negative number, so that the error comes from the option.
fn command() -> clap::Command {
    let with_negatives = |argument: clap::Arg| match argument.get_action().takes_values() {
        true if !argument.is_positional() => argument.allow_negative_numbers(true),
        _ => argument,
    };
    (Cli::command().mut_args(with_negatives))
        .mut_subcommands(|subcommand| subcommand.mut_args(with_negatives))
}

/// Prints the options of a command line with `--dump-config`, even if required arguments are
/// missing.
fn dump_options(
    command: &clap::Command,
    arguments: &[OsString],
    parsed: &Result<clap::ArgMatches, clap::Error>,
) -> Option<ExitCode> {
    if let Err(error) = parsed
        && error.kind() != ErrorKind::MissingRequiredArgument
    {
        return None;
    }
    let matches = config::partial_matches(command, arguments).ok()?;
    let (_, submatches) = matches.subcommand()?;
    if !submatches.get_flag("dump_config") {
        return None;
    }
    Some(match config::dump(command, &matches) {
        Ok(text) => match files::print_bytes(text.as_bytes()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(_) => ExitCode::FAILURE,
        },
        Err(failure) => {
            print_failure(&failure, submatches.get_flag("json"));
            failure.exit_code()
        }
    })
}

/// Prints help, version or a usage error; under `--json` a usage error is JSON.
fn wrong_usage(error: &clap::Error) -> ExitCode {
    if error.use_stderr() && is_json_requested() {
        let message = error.to_string();
        print_failure(
            &Failure::usage(message.trim_start_matches("error: ").trim()),
            true,
        );
    } else if error.print().is_err() {
        return ExitCode::FAILURE;
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}

/// Returns whether `--json` is on the command line, even if the rest is malformed.
fn is_json_requested() -> bool {
    std::env::args().any(|argument| argument == "--json")
}

fn set_threads(threads: Option<u16>) -> Result<(), Failure> {
    let threads = usize::from(threads.unwrap_or(0));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global();
    pool.map_err(|error| Failure::new("threads", format!("the threads cannot be started: {error}")))
}

fn print_report(mut report: Report, time_ms: f64, json: bool) -> ExitCode {
    let printed = match (report.take_output(), json) {
        (None, true) => files::print(&report.into_json(time_ms)),
        (None, false) => files::print(&report.into_table(time_ms)),
        (Some(output), false) => files::print_bytes(&output),
        (Some(_), true) => {
            let message = "--json and an output - are both for standard output: give one of them";
            let failure = Failure::usage(message);
            print_failure(&failure, true);
            return failure.exit_code();
        }
    };
    match printed {
        Ok(()) => ExitCode::SUCCESS,
        Err(_) => ExitCode::FAILURE,
    }
}

fn print_failure(failure: &Failure, json: bool) {
    if json {
        // If standard output is closed, only the exit status can report the failure.
        let _ = files::print(&failure.to_json());
    } else {
        eprintln!("error: {}", failure.message);
    }
}

#[cfg(test)]
mod tests {
    use super::command;

    #[test]
    fn inputs_and_outputs_are_under_no_other_heading() {
        let own = [
            "output", "png", "images", "k", "k2", "focal_px", "gravity", "gravity2",
        ];
        let mut num_checked = 0;
        for subcommand in command().get_subcommands() {
            for argument in subcommand.get_arguments() {
                if own.contains(&argument.get_id().as_str()) {
                    let place = format!("{} {}", subcommand.get_name(), argument.get_id());
                    assert_eq!(argument.get_help_heading(), None, "{place}");
                    num_checked += 1;
                }
            }
        }
        assert!(num_checked > 20, "only {num_checked} were found");
    }
}
