//! Files for code that readers run: the npm package of the core, and the script of its worker.

use super::bundle::bundle;
use super::files::Assets;
use super::wasm::Modules;
use crate::hash::fnv;
use crate::tools::{Tools, newest, read};
use anyhow::{Context, Result};
use std::path::Path;
use std::process::Command;

/// Paths from the root of the site; empty in a site without modules.
#[derive(Debug, Default)]
pub(super) struct Programs {
    /// Folder of the package.
    pub(super) package: String,
    /// Script imported before the reader's code.
    pub(super) sandbox: String,
}

/// Adds the package as published on npm, in a folder whose name contains a hash of its files.
pub(super) fn add(
    tools: &Tools,
    modules: &Modules,
    fast: bool,
    assets: &mut Assets,
) -> Result<Programs> {
    let out = tools.work.join("vision");
    let sources = [
        "web/vision/src",
        "web/vision/build.mjs",
        "web/package-lock.json",
    ];
    let sources = sources.map(|source| tools.project.join(source));
    // All modules are built together, this one last.
    let module = modules.parts.join("epipole_js_all_bg.wasm");
    let changed = sources.iter().chain([&module]).map(|path| newest(path));
    let changed = changed.collect::<Result<Vec<_>>>()?.into_iter().max();
    // The scripts of the package are written last.
    if newest(&out.join("index.js")).ok() < changed {
        let mut command = Command::new("node");
        command
            .arg("web/vision/build.mjs")
            .arg("--bindings")
            .arg(&modules.parts)
            .arg("--out")
            .arg(&out);
        tools.run(&mut command)?;
    }
    let mut files = Vec::new();
    for folder in ["", "parts"] {
        collect(&out, folder, &mut files)?;
    }
    files.sort();
    let all: Vec<u8> = files.iter().flat_map(|(_, bytes)| bytes.clone()).collect();
    let package = format!("assets/vision-{:016x}", fnv(&all));
    for (name, bytes) in files {
        assets.files.insert(format!("{package}/{name}"), bytes);
    }
    let made = bundle(tools, "web/run/sandbox.ts", &["--format=esm"], fast, assets)?;
    let sandbox = made.get("sandbox").context("esbuild made no sandbox.js")?;
    Ok(Programs {
        package,
        sandbox: sandbox.clone(),
    })
}

/// Collects scripts, modules and declarations of a folder of the package, with their paths in it.
fn collect(package: &Path, folder: &str, files: &mut Vec<(String, Vec<u8>)>) -> Result<()> {
    for entry in std::fs::read_dir(package.join(folder))? {
        let path = entry?.path();
        let name = path
            .strip_prefix(package)?
            .to_string_lossy()
            .replace('\\', "/");
        if name.ends_with(".js") || name.ends_with(".wasm") || name.ends_with(".d.ts") {
            files.push((name, read(&path)?));
        }
    }
    Ok(())
}
