//! Programs that the builder runs, and the locations of their files.

use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

/// Folders of the project that tools need.
pub(crate) struct Tools {
    pub(crate) project: PathBuf,
    /// Folder of the installed npm modules.
    pub(crate) modules: PathBuf,
    /// Folder of intermediate files, kept between builds.
    pub(crate) work: PathBuf,
}

impl Tools {
    pub(crate) fn find(project: &Path) -> Result<Tools> {
        let project = std::path::absolute(project)?;
        let modules = project.join("web/node_modules");
        if !modules.join(".bin/esbuild").exists() {
            bail!("the tools of web/ are not installed: run `make setup` (npm ci in web/)");
        }
        let work = target_folder(&project).join("book-work");
        std::fs::create_dir_all(&work)?;
        Ok(Tools {
            project,
            modules,
            work,
        })
    }

    /// Runs a command and returns its standard output; on failure its output is the error.
    pub(crate) fn run(&self, command: &mut Command) -> Result<String> {
        let name = command.get_program().to_string_lossy().into_owned();
        let output = command
            .current_dir(&self.project)
            .output()
            .with_context(|| format!("{name} cannot be started: is it installed?"))?;
        if !output.status.success() {
            bail!(
                "{name} failed:\n{}",
                String::from_utf8_lossy(&output.stderr).trim()
            );
        }
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

/// Returns Cargo's target folder.
pub(crate) fn target_folder(project: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| project.join("target"), PathBuf::from)
}

/// Reads a file that must exist.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).with_context(|| format!("{} cannot be read", path.display()))
}

/// Returns the modification time of a file, or the newest one in a folder.
pub(crate) fn newest(path: &Path) -> Result<SystemTime> {
    let about = std::fs::metadata(path);
    let about = about.with_context(|| format!("{} cannot be read", path.display()))?;
    let mut latest = about.modified()?;
    if about.is_dir() {
        for entry in std::fs::read_dir(path)? {
            latest = latest.max(newest(&entry?.path())?);
        }
    }
    Ok(latest)
}
