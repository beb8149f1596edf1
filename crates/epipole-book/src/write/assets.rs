//! Files of the site besides the pages: styles, fonts, scripts and WebAssembly. Every name contains
//! a hash of the content; only names in `embed/`, for other sites, are stable.

mod bundle;
mod embed;
mod files;
mod fonts;
mod function_order;
mod lab;
mod letters;
mod offline;
mod programs;
mod scripts;
mod wasm;

pub use files::{AppIcon, Assets, add_hashed};
pub use lab::make as make_lab;
pub use letters::{Letters, used_letters};
pub use offline::add_offline;
pub(crate) use wasm::Modules;
pub use wasm::make_parts as make_vision;

use crate::tools::{Tools, read};
use anyhow::Result;
use std::path::Path;

/// Builds the figures for the browser, if the project has figures. This is the slowest step.
///
/// # Errors
/// A tool that is missing or fails, with the remedy.
pub(crate) fn modules(project: &Path) -> Result<Option<Modules>> {
    let manifest = project.join("crates/epipole-web/Cargo.toml");
    if !manifest.is_file() {
        return Ok(None);
    }
    wasm::make(&Tools::find(project)?).map(Some)
}

/// Returns the math font, subset to the letters of formulas.
///
/// # Errors
/// A tool that is missing or fails, with the remedy.
pub(crate) fn math_font(project: &Path, letters: &Letters) -> Result<Vec<u8>> {
    fonts::math(&Tools::find(project)?, letters)
}

/// Makes all other assets, and adds the figures.
///
/// # Errors
/// A tool that is missing or fails, with the remedy.
pub(crate) fn make(
    project: &Path,
    live: bool,
    letters: &Letters,
    modules: Option<&Modules>,
) -> Result<Assets> {
    let tools = Tools::find(project)?;
    let mut assets = Assets::default();
    fonts::add(&tools, letters, &mut assets)?;
    let look = scripts::add_look(&tools, live, &mut assets)?;
    let runs = modules.map(|modules| programs::add(&tools, modules, live, &mut assets));
    let runs = runs.transpose()?.unwrap_or_default();
    scripts::add_pages(&tools, &look, &runs, live, &mut assets)?;
    if let Some(modules) = modules {
        scripts::add_elements(&tools, modules, &look, live, &mut assets)?;
        scripts::add_deck(&tools, live, &mut assets)?;
    }
    let icon = read(&tools.project.join("web/theme/icon.svg"))?;
    assets.icon = add_hashed(&mut assets.files, "icon", "svg", icon);
    assets.app_icons.push(AppIcon {
        path: assets.icon.clone(),
        sizes: "any",
        kind: "image/svg+xml",
        purpose: "any",
    });
    for (name, sizes, purpose) in [
        ("icon-192", "192x192", "any"),
        ("icon-512", "512x512", "maskable"),
    ] {
        let png = read(&tools.project.join(format!("web/theme/{name}.png")))?;
        assets.app_icons.push(AppIcon {
            path: add_hashed(&mut assets.files, name, "png", png),
            sizes,
            kind: "image/png",
            purpose,
        });
    }
    let licenses = [
        (
            "OFL-STIX-Two.txt",
            tools.modules.join("@fontsource/stix-two-math/LICENSE"),
        ),
        ("THIRD-PARTY.txt", tools.project.join("web/THIRD-PARTY.txt")),
    ];
    for (name, source) in licenses {
        assets
            .files
            .insert(format!("licenses/{name}"), read(&source)?);
    }
    Ok(assets)
}
