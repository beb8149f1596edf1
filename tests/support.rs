//! What the tests across crates share.

use std::fs;
use std::path::{Path, PathBuf};

/// The top of the repository.
pub fn root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().unwrap_or(manifest).to_owned()
}

/// Every file below `folder` with one of the extensions, sorted.
///
/// # Panics
/// If the folder cannot be read.
pub fn files_below(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder);
        let entries = entries.unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        for entry in entries.flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path
                .extension()
                .is_some_and(|e| extensions.iter().any(|x| e == *x))
            {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The Rust listings of the chapters, run as documentation tests.
#[cfg(doctest)]
pub mod listings {
    /// Chapter "One photo gives directions, not distances".
    #[doc = include_str!("../content/rays.md")]
    pub struct Rays;
    /// Chapter "An image is a function".
    #[doc = include_str!("../content/gradients.md")]
    pub struct Gradients;
    /// Chapter "Points you can find again".
    #[doc = include_str!("../content/corners.md")]
    pub struct Corners;
    /// Chapter "One point, one line".
    #[doc = include_str!("../content/epipolar.md")]
    pub struct Epipolar;
    /// Chapter "F from matches".
    #[doc = include_str!("../content/eight-point.md")]
    pub struct EightPoint;
    /// Chapter "Let the data vote".
    #[doc = include_str!("../content/ransac.md")]
    pub struct Ransac;
    /// Chapter "Cash in".
    #[doc = include_str!("../content/triangulation.md")]
    pub struct Triangulation;
    /// Chapter "Where this leads".
    #[doc = include_str!("../content/connections.md")]
    pub struct Connections;
    /// Chapter "Structure from motion".
    #[doc = include_str!("../content/sfm.md")]
    pub struct Sfm;
    /// Chapter "Two eyes in a row".
    #[doc = include_str!("../content/stereo.md")]
    pub struct Stereo;
}
