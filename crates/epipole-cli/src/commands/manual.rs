//! `epipole manual`: man pages and shell completions.

use crate::failure::Failure;
use crate::files;
use crate::report::Report;
use clap::{Args, ValueEnum};
use clap_complete::Shell;
use std::path::PathBuf;

/// Write manual pages and shell completions.
#[derive(Debug, Args)]
#[command(after_help = "Example: epipole manual -o share\n\n\
    Writes epipole.1 and a page for each command to man1/, and completions for bash, elvish, fish, powershell\n\
    and zsh to completions/. With `export MANPATH=$PWD/share:` the pages of share/man1 are found.\n\n\
    JSON: files (those written).")]
pub(crate) struct Arguments {
    /// Folder for man1/ and completions/.
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report, Failure> {
    let mut command = crate::command();
    command.build();
    let mut written = Vec::new();
    let mut write = |folder: &str, name: String, bytes: &[u8]| -> Result<(), Failure> {
        let folder = arguments.output.join(folder);
        files::make_folder(&folder)?;
        let path = folder.join(name);
        files::write(&path, bytes)?;
        written.push(path.display().to_string());
        Ok(())
    };
    let page = |command: &clap::Command, name: &str| -> Result<Vec<u8>, Failure> {
        let mut bytes = Vec::new();
        clap_mangen::Man::new(command.clone())
            .title(name)
            .render(&mut bytes)
            .map_err(|error| Failure::new("write", error.to_string()))?;
        Ok(bytes)
    };
    write("man1", "epipole.1".to_owned(), &page(&command, "epipole")?)?;
    for one in command.get_subcommands().filter(|one| !one.is_hide_set()) {
        let name = format!("epipole-{}", one.get_name());
        write("man1", format!("{name}.1"), &page(one, &name)?)?;
    }
    for shell in Shell::value_variants() {
        let mut bytes = Vec::new();
        clap_complete::generate(*shell, &mut command, "epipole", &mut bytes);
        let name = match shell {
            Shell::Zsh => "_epipole".to_owned(),
            Shell::PowerShell => "epipole.ps1".to_owned(),
            shell => format!("epipole.{shell}"),
        };
        write("completions", name, &bytes)?;
    }
    Ok(Report::default()
        .row("written", format!("{} files", written.len()))
        .field("files", written))
}
