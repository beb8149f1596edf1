//! Files beside the project, for tests.

use std::path::PathBuf;

/// A file of the real photographs, or `None` with a printed line where they are absent.
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

/// A file of the field cases beside the photographs, likewise.
pub(crate) fn field(relative: &str) -> Option<PathBuf> {
    data(&format!("../field/{relative}"))
}
