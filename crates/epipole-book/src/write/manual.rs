//! The manual of the Python package, which another program builds, as a part of the site.

use crate::render::page::Section;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::path::Path;

/// Folder of the manual in the site.
pub const MANUAL_FOLDER: &str = "python";

/// Sections for the search, among the files of the manual: as those of the book, with addresses
/// relative to the manual.
const SECTIONS: &str = "search/sections.json";

/// Files of the manual and the sections that a search finds.
#[derive(Debug, Default)]
pub(crate) struct Manual {
    /// By their paths in the site.
    pub(crate) files: BTreeMap<String, Vec<u8>>,
    /// With addresses relative to the root of the site.
    pub(crate) sections: Vec<Section>,
}

impl Manual {
    /// Reads the manual.
    ///
    /// # Errors
    /// A folder without the list of sections, or a file that cannot be read.
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
        manual.add(folder, MANUAL_FOLDER)?;
        manual.files.remove(&format!("{MANUAL_FOLDER}/{SECTIONS}"));
        Ok(manual)
    }

    fn add(&mut self, folder: &Path, path: &str) -> Result<()> {
        let unreadable = || format!("cannot read {}", folder.display());
        for entry in std::fs::read_dir(folder).with_context(unreadable)? {
            let entry = entry.with_context(unreadable)?;
            let inner = format!("{path}/{}", entry.file_name().to_string_lossy());
            if entry.file_type().with_context(unreadable)?.is_dir() {
                self.add(&entry.path(), &inner)?;
            } else {
                let bytes = std::fs::read(entry.path())
                    .with_context(|| format!("cannot read {}", entry.path().display()))?;
                self.files.insert(inner, bytes);
            }
        }
        Ok(())
    }
}
