//! Test data next to the project.

use std::path::PathBuf;

/// Returns a file of the real photos, or prints a line and returns `None` if they are absent.
pub(crate) fn data(relative: &str) -> Option<PathBuf> {
    let root = std::env::var_os("EPIPOLE_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let path = root.join(relative);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: no data at {}", path.display());
    None
}

/// Returns a file of the field cases next to the photos, likewise.
pub(crate) fn field(relative: &str) -> Option<PathBuf> {
    data(&format!("../field/{relative}"))
}
