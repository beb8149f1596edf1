//! The figures as WebAssembly, built by cargo and wasm-bindgen (as a library).
//!
//! Two modules of the same crate: the figures, loaded by every page with a figure, and their long
//! computations, loaded by a worker on demand. The npm package of the core has one module per part.

use super::function_order;
use crate::tools::{Tools, newest, read, target_folder};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use wasm_bindgen_cli_support::Bindgen;

/// A module and the script that loads it.
pub(crate) struct Module {
    /// The module as downloaded.
    pub(super) wasm: Vec<u8>,
    /// The generated script.
    pub(super) glue: PathBuf,
}

/// WebAssembly modules of the elements, and of the npm package of the core.
pub(crate) struct Modules {
    /// Module for the page; the elements import its script as `epipole-web`.
    pub(super) figures: Module,
    /// Module for workers; they import its script as `epipole-jobs`.
    pub(super) jobs: Module,
    /// Folder of the modules of the package and their scripts.
    pub(super) parts: PathBuf,
}

/// Features of `epipole-web`: the figures for the page, and their computations for its worker.
const FIGURES: [&str; 2] = ["figures", "jobs"];
/// Features of `epipole-js`: the parts of the npm package of the core, one module each.
const PARTS: [&str; 4] = ["homography", "geometry", "images", "all"];

/// Sources of all modules, below the project.
const SOURCES: [&str; 5] = [
    ".cargo",
    "Cargo.lock",
    "Cargo.toml",
    "crates/epipole",
    "crates/epipole-book/src/write/assets",
];
/// Further crates of the figures' modules.
const OF_FIGURES: [&str; 4] = [
    "crates/epipole-canvas",
    "crates/epipole-scenes",
    "crates/epipole-web",
    "crates/epipole-widgets",
];
/// Further crates of the package's modules.
const OF_PARTS: [&str; 2] = ["crates/epipole-js", "crates/epipole-schema"];

/// Builds the modules of the book.
pub(super) fn make(tools: &Tools) -> Result<Modules> {
    let [page, worker] = FIGURES;
    // The page's profile has a separate target folder, so cargo builds both concurrently.
    let (figures, parts) = std::thread::scope(|scope| {
        let figures = scope.spawn(|| make_all(tools, "epipole-web", &[page], &OF_FIGURES));
        let parts = make_all(tools, "epipole-web", &[worker], &OF_FIGURES)
            .and_then(|()| make_parts(&tools.project));
        (figures.join(), parts)
    });
    figures.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    Ok(Modules {
        figures: load(tools, "epipole-web", page)?,
        jobs: load(tools, "epipole-web", worker)?,
        parts: parts?,
    })
}

/// Builds the modules of the npm package of the core. Returns their folder.
///
/// # Errors
/// A tool that is missing or fails, with the remedy.
pub fn make_parts(project: &Path) -> Result<PathBuf> {
    let tools = Tools::find(project)?;
    make_all(&tools, "epipole-js", &PARTS, &OF_PARTS)?;
    Ok(bindings(&tools))
}

/// Builds the modules of a package, unless all are newer than their sources: cargo needs seconds
/// for that check, and links a module again after another one of the same package.
fn make_all(tools: &Tools, package: &str, features: &[&str], crates: &[&str]) -> Result<()> {
    let made = features
        .iter()
        .map(|feature| std::fs::metadata(path(tools, package, feature))?.modified());
    let oldest = made.collect::<std::io::Result<Vec<_>>>().ok();
    let oldest = oldest.and_then(|times| times.into_iter().min());
    let sources = SOURCES.iter().chain(crates);
    let newest = sources
        .map(|source| newest(&tools.project.join(source)))
        .collect::<Result<Vec<_>>>()?;
    if oldest < newest.into_iter().max() {
        for feature in features {
            build(tools, package, feature)?;
        }
    }
    Ok(())
}

/// Returns the path of a finished module.
fn path(tools: &Tools, package: &str, feature: &str) -> PathBuf {
    let name = name(package, feature);
    bindings(tools).join(format!("{name}_bg.wasm"))
}

/// Returns the name of a module and its script.
fn name(package: &str, feature: &str) -> String {
    match package {
        "epipole-web" => format!("epipole_{feature}"),
        other => format!("{other}_{feature}").replace('-', "_"),
    }
}

/// Reads a finished module.
fn load(tools: &Tools, package: &str, feature: &str) -> Result<Module> {
    let glue = bindings(tools).join(format!("{}.js", name(package, feature)));
    Ok(Module {
        wasm: read(&path(tools, package, feature))?,
        glue,
    })
}

/// Returns the folder of the finished modules and their scripts.
fn bindings(tools: &Tools) -> PathBuf {
    tools.work.join("bindgen")
}

/// Returns compiler flags for every crate, as a setting of cargo. Cargo joins them to those of
/// `.cargo/config.toml`.
///
/// They remove the paths of this machine from the modules, which panics would otherwise contain, so
/// that the same source gives the same bytes on every machine.
fn for_every_crate(project: &Path, more: &[&str]) -> String {
    let home = std::env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    let packages = home.map(|home| (home.join("registry").join("src"), "registry"));
    let flags: Vec<String> = packages
        .into_iter()
        .chain([(project.to_path_buf(), "epipole")])
        .map(|(path, name)| format!("--remap-path-prefix={}={name}", path.display()))
        .chain(more.iter().map(|&flag| flag.to_owned()))
        .map(|flag| format!("{flag:?}"))
        .collect();
    format!(
        "target.wasm32-unknown-unknown.rustflags=[{}]",
        flags.join(", ")
    )
}

/// Returns the cargo profile of a module: small for the page's drawing code, fast for the worker's
/// computations.
fn profile(package: &str, feature: &str) -> &'static str {
    match package == "epipole-js" || feature == "jobs" || feature.ends_with("-worker") {
        true => "web-worker",
        false => "web",
    }
}

/// Compilation settings of a module beyond its profile.
#[derive(Default)]
struct Way {
    /// Arguments for `cargo rustc`.
    of_cargo: &'static [&'static str],
    /// Compiler arguments for every crate.
    of_every_crate: &'static [&'static str],
    /// Compiler arguments for the crate that is linked.
    of_linking: &'static [&'static str],
}

/// Returns the compilation settings for the module of a feature.
///
/// Cargo skips link-time optimization for a library that is both an rlib and a cdylib, so the
/// figures and their computations are built as a cdylib only. Link-time optimization then inlines
/// nalgebra's small functions, compiled for size, into the loops that call them. Computations are
/// compiled for speed. Limits on inlining and unrolling reduce the size at hardly any cost in
/// speed; they are set in every crate, since most of both happens before linking.
fn way(package: &str, feature: &str) -> Way {
    const AS_ONE: &[&str] = &["--crate-type", "cdylib"];
    match (package, feature) {
        ("epipole-web", "jobs") | ("epipole-js", _) => Way {
            of_cargo: AS_ONE,
            of_every_crate: &[
                "-C",
                "llvm-args=-inline-threshold=25",
                "-C",
                "llvm-args=-unroll-threshold=120",
            ],
            of_linking: &[
                "-C",
                "llvm-args=-unroll-runtime=false",
                "-C",
                "llvm-args=-force-vector-interleave=1",
            ],
        },
        ("epipole-web", "figures") => Way {
            of_cargo: AS_ONE,
            ..Way::default()
        },
        _ => Way::default(),
    }
}

/// Builds one module: a package with one of its features.
pub(super) fn build(tools: &Tools, package: &str, feature: &str) -> Result<Module> {
    let target = target_folder(&tools.project);
    let profile = profile(package, feature);
    let way = way(package, feature);
    let status = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["rustc", "--package", package, "--lib"])
        .args(way.of_cargo)
        .args(["--no-default-features", "--features", feature])
        .args([
            "--target",
            "wasm32-unknown-unknown",
            "--profile",
            profile,
            "--quiet",
        ])
        .arg("--config")
        .arg(for_every_crate(&tools.project, way.of_every_crate))
        .arg("--")
        .args(way.of_linking)
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
        "wasm32-unknown-unknown/{profile}/{}.wasm",
        package.replace('-', "_")
    );
    let built = target.join(file);
    Bindgen::new()
        .input_path(&built)
        .out_name(&name(package, feature))
        .web(true)?
        .omit_default_module_path(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(bindings(tools))
        .context("wasm-bindgen failed")?;
    let path = path(tools, package, feature);
    let wasm = function_order::ordered(&read(&path)?)?;
    std::fs::write(&path, &wasm).with_context(|| format!("cannot write {}", path.display()))?;
    load(tools, package, feature)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_this_machine_are_named_anew() {
        let setting = for_every_crate(Path::new("/a place/epipole"), &["-C"]);
        assert!(setting.starts_with("target.wasm32-unknown-unknown.rustflags=["));
        assert!(setting.contains("\"--remap-path-prefix=/a place/epipole=epipole\""));
        assert!(setting.contains("registry"));
        assert!(setting.ends_with(", \"-C\"]"));
    }
}
