//! Scripts and styles of pages, figures and the Lab.

use super::bundle::bundle;
use super::files::{Assets, add_hashed};
use super::programs::Programs;
use super::wasm::{Module, Modules};
use super::{embed, fonts};
use crate::tools::Tools;
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// Prefix of fonts in the style sheet, before their hashed names are known.
const FONT: &str = "stix-two:";

/// Name of the figures' style sheet in scripts.
const LOOK: &str = "epipole-look";

/// Adds the style sheet and the scripts of every page. `look` is the figures' style sheet.
pub(super) fn add_pages(
    tools: &Tools,
    look: &Path,
    programs: &Programs,
    fast: bool,
    assets: &mut Assets,
) -> Result<()> {
    // The style sheet refers to fonts as `url("stix-two:math")`, which esbuild must not change.
    let mut css = bundle(
        tools,
        "web/theme/book.css",
        &["--external:stix-two:*"],
        fast,
        assets,
    )?;
    let path = css.remove("book").context("esbuild made no style sheet")?;
    let bytes = assets.files.remove(&path).unwrap_or_default();
    let mut text = String::from_utf8(bytes)?;
    while let Some(start) = text.find(FONT) {
        let name: String = text[start + FONT.len()..]
            .chars()
            .take_while(|c| c.is_ascii_alphanumeric() || *c == '-')
            .collect();
        let url = fonts::font_url(assets, &name)?;
        text.replace_range(start..start + FONT.len() + name.len(), &url);
    }
    assets.css = add_hashed(&mut assets.files, "book", "css", text.into_bytes());

    let look = format!("--alias:{LOOK}={}", look.display());
    let before = ["--format=iife", &look];
    let head = bundle(tools, "web/book/head.ts", &before, fast, assets)?;
    assets.head = head
        .get("head")
        .cloned()
        .context("esbuild made no head.js")?;
    let vision = define("EPIPOLE_VISION", &programs.package);
    let sandbox = define("EPIPOLE_SANDBOX", &programs.sandbox);
    let module = ["--format=esm", "--splitting", &vision, &sandbox];
    let page = bundle(tools, "web/book/page.ts", &module, fast, assets)?;
    assets.page = page
        .get("page")
        .cloned()
        .context("esbuild made no page.js")?;
    Ok(())
}

/// Adds script and style sheet of the slides, in their folder, as no page needs them.
pub(super) fn add_deck(tools: &Tools, fast: bool, assets: &mut Assets) -> Result<()> {
    let mut made = Assets::default();
    let mut add = |entry: &str| -> Result<String> {
        let names = bundle(tools, entry, &["--format=esm"], fast, &mut made)?;
        let path = names.get("deck").context("esbuild made no deck")?;
        Ok(in_slides(path))
    };
    assets.deck = add("web/slides/deck.ts")?;
    assets.deck_css = add("web/slides/deck.css")?;
    let files = made.files.into_iter();
    (assets.files).extend(files.map(|(path, bytes)| (in_slides(&path), bytes)));
    Ok(())
}

fn in_slides(path: &str) -> String {
    path.replacen("assets/", "slides/", 1)
}

/// Adds the custom elements: `web/src/worker.ts` first, as the elements refer to it, then
/// `web/src/index.ts`. The sources locate the other files by the constants `EPIPOLE_WASM`,
/// `EPIPOLE_JOBS_WASM` and `EPIPOLE_WORKER`, and import the generated bindings as `epipole-web` and
/// `epipole-jobs`, and the file `look` as `epipole-look`.
pub(super) fn add_elements(
    tools: &Tools,
    modules: &Modules,
    look: &Path,
    fast: bool,
    assets: &mut Assets,
) -> Result<()> {
    let Modules { figures, jobs, .. } = modules;
    let mut add =
        |name: &str, wasm: &[u8]| add_hashed(&mut assets.files, name, "wasm", wasm.to_vec());
    let figures_wasm = add("epipole-figures", &figures.wasm);
    let jobs_wasm = add("epipole-jobs", &jobs.wasm);
    let mut flags = vec![
        "--format=esm".to_owned(),
        format!("--alias:epipole-web={}", figures.glue.display()),
        format!("--alias:epipole-jobs={}", jobs.glue.display()),
        format!("--alias:{LOOK}={}", look.display()),
        define("EPIPOLE_WASM", &figures_wasm),
        define("EPIPOLE_JOBS_WASM", &jobs_wasm),
    ];
    let source = "web/src/worker.ts";
    let mut worker = None;
    if tools.project.join(source).is_file() {
        let made = bundle(tools, source, &borrowed(&flags), fast, assets)?;
        let made = made.get("worker").context("esbuild made no worker.js")?;
        flags.push(define("EPIPOLE_WORKER", made));
        worker = Some(made.clone());
    }
    let made = bundle(tools, "web/src/index.ts", &borrowed(&flags), fast, assets)?;
    let elements = made
        .get("index")
        .context("esbuild made no script for the elements")?;
    let parts = embed::Parts {
        elements,
        worker: worker.as_deref(),
        figures: &figures_wasm,
        jobs: &jobs_wasm,
    };
    embed::add(tools, &parts, assets)?;
    assets.elements = Some(elements.clone());
    let frame = bundle(tools, "web/book/frame.ts", &["--format=esm"], fast, assets)?;
    assets.frame = frame.get("frame").cloned();
    let styles = bundle(tools, "web/theme/frame.css", &[], fast, assets)?;
    assets.frame_css = styles.get("frame").cloned().unwrap_or_default();
    Ok(())
}

/// Adds style sheet and script of the Lab's page, and its workers.
pub(super) fn add_lab(
    tools: &Tools,
    [page, vision, files]: [&Module; 3],
    sample: &str,
    assets: &mut Assets,
) -> Result<(String, String)> {
    let mut add =
        |name: &str, wasm: &[u8]| add_hashed(&mut assets.files, name, "wasm", wasm.to_vec());
    let page_wasm = add("lab-page", &page.wasm);
    let vision_wasm = add("lab-vision", &vision.wasm);
    let files_wasm = add("lab-files", &files.wasm);
    let mut flags = vec![
        "--format=esm".to_owned(),
        format!("--alias:epipole-lab-page={}", page.glue.display()),
        format!("--alias:epipole-lab-vision={}", vision.glue.display()),
        format!("--alias:epipole-lab-files={}", files.glue.display()),
        define("LAB_PAGE_WASM", &page_wasm),
        define("LAB_VISION_WASM", &vision_wasm),
        define("LAB_FILES_WASM", &files_wasm),
        define("LAB_SAMPLE", sample),
    ];
    let made = bundle(tools, "web/lab/worker.ts", &borrowed(&flags), false, assets)?;
    let worker = made.get("worker").context("esbuild made no worker.js")?;
    flags.push(define("LAB_WORKER", worker));
    let made = bundle(tools, "web/lab/lab.ts", &borrowed(&flags), false, assets)?;
    let script = made.get("lab").cloned().context("esbuild made no lab.js")?;
    let made = bundle(tools, "web/lab/lab.css", &[], false, assets)?;
    let css = made
        .get("lab")
        .cloned()
        .context("esbuild made no lab.css")?;
    Ok((css, script))
}

/// Bundles the style sheet of the figures: scripts contain it, and a shadow root refers to it until
/// one has run. Returns the bundled file.
pub(super) fn add_look(tools: &Tools, fast: bool, assets: &mut Assets) -> Result<PathBuf> {
    let made = bundle(tools, "web/src/figure.css", &[], fast, assets)?;
    let path = made.get("figure").context("esbuild made no figure.css")?;
    assets.figure_css = Some(path.clone());
    let name = path.trim_start_matches("assets/");
    Ok(tools.work.join("bundle/figure").join(name))
}

/// Defines a constant of scripts: a path relative to their folder.
fn define(name: &str, path: &str) -> String {
    format!("--define:{name}={:?}", path.trim_start_matches("assets/"))
}

fn borrowed(flags: &[String]) -> Vec<&str> {
    flags.iter().map(String::as_str).collect()
}
