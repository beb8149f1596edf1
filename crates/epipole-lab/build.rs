//! Names what results are computed with: a hash of the sources of the core, of the scenes, of the
//! project and its tasks, and of all versions. Results that were computed with something else are
//! not taken for those of this Lab.

use std::path::{Path, PathBuf};

fn main() {
    let lab = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let mut files = Vec::new();
    for folder in [
        "../epipole/src",
        "../epipole-scenes/src",
        "src/project",
        "src/tasks",
    ] {
        println!("cargo:rerun-if-changed={folder}");
        collect(&lab.join(folder), folder, &mut files);
    }
    let lock = "../../Cargo.lock";
    println!("cargo:rerun-if-changed={lock}");
    files.push((lock.to_owned(), lab.join(lock)));
    files.sort();
    // FNV-1a, the same on every machine.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |bytes: &[u8]| {
        for byte in bytes {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for (name, path) in &files {
        take(name.as_bytes());
        take(&std::fs::read(path).unwrap_or_default());
    }
    println!("cargo:rustc-env=EPIPOLE_LAB_COMPUTED_BY={hash:016x}");
}

/// All files below a folder, with names that do not depend on where it is.
fn collect(folder: &Path, name: &str, files: &mut Vec<(String, PathBuf)>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = format!("{name}/{}", entry.file_name().to_string_lossy());
        match path.is_dir() {
            true => collect(&path, &name, files),
            false => files.push((name, path)),
        }
    }
}
