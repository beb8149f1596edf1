//! Names what draws the figures: a hash of the sources of the core, the scenes, the canvas and the
//! figures, of how posters are encoded, and of all versions. What something else has drawn is drawn
//! again.

use std::fs;
use std::path::Path;

/// Inputs of a poster besides its figure's settings.
const SOURCES: [&str; 8] = [
    "../epipole/src",
    "../epipole-canvas/assets",
    "../epipole-canvas/src",
    "../epipole-scenes/src",
    "../epipole-widgets/src",
    "src/resolve/figures.rs",
    "src/resolve/posters.rs",
    "../../Cargo.lock",
];

fn main() {
    // FNV-1a, the same on every machine.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for source in SOURCES {
        println!("cargo:rerun-if-changed={source}");
        take(Path::new(source), &mut hash);
    }
    println!("cargo:rustc-env=EPIPOLE_BOOK_DRAWN_BY={hash:016x}");
}

/// Takes a file, or all files below a folder in the order of their names.
fn take(path: &Path, hash: &mut u64) {
    if let Ok(entries) = fs::read_dir(path) {
        let mut inside: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        inside.sort();
        inside.iter().for_each(|path| take(path, hash));
        return;
    }
    let name = path.to_string_lossy();
    let bytes = fs::read(path).unwrap_or_default();
    for byte in name.bytes().chain(bytes) {
        *hash = (*hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
}
