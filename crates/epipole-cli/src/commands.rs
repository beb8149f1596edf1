//! The commands, one a file. A new command is a file here and a line in [`Command`].

mod figure;

use crate::context::Context;
use crate::failure::Failure;
use crate::report::Report;
use clap::Subcommand;

/// What `epipole` can do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Figure(figure::Arguments),
}

impl Command {
    pub(crate) fn run(self, context: &Context) -> Result<Report, Failure> {
        match self {
            Self::Figure(arguments) => figure::run(&arguments, context),
        }
    }
}
