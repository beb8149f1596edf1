//! Files of a converted model.

use crate::failure::Failure;
use crate::files;
use crate::output_folder::OutputFolder;
use crate::output_folder::colmap::check_foreign;
use epipole_io::model::{ModelFile, ModelFormat};
use std::path::{Path, PathBuf};

/// Writes the first file under the given name, and the files that it names beside it.
pub(super) fn write_file(path: &Path, files: Vec<ModelFile>) -> Result<Vec<String>, Failure> {
    let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
    if !folder.as_os_str().is_empty() {
        files::make_folder(&folder)?;
    }
    let mut written = Vec::new();
    for (index, file) in files.iter().enumerate() {
        let path = match index {
            0 => path.to_owned(),
            _ => folder.join(&file.name),
        };
        files::write(&path, &file.bytes)?;
        written.push(path.display().to_string());
    }
    Ok(written)
}

pub(super) fn write_folder(
    folder: &Path,
    format: ModelFormat,
    files: Vec<ModelFile>,
) -> Result<Vec<String>, Failure> {
    let owner = match format {
        ModelFormat::ColmapText | ModelFormat::ColmapBinary => "convert-colmap",
        other => other.name(),
    };
    let mut output = OutputFolder::new(folder, owner);
    check_foreign(&output, "", format)?;
    let mut written = Vec::new();
    for file in &files {
        let path = output.write(&file.name, &file.bytes)?;
        written.push(path.display().to_string());
    }
    output.finish()?;
    Ok(written)
}
