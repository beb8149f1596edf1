//! The manual of the Python package and the reference of the npm package, built by other programs,
//! as parts of the site.

use crate::render::page::Section;
use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::path::Path;

/// Folder of the manual in the site.
pub const MANUAL_FOLDER: &str = "python";

/// Folder of the reference in the site.
pub const REFERENCE_FOLDER: &str = "js";

/// Sections for the search index, in the manual: in the book's format, with addresses relative to
/// the manual.
const SECTIONS: &str = "search/sections.json";

/// Files by their paths in the site.
type Files = BTreeMap<String, Vec<u8>>;

/// Files of the manual and the sections that a search finds.
#[derive(Debug, Default)]
pub(crate) struct Manual {
    pub(crate) files: Files,
    /// Sections for the search index, with addresses relative to the root of the site.
    pub(crate) sections: Vec<Section>,
}

impl Manual {
    /// Reads the manual.
    ///
    /// # Errors
    /// A folder without the list of sections, or an unreadable file.
    pub(crate) fn read(folder: &Path) -> Result<Manual> {
        let mut manual = Manual::default();
        let list = folder.join(SECTIONS);
        let text = std::fs::read(&list).with_context(|| {
            format!(
                "cannot read {}: `make python-docs` builds the manual",
                list.display()
            )
        })?;
        manual.sections = serde_json::from_slice(&text)
            .with_context(|| format!("{} is no list of sections", list.display()))?;
        for section in &mut manual.sections {
            section.url.insert_str(0, &format!("{MANUAL_FOLDER}/"));
        }
        add(&mut manual.files, folder, MANUAL_FOLDER)?;
        manual.files.remove(&format!("{MANUAL_FOLDER}/{SECTIONS}"));
        Ok(manual)
    }
}

/// Reads the reference, which has a search of its own.
///
/// # Errors
/// A folder without an index page, or an unreadable file.
pub(crate) fn read_reference(folder: &Path) -> Result<Files> {
    let first = folder.join("index.html");
    if !first.is_file() {
        bail!(
            "{} does not exist: `make vision-docs` builds the reference",
            first.display()
        );
    }
    let mut files = Files::new();
    add(&mut files, folder, REFERENCE_FOLDER)?;
    Ok(files)
}

/// Adds the files of a folder, under this path of the site.
fn add(files: &mut Files, folder: &Path, path: &str) -> Result<()> {
    let unreadable = || format!("cannot read {}", folder.display());
    for entry in std::fs::read_dir(folder).with_context(unreadable)? {
        let entry = entry.with_context(unreadable)?;
        let inner = format!("{path}/{}", entry.file_name().to_string_lossy());
        if entry.file_type().with_context(unreadable)?.is_dir() {
            add(files, &entry.path(), &inner)?;
        } else {
            let bytes = std::fs::read(entry.path())
                .with_context(|| format!("cannot read {}", entry.path().display()))?;
            files.insert(inner, bytes);
        }
    }
    Ok(())
}
