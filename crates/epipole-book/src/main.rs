//! `epipole-book build | serve | print | epub | check`.

use anyhow::{Context, Result};
use clap::{Parser, Subcommand};
use epipole_book::edition::EditionOptions;
use epipole_book::epub::{EpubOptions, epub};
use epipole_book::phases::Phases;
use epipole_book::print::print;
use epipole_book::resolve::figures::Widgets;
use epipole_book::serve;
use epipole_book::site::{Options, Outcome, build};
use epipole_book::write::assets::{make_lab, make_vision};
use epipole_book::write::stills;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Builds the Epipole book.
#[derive(Parser)]
#[command(version)]
struct Cli {
    /// The folder with content/, web/ and crates/.
    #[arg(long, global = true, default_value = ".")]
    project: PathBuf,
    /// Print the seconds of each phase at the end.
    #[arg(long, global = true)]
    timings: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Make the site.
    Build {
        /// Output folder; target/book if not given.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Folder with the manual of the Python package, to become a part of the site.
        #[arg(long)]
        manual: Option<PathBuf>,
        /// Folder with the reference of the npm package, to become a part of the site.
        #[arg(long)]
        js_reference: Option<PathBuf>,
        /// As for `serve`: faster, larger, pages that reload.
        #[arg(long, hide = true)]
        live: bool,
    },
    /// Make the site, serve it, and make it again when a file changes.
    Serve {
        /// The port at localhost.
        #[arg(long, default_value_t = 8000)]
        port: u16,
        /// Serve the site in target/book unchanged, as written by `build`, and watch nothing.
        #[arg(long)]
        no_watch: bool,
    },
    /// Make the Lab, in the folder lab/ of the site.
    Lab {
        /// Folder of the site; target/book if not given.
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Make the WebAssembly modules of the npm package of the core.
    Vision,
    /// Write the book as one document for paper, which `make pdf` prints.
    Print {
        /// Output folder; target/print if not given.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Address of the published book, for links to its figures.
        #[arg(long)]
        address: Option<String>,
    },
    /// Write the book as an EPUB 3 file.
    Epub {
        /// Output file; target/epub/epipole.epub if not given.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Address of the published book, for links to its figures.
        #[arg(long)]
        address: Option<String>,
        /// Time of the last change in UTC.
        #[arg(long, default_value = "1980-01-01T00:00:00Z")]
        modified: String,
    },
    /// Look for mistakes in the content only, without making the site.
    Check,
    /// Write the notebooks of the chapters only.
    Notebooks {
        /// Output folder.
        folder: PathBuf,
    },
    /// Write a small picture of each figure, and its words, for pages without widgets.
    Stills {
        /// Output folder.
        folder: PathBuf,
    },
}

fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(cli: &Cli) -> Result<bool> {
    let project = std::path::absolute(&cli.project)
        .with_context(|| format!("{} is not a folder", cli.project.display()))?;
    let out = project.join("target/book");
    let mut options = Options {
        project: project.clone(),
        out: out.clone(),
        assets: true,
        live: true,
        check: false,
        notebooks: None,
        manual: None,
        js_reference: None,
    };
    match &cli.command {
        Command::Build {
            out: chosen,
            manual,
            js_reference,
            live,
        } => {
            options.out = chosen.clone().unwrap_or(out);
            options.manual.clone_from(manual);
            options.js_reference.clone_from(js_reference);
            options.live = *live;
            once(&options, cli.timings)
        }
        Command::Lab { out: chosen } => {
            let start = Instant::now();
            let out = chosen.clone().unwrap_or(out);
            let files = make_lab(&project, &out)?;
            let seconds = start.elapsed().as_secs_f64();
            println!(
                "the Lab, {files} files in {}/lab ({seconds:.1} s)",
                out.display()
            );
            Ok(true)
        }
        Command::Vision => {
            let start = Instant::now();
            let folder = make_vision(&project)?;
            let seconds = start.elapsed().as_secs_f64();
            println!(
                "the modules of the core in {} ({seconds:.1} s)",
                folder.display()
            );
            Ok(true)
        }
        Command::Print {
            out: chosen,
            address,
        } => {
            let options = EditionOptions {
                out: chosen.clone().unwrap_or(project.join("target/print")),
                project,
                address: address.clone(),
            };
            reported(Some(&options.out), cli.timings, |phases| {
                print(&options, &Widgets, phases)
            })
        }
        Command::Epub {
            out: chosen,
            address,
            modified,
        } => {
            let file = project.join("target/epub/epipole.epub");
            let options = EpubOptions {
                edition: EditionOptions {
                    out: chosen.clone().unwrap_or(file),
                    project,
                    address: address.clone(),
                },
                modified: modified.clone(),
                font: true,
            };
            reported(Some(&options.edition.out), cli.timings, |phases| {
                epub(&options, &Widgets, phases)
            })
        }
        Command::Check => {
            options.assets = false;
            options.check = true;
            once(&options, cli.timings)
        }
        Command::Notebooks { folder } => {
            options.assets = false;
            options.check = true;
            options.notebooks = Some(folder.clone());
            once(&options, cli.timings)
        }
        Command::Stills { folder } => {
            let count = stills::write(&Widgets, folder)?;
            println!("{count} pictures in {}", folder.display());
            Ok(true)
        }
        Command::Serve { port, no_watch } => {
            serve::serve(&options, *port, !no_watch)?;
            Ok(true)
        }
    }
}

/// Builds once and prints the outcome. False if the content has problems.
fn once(options: &Options, timings: bool) -> Result<bool> {
    let out = (!options.check).then_some(&*options.out);
    reported(out, timings, |phases| build(options, &Widgets, phases))
}

/// Runs a build and prints its outcome. False if the content has problems.
///
/// * `out`: output folder, if any
fn reported(
    out: Option<&Path>,
    timings: bool,
    build: impl FnOnce(&Phases) -> Result<Outcome>,
) -> Result<bool> {
    let start = Instant::now();
    let phases = Phases::on_stderr();
    let outcome = build(&phases)?;
    if timings {
        eprint!("{}", phases.timings());
    }
    match outcome {
        Outcome::Problems(problems) => {
            for problem in &problems {
                eprintln!("{problem}");
            }
            let count = problems.len();
            eprintln!(
                "{count} problem{} in the content",
                if count == 1 { "" } else { "s" }
            );
            Ok(false)
        }
        Outcome::Built { pages, files } => {
            let seconds = start.elapsed().as_secs_f64();
            match out {
                None => println!("{pages} pages, no problems ({seconds:.1} s)"),
                Some(out) => {
                    let out = out.display();
                    println!("{pages} pages, {files} files in {out} ({seconds:.1} s)");
                }
            }
            Ok(true)
        }
    }
}
