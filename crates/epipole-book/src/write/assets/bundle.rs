//! Bundling by esbuild. Hashes are appended to the names of entries.

use super::files::Assets;
use crate::tools::{Tools, read};
use anyhow::Result;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

#[derive(Deserialize)]
struct Report {
    outputs: BTreeMap<PathBuf, Output>,
}

#[derive(Deserialize)]
struct Output {
    #[serde(rename = "entryPoint")]
    entry: Option<PathBuf>,
}

/// Bundles one entry into `assets`. Returns the path by the name of the entry.
pub(super) fn bundle(
    tools: &Tools,
    entry: &str,
    flags: &[&str],
    fast: bool,
    assets: &mut Assets,
) -> Result<BTreeMap<String, String>> {
    let stem = Path::new(entry)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let folder = tools.work.join("bundle").join(&stem);
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    let report = tools.work.join(format!("{stem}.json"));
    let mut command = Command::new(tools.modules.join(".bin/esbuild"));
    command
        .arg(entry)
        .args([
            "--bundle",
            "--target=es2022,chrome107,firefox104,safari16",
            "--log-level=warning",
            // Imports for side effects must not be dropped.
            "--log-override:ignored-bare-import=error",
        ])
        .args([
            "--entry-names=[name]-[hash]",
            "--chunk-names=[name]-[hash]",
            "--legal-comments=none",
        ])
        .arg(format!("--outdir={}", folder.display()))
        .arg(format!("--metafile={}", report.display()))
        .args(flags);
    if !fast {
        command.arg("--minify");
    }
    tools.run(&mut command)?;
    let report: Report = serde_json::from_slice(&read(&report)?)?;
    let mut entries = BTreeMap::new();
    for (path, output) in report.outputs {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let to = format!("assets/{name}");
        assets
            .files
            .insert(to.clone(), read(&tools.project.join(&path))?);
        if output
            .entry
            .is_some_and(|from| from.file_stem() == Path::new(entry).file_stem())
        {
            entries.insert(stem.clone(), to);
        }
    }
    Ok(entries)
}
