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
