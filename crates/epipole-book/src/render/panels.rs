//! Figures before any script runs: picture, controls and numbers in a declarative shadow root, so
//! that the layout does not shift when a figure starts. `web/prerender.mjs` renders them with the
//! elements' own code, for all figures of the book in one run.

use super::page::PanelRequest;
use crate::hash::fnv;
use crate::tools::{Tools, newest};
use anyhow::{Context, Result, bail};
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Placeholder of the elements' style sheet in a panel.
pub(crate) const STYLES: &str = "{{figure.css}}";

const SCRIPT: &str = "web/prerender.mjs";
/// Code of the elements, which determines the result together with the requests.
const SOURCES: [&str; 3] = [SCRIPT, "web/src", "web/package-lock.json"];

/// The last result of the script, with a hash of its inputs.
#[derive(Serialize, Deserialize)]
struct Panels {
    key: u64,
    panels: Vec<String>,
}

/// Whether the project can render panels.
pub(crate) fn are_made(project: &Path) -> bool {
    project.join(SCRIPT).is_file()
}

/// Renders the content of each figure's shadow root.
///
/// # Errors
/// If the script is missing, fails, or returns an invalid result.
pub(crate) fn make(project: &Path, requests: &[&PanelRequest]) -> Result<Vec<String>> {
    if requests.is_empty() || !are_made(project) {
        return Ok(Vec::new());
    }
    let tools = Tools::find(project)?;
    let input_json = serde_json::to_vec(requests)?;
    let sources = SOURCES.map(|source| newest(&project.join(source)));
    let sources = sources.into_iter().collect::<Result<Vec<_>>>()?;
    let key = fnv(&[&input_json[..], format!("{sources:?}").as_bytes()].concat());
    let cached = tools.work.join("panels.json");
    let cache = std::fs::read(&cached).ok();
    let cache: Option<Panels> = cache.and_then(|bytes| serde_json::from_slice(&bytes).ok());
    if let Some(Panels { panels, .. }) = cache.filter(|cache| cache.key == key) {
        return Ok(panels);
    }
    let panels = run_script(&tools, input_json, requests.len())?;
    let answer = Panels { key, panels };
    std::fs::write(&cached, serde_json::to_vec(&answer)?)
        .with_context(|| format!("cannot write {}", cached.display()))?;
    Ok(answer.panels)
}

/// Runs the script for `count` requests.
fn run_script(tools: &Tools, input_json: Vec<u8>, count: usize) -> Result<Vec<String>> {
    let mut child = Command::new("node")
        .arg(SCRIPT)
        .current_dir(&tools.project)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .context("node cannot be started: is it installed?")?;
    let input = child.stdin.take();
    let writer = std::thread::spawn(move || input.map(|mut input| input.write_all(&input_json)));
    let output = child.wait_with_output()?;
    let written = writer.join();
    if !output.status.success() {
        let stderr = String::from_utf8_lossy(&output.stderr);
        bail!("{SCRIPT} failed:\n{}", stderr.trim());
    }
    if let Ok(Some(Err(error))) = written {
        return Err(error).with_context(|| format!("{SCRIPT} did not read what it was asked"));
    }
    let panels: Vec<String> = serde_json::from_slice(&output.stdout)
        .with_context(|| format!("{SCRIPT} answered something else than a list of texts"))?;
    if panels.len() != count {
        bail!("{SCRIPT} answered {} of {count} figures", panels.len());
    }
    Ok(panels)
}
