//! The figures as WebAssembly: cargo, wasm-bindgen (as a library) and Binaryen's wasm-opt.

use super::{Tools, fnv, read};
use anyhow::{Context, Result};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use wasm_bindgen_cli_support::Bindgen;

/// What wasm-opt may use. Named one by one: all engines of the last years have these.
const FEATURES: &[&str] = &[
    "--enable-simd",
    "--enable-bulk-memory",
    "--enable-bulk-memory-opt",
    "--enable-nontrapping-float-to-int",
    "--enable-sign-ext",
    "--enable-mutable-globals",
    "--enable-reference-types",
    "--enable-multivalue",
];

/// The module and the script that loads it.
pub(super) struct Module {
    /// The optimized module.
    pub(super) wasm: Vec<u8>,
    /// The generated script, which the elements import as `epipole-web`.
    pub(super) glue: PathBuf,
}

/// Builds the module. `fast` leaves out wasm-opt.
pub(super) fn make(tools: &Tools, fast: bool) -> Result<Module> {
    let target = super::target_folder(&tools.project);
    let status = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--package", "epipole-web", "--lib"])
        .args([
            "--target",
            "wasm32-unknown-unknown",
            "--profile",
            "web",
            "--quiet",
        ])
        .current_dir(&tools.project)
        .stdout(Stdio::null())
        .status()
        .context("cargo cannot be started")?;
    anyhow::ensure!(
        status.success(),
        "the figures do not build for the browser (is the target there? \
         `rustup target add wasm32-unknown-unknown`)"
    );
    let built = target.join("wasm32-unknown-unknown/web/epipole_web.wasm");
    let raw = read(&built)?;
    let key = fnv(&raw);
    let folder = tools.work.join("bindgen");
    Bindgen::new()
        .input_path(&built)
        .web(true)?
        .omit_default_module_path(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(&folder)
        .context("wasm-bindgen failed")?;
    let bound = folder.join("epipole_web_bg.wasm");
    let glue = folder.join("epipole_web.js");
    if fast {
        return Ok(Module {
            wasm: read(&bound)?,
            glue,
        });
    }
    let optimized = tools.work.join(format!("epipole-{key:016x}.wasm"));
    if !optimized.is_file() {
        let part = optimized.with_extension("part");
        tools.run(
            Command::new("node")
                .arg(tools.modules.join("binaryen/bin/wasm-opt"))
                .arg("-O3")
                .args(FEATURES)
                .arg(&bound)
                .arg("-o")
                .arg(&part),
        )?;
        std::fs::rename(&part, &optimized)?;
    }
    Ok(Module {
        wasm: read(&optimized)?,
        glue,
    })
}
