//! Fonts, subset to the letters of the book by HarfBuzz (npm `subset-font`).

use super::files::{Assets, add_hashed};
use super::letters::Letters;
use crate::hash::fnv;
use crate::tools::{Tools, read};
use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;

/// Files of the family STIX Two (SIL Open Font License), and their names in the style sheet.
const FONTS: &[(&str, &str)] = &[
    (
        "text-regular",
        "@fontsource/stix-two-text/files/stix-two-text-latin-400-normal.woff2",
    ),
    (
        "text-italic",
        "@fontsource/stix-two-text/files/stix-two-text-latin-400-italic.woff2",
    ),
    (
        "text-bold",
        "@fontsource/stix-two-text/files/stix-two-text-latin-600-normal.woff2",
    ),
    MATH,
];
const MATH: (&str, &str) = (
    "math",
    "@fontsource/stix-two-math/files/stix-two-math-latin-400-normal.woff2",
);

/// Subsets the fonts and adds them, with hashed names, to `assets`. The style sheet, bundled later,
/// finds them by [`font_url`].
pub(super) fn add(tools: &Tools, letters: &Letters, assets: &mut Assets) -> Result<()> {
    for (name, source) in FONTS {
        let wanted = if *name == "math" {
            &letters.math
        } else {
            &letters.text
        };
        let bytes = subset(tools, name, source, wanted)?;
        let path = add_hashed(
            &mut assets.files,
            &format!("stix-two-{name}"),
            "woff2",
            bytes,
        );
        match *name {
            "text-regular" => assets.preload.push(path),
            "text-italic" => assets.italic = Some(path),
            _ => {}
        }
    }
    Ok(())
}

/// Subsets only the math font.
pub(super) fn math(tools: &Tools, letters: &Letters) -> Result<Vec<u8>> {
    let (name, source) = MATH;
    subset(tools, name, source, &letters.math)
}

/// Returns the hashed file name of a font.
pub(super) fn font_url(assets: &Assets, name: &str) -> Result<String> {
    let start = format!("assets/stix-two-{name}-");
    let path = assets.files.keys().find(|path| path.starts_with(&start));
    let path = path.with_context(|| format!("the style sheet asks for an unknown font {name}"))?;
    Ok(path.trim_start_matches("assets/").to_owned())
}

fn subset(tools: &Tools, name: &str, source: &str, letters: &BTreeSet<char>) -> Result<Vec<u8>> {
    let letters: String = letters.iter().collect();
    let source = tools.modules.join(source);
    let key = fnv(&[read(&source)?.as_slice(), letters.as_bytes()].concat());
    let cached: PathBuf = tools.work.join(format!("font-{name}-{key:016x}.woff2"));
    if !cached.is_file() {
        let list = tools.work.join(format!("font-{name}.txt"));
        std::fs::write(&list, &letters)?;
        tools.run(
            Command::new("node")
                .arg(tools.project.join("web/book/subset-font.mjs"))
                .args([&source, &list, &cached]),
        )?;
    }
    read(&cached)
}
