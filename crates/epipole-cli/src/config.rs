//! Options from a TOML file (`--config`), and the options of a command as TOML (`--dump-config`).
//!
//! Keys before the first table apply to every command, those of a table `[sfm]` to one.

use crate::failure::Failure;
use crate::files;
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command};
use std::ffi::{OsStr, OsString};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// Identifiers of options that a file cannot set.
const NOT_IN_FILES: [&str; 4] = ["config", "dump_config", "help", "version"];

/// Adds the options of the `--config` file to a command line, except those that the line sets or
/// excludes.
///
/// * `command`: built
///
/// # Errors
/// A failure that names the file and the key.
pub(crate) fn with_file(
    command: &Command,
    mut arguments: Vec<OsString>,
) -> Result<Vec<OsString>, Failure> {
    let is_config = |argument: &OsString| argument.to_string_lossy().starts_with("--config");
    if !arguments.iter().any(is_config) {
        return Ok(arguments);
    }
    let Ok(matches) = partial_matches(command, &arguments) else {
        return Ok(arguments);
    };
    let Some((name, submatches)) = matches.subcommand() else {
        return Ok(arguments);
    };
    let (Some(path), Some(subcommand)) = (
        submatches.get_one::<PathBuf>("config"),
        command.find_subcommand(name),
    ) else {
        return Ok(arguments);
    };
    let about = |failure: Failure| failure.about(path);
    let table = table(path)?;
    let added = options(command, subcommand, submatches, &table).map_err(about)?;
    check(command, name, &added).map_err(about)?;
    let end = arguments.iter().position(|argument| argument == "--");
    let end = end.unwrap_or(arguments.len());
    arguments.splice(end..end, added);
    Ok(arguments)
}

/// Parses a command line, even if required arguments are missing.
///
/// # Errors
/// Help and version.
pub(crate) fn partial_matches(
    command: &Command,
    arguments: &[OsString],
) -> Result<ArgMatches, clap::Error> {
    let command = command.clone().ignore_errors(true);
    command.try_get_matches_from(arguments)
}

/// Writes all options of a command as TOML for `--config`. Options without a value become comments.
///
/// # Errors
/// A value that is not Unicode.
pub(crate) fn dump(command: &Command, matches: &ArgMatches) -> Result<String, Failure> {
    let Some((name, submatches)) = matches.subcommand() else {
        return Ok(String::new());
    };
    let mut text = format!("# For epipole {name} --config FILE\n");
    let subcommand = command.find_subcommand(name);
    let all: Vec<&Arg> = subcommand.into_iter().flat_map(settable).collect();
    for is_global in [true, false] {
        if !is_global {
            let _ = write!(text, "\n[{name}]\n");
        }
        for argument in all.iter().filter(|one| one.is_global_set() == is_global) {
            let help = argument
                .get_help()
                .map(ToString::to_string)
                .unwrap_or_default();
            let sentence = help.split(". ").next().unwrap_or_default();
            let key = argument.get_long().unwrap_or_default();
            let _ = writeln!(text, "# {}", sentence.replace('\n', " "));
            let _ = match value(argument, submatches)? {
                Some(value) => writeln!(text, "{key} = {value}"),
                None => writeln!(text, "# {key} ="),
            };
        }
    }
    Ok(text)
}

/// Returns the options that a file can set.
fn settable(command: &Command) -> impl Iterator<Item = &Arg> {
    let is_settable = |argument: &&Arg| {
        argument.get_long().is_some() && !NOT_IN_FILES.contains(&argument.get_id().as_str())
    };
    command.get_arguments().filter(is_settable)
}

/// Returns the value of an option as TOML, if it has one.
fn value(argument: &Arg, matches: &ArgMatches) -> Result<Option<Value>, Failure> {
    let id = argument.get_id().as_str();
    if !argument.get_action().takes_values() {
        return Ok(Some(Value::Boolean(matches.get_flag(id))));
    }
    let Some(raw) = matches.get_raw(id) else {
        return Ok(None);
    };
    let mut values = raw
        .map(|text| scalar(argument, text))
        .collect::<Result<Vec<_>, _>>()?;
    let is_list = matches!(argument.get_action(), clap::ArgAction::Append)
        || argument
            .get_num_args()
            .is_some_and(|range| range.max_values() > 1);
    Ok(match is_list {
        true => Some(Value::Array(values)),
        false => values.pop(),
    })
}

/// Converts text to a TOML number or boolean if TOML spells it the same, else to a string.
fn scalar(argument: &Arg, text: &OsStr) -> Result<Value, Failure> {
    let text = text.to_str().ok_or_else(|| {
        let name = argument.get_long().unwrap_or_default();
        Failure::usage(format!(
            "the value of --{name} is not Unicode, as TOML must be"
        ))
    })?;
    let typed = [
        text.parse().ok().map(Value::Integer),
        text.parse().ok().map(Value::Float),
        text.parse().ok().map(Value::Boolean),
    ];
    let mut typed = typed.into_iter().flatten();
    let as_written = typed.find(|value| value.to_string() == text);
    Ok(as_written.unwrap_or_else(|| Value::String(text.to_owned())))
}

fn table(path: &Path) -> Result<Table, Failure> {
    let text = files::read_text(path)?;
    text.parse().map_err(|error: toml::de::Error| {
        let line = error
            .span()
            .map(|span| 1 + text[..span.start].matches('\n').count());
        let place = line.map_or(String::new(), |line| format!("line {line}: "));
        let message = error.message().lines().next().unwrap_or_default();
        Failure::usage(format!("{place}not TOML: {message}")).about(path)
    })
}

/// Converts the options of a file for a command to arguments.
fn options(
    command: &Command,
    subcommand: &Command,
    matches: &ArgMatches,
    table: &Table,
) -> Result<Vec<OsString>, Failure> {
    let name = subcommand.get_name();
    let mut added = Vec::new();
    for (key, value) in table {
        match value {
            Value::Table(_) if command.find_subcommand(key).is_none() => {
                return Err(Failure::usage(format!(
                    "[{key}] is not a command of epipole"
                )));
            }
            Value::Table(own) if key == name => {
                for (key, value) in own {
                    added.extend(option(subcommand, matches, key, value)?);
                }
            }
            Value::Table(_) => {}
            value => {
                if table.get(name).and_then(|own| own.get(key)).is_none() {
                    added.extend(option(subcommand, matches, key, value)?);
                }
            }
        }
    }
    Ok(added)
}

/// Converts a key and its value to arguments.
fn option(
    subcommand: &Command,
    submatches: &ArgMatches,
    key: &str,
    value: &Value,
) -> Result<Vec<OsString>, Failure> {
    let name = subcommand.get_name();
    let argument = settable(subcommand).find(|argument| argument.get_long() == Some(key));
    let argument = argument.ok_or_else(|| {
        Failure::usage(format!(
            "{key}: epipole {name} has no such option; epipole {name} --dump-config prints all"
        ))
    })?;
    let is_set = |one: &&Arg| {
        submatches.value_source(one.get_id().as_str()) == Some(ValueSource::CommandLine)
    };
    let excludes = |one: &Arg, other: &Arg| {
        let mut excluded = subcommand.get_arg_conflicts_with(one).into_iter();
        excluded.any(|excluded| excluded.get_id() == other.get_id())
    };
    let mut on_command_line = settable(subcommand).filter(is_set);
    let is_out = |one: &Arg| {
        one.get_id() == argument.get_id() || excludes(one, argument) || excludes(argument, one)
    };
    if on_command_line.any(is_out) {
        return Ok(Vec::new());
    }
    if !argument.get_action().takes_values() {
        return match value {
            Value::Boolean(true) => Ok(vec![format!("--{key}").into()]),
            Value::Boolean(false) => Ok(Vec::new()),
            other => Err(Failure::usage(format!(
                "{key} is true or false, not {other}"
            ))),
        };
    }
    let values = match value {
        Value::Array(values) => values.as_slice(),
        one => std::slice::from_ref(one),
    };
    let with_value = |value: &Value| match value {
        Value::String(text) => Ok(format!("--{key}={text}").into()),
        Value::Integer(_) | Value::Float(_) | Value::Boolean(_) => {
            Ok(format!("--{key}={value}").into())
        }
        other => Err(Failure::usage(format!(
            "{key}: a {} cannot be the value of an option",
            other.type_str()
        ))),
    };
    values.iter().map(with_value).collect()
}

/// Checks the values of the file separately, so that an error names the file.
fn check(command: &Command, name: &str, added: &[OsString]) -> Result<(), Failure> {
    let mut command_only: Vec<OsString> = vec!["epipole".into(), name.into()];
    command_only.extend_from_slice(added);
    match command.clone().try_get_matches_from(command_only) {
        Err(error) if error.kind() != ErrorKind::MissingRequiredArgument => {
            let text = error.to_string();
            let line = text.lines().next().unwrap_or_default();
            Err(Failure::usage(line.trim_start_matches("error: ")))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::{dump, partial_matches, with_file};
    use std::ffi::OsString;
    use std::path::PathBuf;

    fn built() -> clap::Command {
        let mut command = crate::command();
        command.build();
        command
    }

    fn file(name: &str, text: &str) -> PathBuf {
        let process = std::process::id();
        let path = std::env::temp_dir().join(format!("epipole-{name}-{process}.toml"));
        std::fs::write(&path, text).unwrap();
        path
    }

    /// Returns the command line with the options of a file, or the error.
    fn merged(name: &str, text: &str, line: &str) -> Result<Vec<String>, String> {
        let path = file(name, text);
        let mut arguments: Vec<OsString> = line.split(' ').map(OsString::from).collect();
        arguments.splice(2..2, ["--config".into(), path.clone().into()]);
        let merged = with_file(&built(), arguments);
        std::fs::remove_file(&path).unwrap();
        match merged {
            Ok(merged) => Ok(merged[4..]
                .iter()
                .map(|argument| argument.to_str().unwrap().to_owned())
                .collect()),
            Err(failure) => Err(failure.message.rsplit(".toml: ").next().unwrap().to_owned()),
        }
    }

    #[test]
    fn a_command_reads_the_options_that_it_dumps() {
        let command = built();
        for subcommand in command
            .get_subcommands()
            .filter(|one| one.get_name() != "help")
        {
            let name = subcommand.get_name();
            let line = ["epipole", name, "--threads", "2"].map(OsString::from);
            let text = dump(&command, &partial_matches(&command, &line).unwrap()).unwrap();
            let path = file(&format!("dumped-{name}"), &text);
            let line = vec![
                "epipole".into(),
                name.into(),
                "--config".into(),
                path.clone().into(),
            ];
            let again = with_file(&command, line).unwrap();
            std::fs::remove_file(&path).unwrap();
            let again = dump(&command, &partial_matches(&command, &again).unwrap()).unwrap();
            assert!(text.contains("threads = 2"), "{text}");
            assert_eq!(text, again);
        }
    }

    #[test]
    fn the_command_line_wins_over_the_file() {
        let text = "seed = 7\n[fit]\nmodel = 'line'\nmax-error-px = 2.5\nk = '1,1,0,0'\n[sfm]\nratio = 0.7\n";
        assert_eq!(
            merged("wins", text, "epipole fit m.txt --model=essential --seed 3").unwrap(),
            [
                "m.txt",
                "--model=essential",
                "--seed",
                "3",
                "--k=1,1,0,0",
                "--max-error-px=2.5"
            ]
        );
        let text = "[two-view]\nk = '1,1,0,0'\n";
        let excluded = merged("excluded", text, "epipole two-view --camera c.json").unwrap();
        assert_eq!(excluded, ["--camera", "c.json"]);
    }

    #[test]
    fn wrong_files_get_a_sentence() {
        let line = "epipole sfm photos";
        for (text, expected) in [
            ("ratio", "line 1: not TOML"),
            ("[smf]\nratio = 0.7", "[smf] is not a command of epipole"),
            ("rato = 0.7", "rato: epipole sfm has no such option"),
            (
                "[sfm]\nrecursive = 'yes'",
                "recursive is true or false, not",
            ),
            ("[sfm]\nratio = 'much'", "invalid value 'much' for '--ratio"),
            (
                "[sfm]\nratio = 2026-01-01",
                "ratio: a datetime cannot be the value",
            ),
        ] {
            let message = merged("wrong", text, line).unwrap_err();
            assert!(message.starts_with(expected), "{message}");
        }
    }
}
