//! Writing of the site to disk.

use crate::render::links::LAB_FOLDER;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::path::Path;

/// Marker file of a folder that contains the placeholder page of the Lab.
pub(crate) const PLACEHOLDER: &str = ".placeholder";

/// Writes the site to a temporary folder, which then replaces the old one, so that readers never
/// see an incomplete site.
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
    // The old Lab is kept: it takes minutes to build, a chapter only seconds.
    let (lab, next_lab) = (out.join(LAB_FOLDER), next.join(LAB_FOLDER));
    if lab.is_dir() && !lab.join(PLACEHOLDER).exists() {
        remove(&next_lab)?;
        std::fs::rename(&lab, &next_lab)
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
