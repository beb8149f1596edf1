//! A model in a file or folder.

use crate::failure::Failure;
use crate::files;
use epipole_io::model::{ReadModel, read_model_file, read_model_folder};
use std::path::{Component, Path, PathBuf};

/// Folders within a project that hold its model.
const FOLDERS: [&str; 4] = ["", "sparse/0", "sparse", "0"];

/// Reads a file below a folder. Names come from other files and must not lead out of the folder.
fn beside(folder: &Path, name: &str) -> Option<Vec<u8>> {
    let name = Path::new(name);
    let is_below = name
        .components()
        .all(|part| matches!(part, Component::Normal(_)));
    is_below.then(|| std::fs::read(folder.join(name)).ok())?
}

/// Reads the model of a folder or file. One of COLMAP's files is enough to name the model.
///
/// # Errors
/// A failure that names the path, if there is no model or it is wrong.
pub(crate) fn read(path: &Path) -> Result<ReadModel, Failure> {
    if !path.is_dir() {
        return of_file(path, &files::read_bytes(path)?);
    }
    for folder in FOLDERS {
        let folder = path.join(folder);
        let found = read_model_folder(&|name: &str| beside(&folder, name));
        if let Some(read) = found.map_err(|error| Failure::from(error).about(path))? {
            return Ok(read);
        }
    }
    let message = "there is no model in this folder: neither cameras.txt, cameras.bin, \
                   transforms.json, sfm_data.json, bundle.out nor points.ply";
    Err(Failure::new("read", message).about(path))
}

/// Reads the model of a file and the files that it names.
///
/// # Errors
/// A failure that names the path.
pub(crate) fn of_file(path: &Path, bytes: &[u8]) -> Result<ReadModel, Failure> {
    let about = |error: epipole_io::Error| Failure::from(error).about(path);
    let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if let Some((stem, ending @ ("txt" | "bin"))) = name.rsplit_once('.')
        && ["cameras", "images", "points3D"].contains(&stem)
    {
        let of_kind = |name: &str| {
            let is_of_kind = Path::new(name).extension().is_some_and(|e| e == ending);
            is_of_kind.then(|| beside(&folder, name))?
        };
        if let Some(read) = read_model_folder(&of_kind).map_err(about)? {
            return Ok(read);
        }
    }
    read_model_file(&name, bytes, &|name: &str| beside(&folder, name)).map_err(about)
}
