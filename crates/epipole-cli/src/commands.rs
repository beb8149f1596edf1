//! The commands, one a file. A new command is a file here and a line in [`Command`].

mod detect;
mod figure;
mod matching;

use crate::context::Context;
use crate::failure::Failure;
use crate::report::Report;
use clap::Subcommand;

/// What `epipole` can do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Detect(detect::Arguments),
    Match(matching::Arguments),
    Figure(figure::Arguments),
}

impl Command {
    pub(crate) fn run(self, context: &Context) -> Result<Report, Failure> {
        match self {
            Self::Detect(arguments) => detect::run(&arguments, context),
            Self::Match(arguments) => matching::run(&arguments, context),
            Self::Figure(arguments) => figure::run(&arguments, context),
        }
    }
}
