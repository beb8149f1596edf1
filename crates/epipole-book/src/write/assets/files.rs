//! Generated files of the site, and their paths for the templates.

use crate::hash::fnv;
use serde::Serialize;
use std::collections::BTreeMap;

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
    /// The script of single-figure pages, for frames.
    pub frame: Option<String>,
    /// Their style sheet.
    pub frame_css: String,
    /// The script of the slides.
    pub deck: String,
    /// Their style sheet, besides that of the pages.
    pub deck_css: String,
    /// Fonts that every page needs immediately.
    pub preload: Vec<String>,
    /// The italic font.
    pub italic: Option<String>,
    /// The icon.
    pub icon: String,
    /// Icons of the installed book.
    #[serde(skip)]
    pub app_icons: Vec<AppIcon>,
    /// Path → content.
    #[serde(skip)]
    pub files: BTreeMap<String, Vec<u8>>,
}

/// An icon of the installed book, as its manifest describes it.
#[derive(Debug, Clone)]
pub struct AppIcon {
    /// Path from the root of the site.
    pub path: String,
    /// Sizes, CSS pixels.
    pub sizes: &'static str,
    /// MIME type.
    pub kind: &'static str,
    /// `maskable` if it can be cropped to any shape, else `any`.
    pub purpose: &'static str,
}

/// Adds a file under `assets/` with a hash of its content in its name. Returns its path.
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
