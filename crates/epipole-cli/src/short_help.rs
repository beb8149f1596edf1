//! Help on one screen.

use clap::Arg;
use clap::builder::Resettable;

/// Leaves options under a heading to `--help`.
pub(crate) fn essential(argument: Arg) -> Arg {
    let is_detail = argument.get_help_heading().is_some();
    argument.hide_short_help(is_detail)
}

/// Puts an option of a heading among those of the command.
pub(crate) fn raised(argument: Arg) -> Arg {
    argument
        .help_heading(Resettable::Reset)
        .hide_short_help(false)
}
