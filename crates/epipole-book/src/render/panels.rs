//! The live figures before any script runs: picture, controls and numbers in a declarative shadow
//! root, so that nothing moves when a figure starts. They are written by the elements' own code, in
//! `web/prerender.mjs`; all figures of the book are rendered in one run.

use super::page::PanelRequest;
use crate::tools::Tools;
use anyhow::{Context, Result, bail};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Placeholder of the elements' style sheet in a panel.
pub(crate) const STYLES: &str = "{{figure.css}}";

const SCRIPT: &str = "web/prerender.mjs";

/// Whether the project can make panels.
pub(crate) fn are_made(project: &Path) -> bool {
    project.join(SCRIPT).is_file()
}

/// The inside of the shadow root of each figure.
///
/// # Errors
/// If the script is missing, fails, or answers something else.
pub(crate) fn make(project: &Path, requests: &[&PanelRequest]) -> Result<Vec<String>> {
    if requests.is_empty() || !are_made(project) {
        return Ok(Vec::new());
    }
    let tools = Tools::find(project)?;
    let mut child = Command::new("node")
        .arg(SCRIPT)
        .current_dir(&tools.project)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .context("node cannot be started: is it installed?")?;
    let asked = serde_json::to_vec(requests)?;
    let input = child.stdin.take();
    let writer = std::thread::spawn(move || input.map(|mut input| input.write_all(&asked)));
    let output = child.wait_with_output()?;
    let written = writer.join();
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        bail!("{SCRIPT} failed:\n{}", said.trim());
    }
    if let Ok(Some(Err(error))) = written {
        return Err(error).with_context(|| format!("{SCRIPT} did not read what it was asked"));
    }
    let panels: Vec<String> = serde_json::from_slice(&output.stdout)
        .with_context(|| format!("{SCRIPT} answered something else than a list of texts"))?;
    if panels.len() != requests.len() {
        bail!(
            "{SCRIPT} answered {} of {} figures",
            panels.len(),
            requests.len()
        );
    }
    Ok(panels)
}
