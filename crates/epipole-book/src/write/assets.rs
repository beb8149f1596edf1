//! What the browser downloads beside the pages: styles, fonts, scripts and WebAssembly. Every name
//! carries a hash of the content; what is in `embed/` has stable names, for other sites.

mod embed;
mod fonts;
mod lab;
mod likeness;
mod scripts;
mod wasm;

pub(crate) use lab::FOLDER as LAB_FOLDER;
pub use lab::make as make_lab;
pub(crate) use wasm::Modules;

use crate::render::page::Page;
use crate::site::Options;
use anyhow::{Context, Result, bail};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Paths from the root of the site, and the files themselves.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Assets {
    /// The style sheet.
    pub css: String,
    /// The script that sets the color theme before anything is drawn.
    pub head: String,
    /// The script of every page.
    pub page: String,
    /// The script of the figures, if the project has figures.
    pub elements: Option<String>,
    /// The style sheet inside the figures.
    pub figure_css: Option<String>,
    /// The script of the pages with one figure, for frames.
    pub frame: Option<String>,
    /// Their style sheet.
    pub frame_css: String,
    /// Fonts that every page needs at once.
    pub preload: Vec<String>,
    /// The italic font.
    pub italic: Option<String>,
    /// The icon.
    pub icon: String,
    /// Path → content.
    #[serde(skip)]
    pub files: BTreeMap<String, Vec<u8>>,
}

/// The letters that the fonts must have.
#[derive(Debug, Clone, Default)]
pub struct Letters {
    /// In formulas.
    pub math: BTreeSet<char>,
    /// In everything else.
    pub text: BTreeSet<char>,
}

/// The letters of all pages.
pub fn used_letters(pages: &[Page]) -> Letters {
    let mut letters = Letters::default();
    // What the theme, the scripts and the readers' own numbers need.
    letters.text.extend(' '..='~');
    letters
        .text
        .extend("–—‘’“”…·×−±°√≤≥≈→←↑↓✓✗“”«»§ \u{a0}\u{202f}".chars());
    letters.math.extend(' '..='~');
    for page in pages {
        let mut rest = page.html.as_str();
        while let Some(start) = rest.find("<math") {
            let end = rest[start..]
                .find("</math>")
                .map_or(rest.len(), |end| start + end);
            letters.text.extend(rest[..start].chars());
            let formula = &rest[start..end];
            letters.math.extend(formula.chars());
            // Browsers draw the root from the font's sign, which the formula does not contain.
            if formula.contains("<msqrt") || formula.contains("<mroot") {
                letters.math.insert('√');
            }
            rest = &rest[end..];
        }
        letters.text.extend(rest.chars());
    }
    let italics: Vec<char> = letters
        .math
        .iter()
        .copied()
        .filter_map(math_italic)
        .collect();
    letters.math.extend(italics);
    for set in [&mut letters.text, &mut letters.math] {
        set.retain(|letter| !letter.is_control());
    }
    letters
}

/// The letter that a browser draws for a variable: a lone letter in `<mi>` is set in italics, and
/// the italics of mathematics are letters of their own.
fn math_italic(letter: char) -> Option<char> {
    let shifted = |first: char, to: u32| char::from_u32(to + letter as u32 - first as u32);
    match letter {
        // U+1D455 was never assigned: its letter is Planck's constant.
        'h' => Some('\u{210E}'),
        'A'..='Z' => shifted('A', 0x1D434),
        'a'..='z' => shifted('a', 0x1D44E),
        'Α'..='Ω' => shifted('Α', 0x1D6E2),
        'α'..='ω' => shifted('α', 0x1D6FC),
        '∂' => Some('\u{1D715}'),
        'ϵ' => Some('\u{1D716}'),
        'ϑ' => Some('\u{1D717}'),
        'ϕ' => Some('\u{1D719}'),
        'ϱ' => Some('\u{1D71A}'),
        'ϖ' => Some('\u{1D71B}'),
        'ı' => Some('\u{1D6A4}'),
        'ȷ' => Some('\u{1D6A5}'),
        _ => None,
    }
}

/// The figures for the browser, if the project has figures: what takes longest.
///
/// # Errors
/// A tool that is missing or fails, named with the remedy.
pub(crate) fn modules(options: &Options) -> Result<Option<Modules>> {
    let manifest = options.project.join("crates/epipole-web/Cargo.toml");
    if !manifest.is_file() {
        return Ok(None);
    }
    wasm::make(&Tools::find(&options.project)?).map(Some)
}

/// Makes everything else, and puts the figures to it.
///
/// # Errors
/// A tool that is missing or fails, named with the remedy.
pub(crate) fn make(
    options: &Options,
    letters: &Letters,
    modules: Option<&Modules>,
) -> Result<Assets> {
    let tools = Tools::find(&options.project)?;
    let mut assets = Assets::default();
    fonts::add(&tools, letters, &mut assets)?;
    let look = scripts::add_look(&tools, options.live, &mut assets)?;
    scripts::add_pages(&tools, &look, options.live, &mut assets)?;
    if let Some(modules) = modules {
        scripts::add_elements(&tools, modules, &look, options.live, &mut assets)?;
    }
    let icon = read(&tools.project.join("web/theme/icon.svg"))?;
    assets.icon = add_hashed(&mut assets.files, "icon", "svg", icon);
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

/// Where things are while assets are made.
pub(crate) struct Tools {
    pub(crate) project: PathBuf,
    modules: PathBuf,
    /// Intermediate files, kept between builds.
    work: PathBuf,
}

impl Tools {
    pub(crate) fn find(project: &Path) -> Result<Tools> {
        let project = std::path::absolute(project)?;
        let modules = project.join("web/node_modules");
        if !modules.join(".bin/esbuild").exists() {
            bail!("the tools of web/ are not installed: run `make setup` (npm ci in web/)");
        }
        let work = target_folder(&project).join("book-work");
        std::fs::create_dir_all(&work)?;
        Ok(Tools {
            project,
            modules,
            work,
        })
    }

    /// Runs a command and returns its standard output; what it says on failure is the error.
    fn run(&self, command: &mut Command) -> Result<String> {
        let name = command.get_program().to_string_lossy().into_owned();
        let output = command
            .current_dir(&self.project)
            .output()
            .with_context(|| format!("{name} cannot be started: is it installed?"))?;
        if !output.status.success() {
            bail!(
                "{name} failed:\n{}",
                String::from_utf8_lossy(&output.stderr).trim()
            );
        }
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

/// Cargo's folder for what it builds.
pub(crate) fn target_folder(project: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| project.join("target"), PathBuf::from)
}

fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).with_context(|| format!("{} cannot be read", path.display()))
}

/// Adds a file under `assets/` whose name carries a hash of its content. Returns its path.
pub fn add_hashed(
    files: &mut BTreeMap<String, Vec<u8>>,
    name: &str,
    extension: &str,
    bytes: Vec<u8>,
) -> String {
    let path = format!("assets/{name}-{:016x}.{extension}", fnv(&bytes));
    files.insert(path.clone(), bytes);
    path
}

/// FNV-1a: a hash that names a version of a file. It protects against stale caches, not malice.
pub fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_formulas_and_text_are_told_apart() {
        let html = "<p>αβ <math><mi>𝐱</mi></math>γ</p>".to_owned();
        let letters = used_letters(&[Page {
            html,
            ..Page::default()
        }]);
        assert!(letters.math.contains(&'𝐱') && !letters.text.contains(&'𝐱'));
        assert!(letters.text.contains(&'α') && letters.text.contains(&'γ'));
        assert!(!letters.math.contains(&'α'));
        assert!(letters.math.contains(&'𝐹') && letters.math.contains(&'ℎ'));
        assert!(!letters.math.contains(&'√'));
        for root in ["msqrt", "mroot"] {
            let html = format!("<math><{root}><mn>2</mn></{root}></math>");
            let letters = used_letters(&[Page {
                html,
                ..Page::default()
            }]);
            assert!(letters.math.contains(&'√'), "{root}");
        }
        assert_eq!(math_italic('z'), Some('𝑧'));
        assert_eq!(math_italic('ω'), Some('𝜔'));
        assert_eq!(math_italic('1'), None);
    }

    #[test]
    fn fnv_of_known_texts() {
        // Values of the authors' reference implementation.
        assert_eq!(fnv(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
