//! The figures as WebAssembly: cargo, wasm-bindgen (as a library) and Binaryen's wasm-opt.
//!
//! Two modules of the same crate: the figures, which every page with a figure loads, and their long
//! computations, which a worker loads when a figure asks for one.

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

/// A module and the script that loads it.
pub(crate) struct Module {
    /// The optimized module.
    pub(super) wasm: Vec<u8>,
    /// The generated script.
    pub(super) glue: PathBuf,
}

/// What the elements load.
pub(crate) struct Modules {
    /// What a page calls; the elements import its script as `epipole-web`.
    pub(super) figures: Module,
    /// What a worker calls; it imports the script as `epipole-jobs`.
    pub(super) jobs: Module,
}

/// Builds one module: a package with one of its features. `fast` leaves out wasm-opt.
pub(super) fn one(tools: &Tools, package: &str, feature: &str, fast: bool) -> Result<Module> {
    optimize(tools, build(tools, package, feature)?, fast)
}

/// Builds the modules of the book. `fast` leaves out wasm-opt.
pub(super) fn make(tools: &Tools, fast: bool) -> Result<Modules> {
    let figures = build(tools, "epipole-web", "figures")?;
    std::thread::scope(|scope| {
        // Binaryen takes as long as cargo, so one works while the other does.
        let figures = scope.spawn(|| optimize(tools, figures, fast));
        let jobs = optimize(tools, build(tools, "epipole-web", "jobs")?, fast)?;
        let figures = figures.join();
        Ok(Modules {
            figures: figures.map_err(|_| anyhow::anyhow!("wasm-opt could not be run"))??,
            jobs,
        })
    })
}

/// A module as wasm-bindgen leaves it.
struct Bound {
    /// Names a version of it.
    key: u64,
    wasm: PathBuf,
    glue: PathBuf,
}

/// Builds a package with one of its features.
fn build(tools: &Tools, package: &str, feature: &str) -> Result<Bound> {
    let target = super::target_folder(&tools.project);
    let status = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--package", package, "--lib"])
        .args(["--no-default-features", "--features", feature])
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
        "{package} does not build for the browser (is the target there? \
         `rustup target add wasm32-unknown-unknown`)"
    );
    let file = format!(
        "wasm32-unknown-unknown/web/{}.wasm",
        package.replace('-', "_")
    );
    let built = target.join(file);
    let raw = read(&built)?;
    let key = fnv(&raw);
    let folder = tools.work.join("bindgen");
    let name = match package {
        "epipole-web" => format!("epipole_{feature}"),
        other => format!("{}_{feature}", other.replace('-', "_")),
    };
    Bindgen::new()
        .input_path(&built)
        .out_name(&name)
        .web(true)?
        .omit_default_module_path(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(&folder)
        .context("wasm-bindgen failed")?;
    Ok(Bound {
        key,
        wasm: folder.join(format!("{name}_bg.wasm")),
        glue: folder.join(format!("{name}.js")),
    })
}

/// Makes a module smaller and faster, once for each version of it.
fn optimize(tools: &Tools, bound: Bound, fast: bool) -> Result<Module> {
    let Bound { key, wasm, glue } = bound;
    if fast {
        let wasm = read(&wasm)?;
        return Ok(Module { wasm, glue });
    }
    let optimized = tools.work.join(format!("epipole-{key:016x}.wasm"));
    if !optimized.is_file() {
        let part = optimized.with_extension("part");
        tools.run(
            Command::new("node")
                .arg(tools.modules.join("binaryen/bin/wasm-opt"))
                .arg("-O2")
                .args(FEATURES)
                .arg(&wasm)
                .arg("-o")
                .arg(&part),
        )?;
        std::fs::rename(&part, &optimized)?;
    }
    let optimized = read(&optimized)?;
    // For `web/build.mjs`, under the name of its script.
    std::fs::write(glue.with_extension("wasm"), &optimized)?;
    Ok(Module {
        wasm: optimized,
        glue,
    })
}
