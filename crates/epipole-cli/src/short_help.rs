//! The help of `-h`: the options that most people use, on one screen. `--help` has all.

use clap::{Arg, Command};

/// Options that `-h` shows, by their long names, in the order of their definition.
const COMMON: [&str; 62] = [
    "align",
    "baseline-m",
    "board",
    "by-index",
    "camera",
    "describe",
    "dictionary",
    "dpi",
    "features",
    "fill",
    "focal-px",
    "help",
    "images",
    "initialize",
    "json",
    "k",
    "keep",
    "kind",
    "lenses",
    "loss",
    "marker-mm",
    "markers",
    "matches",
    "max-difference-s",
    "max-disparity",
    "max-error-px",
    "max-features",
    "max-iterations",
    "max-megapixels",
    "max-size",
    "mesh",
    "method",
    "min-disparity",
    "min-views",
    "model",
    "num-frames",
    "num-neighbors",
    "output",
    "paper",
    "ply",
    "png",
    "positions",
    "projection",
    "q",
    "ratio",
    "recursive",
    "refine-focal",
    "rig",
    "right",
    "scale",
    "set",
    "size",
    "spacing",
    "square-m",
    "square-mm",
    "step",
    "stereo-baseline-m",
    "theme",
    "to",
    "undistort",
    "version",
    "window",
];

/// Common options that a command with many of them leaves to `--help`.
const RARE: [(&str, &[&str]); 6] = [
    ("localize", &["max-features"]),
    (
        "odometry",
        &["max-error-px", "max-features", "ratio", "recursive"],
    ),
    ("rectify", &["max-error-px", "max-features", "ratio"]),
    (
        "sfm",
        &[
            "max-error-px",
            "max-features",
            "ratio",
            "recursive",
            "undistort",
        ],
    ),
    ("stitch", &["max-features"]),
    ("two-view", &["max-features", "ratio"]),
];

/// Text of an option that is cut at a comma if it is longer, characters.
const LONG: usize = 45;

/// Maximum length of a line, characters.
const WIDTH: usize = 80;

/// The command with its help cut to one screen.
pub(crate) fn shorten(command: Command) -> Command {
    command
        .mut_args(|argument| match argument.get_long() {
            Some("json") => argument,
            _ => argument.hide_short_help(true),
        })
        .mut_subcommands(|subcommand| {
            let name = subcommand.get_name().to_owned();
            let example = subcommand.get_after_help().map(ToString::to_string);
            let example = example
                .as_deref()
                .and_then(|text| text.split("\n\n").next());
            let more = format!("All options and the fields of --json: epipole {name} --help");
            let after = [&wrap_lines(example.unwrap_or_default()), &more[..]].join("\n");
            let rare = RARE.iter().find(|(command, _)| *command == name);
            let rare = rare.map_or(&[][..], |(_, options)| options);
            subcommand
                .mut_args(|argument| short(argument, rare))
                .after_help(after.trim_start().to_owned())
                .disable_version_flag(true)
        })
}

fn short(argument: Arg, rare: &[&str]) -> Arg {
    let is_common = match argument.get_long() {
        Some(name) => COMMON.contains(&name) && !rare.contains(&name),
        None => true,
    };
    if !is_common {
        return argument.hide_short_help(true);
    }
    let help = argument.get_help().map(ToString::to_string);
    let takes_values = argument.get_action().takes_values();
    let argument = argument
        .help(first_phrase(&help.unwrap_or_default()).to_owned())
        .help_heading(None::<&str>);
    match takes_values {
        true => argument.hide_possible_values(true),
        false => argument,
    }
}

/// A command in lines of at most 80 characters.
fn wrap_lines(command: &str) -> String {
    match command.get(..WIDTH - 1).and_then(|start| start.rfind(' ')) {
        Some(end) if command.len() > WIDTH => {
            format!("{} \\\n    {}", &command[..end], &command[end + 1..])
        }
        _ => command.to_owned(),
    }
}

/// The text up to the end of its first phrase.
fn first_phrase(text: &str) -> &str {
    let phrase = before(text, &[". ", "; ", " (", " ["]);
    match phrase.len() > LONG {
        true => before(phrase, &[": ", ", "]),
        false => phrase,
    }
}

/// The text before the first of these.
fn before<'a>(text: &'a str, ends: &[&str]) -> &'a str {
    let end = ends.iter().filter_map(|end| text.find(end)).min();
    end.map_or(text, |end| &text[..end])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::{WIDTH, shorten};
    use crate::command;

    #[test]
    fn short_help_fits_on_a_screen() {
        let mut wrong = Vec::new();
        let mut command = shorten(command());
        command.build();
        for subcommand in command.get_subcommands_mut() {
            let text = subcommand.render_help().to_string();
            let name = subcommand.get_name();
            let count = text.trim_end().lines().count();
            if name != "help" && count > 24 {
                wrong.push(format!("{name} -h has {count} lines"));
            }
            for line in text.lines().filter(|line| line.chars().count() > WIDTH) {
                wrong.push(format!("{name} -h: over 80 characters: {line}"));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }
}
