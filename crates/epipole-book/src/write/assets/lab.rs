//! The Lab: a folder of the site with a page, its module, and those of its workers.

use super::files::{Assets, add_hashed};
use super::{scripts, wasm};
use crate::render::links::LAB_FOLDER;
use crate::tools::{Tools, read, target_folder};
use crate::write::compress;
use crate::write::policy::LAB_POLICY;
use anyhow::{Context, Result, ensure};
use std::path::Path;
use std::process::{Command, Stdio};

/// Builds the Lab in the folder of the site. Returns its number of files.
///
/// # Errors
/// A tool that is missing or fails, with the remedy.
pub fn make(project: &Path, site: &Path) -> Result<usize> {
    let tools = Tools::find(project)?;
    let page = wasm::build(&tools, "epipole-lab", "page")?;
    let vision = wasm::build(&tools, "epipole-lab", "vision-worker")?;
    let files = wasm::build(&tools, "epipole-lab", "files-worker")?;
    let mut assets = Assets::default();
    let sample = compress::gzip(&solved(&tools)?)?;
    let sample = add_hashed(&mut assets.files, "sample", "bin", sample);
    let (css, script) = scripts::add_lab(&tools, [&page, &vision, &files], &sample, &mut assets)?;
    let icon = read(&tools.project.join("web/theme/icon.svg"))?;
    let icon = add_hashed(&mut assets.files, "icon", "svg", icon);
    let html = String::from_utf8(read(&tools.project.join("web/lab/index.html"))?)?
        .replace("{{policy}}", LAB_POLICY)
        .replace("{{icon}}", &icon)
        .replace("{{css}}", &css)
        .replace("{{script}}", &script);
    assets
        .files
        .insert("index.html".to_owned(), html.into_bytes());
    compress::add(&mut assets.files)?;
    let folder = site.join(LAB_FOLDER);
    let next = site.join("lab.next");
    for old in [&next, &folder] {
        if old.exists() {
            std::fs::remove_dir_all(old)?;
        }
    }
    for (path, bytes) in &assets.files {
        let path = next.join(path);
        std::fs::create_dir_all(path.parent().unwrap_or(&next))?;
        std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
    }
    std::fs::rename(&next, &folder)
        .with_context(|| format!("cannot put the Lab at {}", folder.display()))?;
    Ok(assets.files.len())
}

/// Returns the results of the Lab's initial sample, precomputed so that readers need not wait.
fn solved(tools: &Tools) -> Result<Vec<u8>> {
    let target = target_folder(&tools.project);
    // Builds with the whole workspace, to reuse the core that this builder was compiled with.
    let built = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--quiet", "--locked", "--workspace"])
        .args(["--no-default-features", "--features"])
        .arg("epipole/default,epipole-lab/threads")
        .args(["--bin", "epipole-lab-sample", "--target-dir"])
        .arg(&target)
        .current_dir(&tools.project)
        .stdout(Stdio::null())
        .status()
        .context("cargo cannot be started")?;
    ensure!(built.success(), "the sample of the Lab cannot be compiled");
    let path = target.join("lab-sample.bin");
    let program = format!("debug/epipole-lab-sample{}", std::env::consts::EXE_SUFFIX);
    let computed = Command::new(target.join(program)).arg(&path).status();
    let is_there = computed.is_ok_and(|status| status.success());
    ensure!(is_there, "the sample of the Lab cannot be computed");
    read(&path)
}
