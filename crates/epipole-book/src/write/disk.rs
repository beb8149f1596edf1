//! The site on the disk.

use crate::render::links::LAB_FOLDER;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::path::Path;

/// The mark of a folder with the page that stands where the Lab will be.
pub(crate) const STAND_IN: &str = ".placeholder";

/// Writes the site beside its place and then moves it there, so that a reader never sees half.
pub(crate) fn write(files: &BTreeMap<String, Vec<u8>>, out: &Path) -> Result<()> {
    let next = out.with_extension("next");
    remove(&next)?;
    for (path, bytes) in files {
        let path = next.join(path);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        }
        std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
    }
    // The Lab takes minutes to build, and a chapter's words seconds.
    let (lab, kept) = (out.join(LAB_FOLDER), next.join(LAB_FOLDER));
    if lab.is_dir() && !lab.join(STAND_IN).exists() {
        remove(&kept)?;
        std::fs::rename(&lab, &kept)
            .with_context(|| format!("cannot keep the Lab at {}", lab.display()))?;
    }
    remove(out)?;
    std::fs::rename(&next, out).with_context(|| format!("cannot put the site at {}", out.display()))
}

fn remove(folder: &Path) -> Result<()> {
    match std::fs::remove_dir_all(folder) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(error).with_context(|| format!("cannot remove {}", folder.display()))
        }
        _ => Ok(()),
    }
}
