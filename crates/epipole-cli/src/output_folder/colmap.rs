//! Existing files that COLMAP would read instead of, or along with, the written ones.

use super::OutputFolder;
use crate::failure::Failure;
use epipole_io::model::ModelFormat;

/// Refuses to write a COLMAP model beside files of another model that COLMAP would read: binary
/// files, which it prefers to text, and `rigs` and `frames`, which have IDs of the other model.
///
/// * `below`: path in the folder, empty or ending in `/`
///
/// # Errors
/// A failure naming the file.
pub(crate) fn check_foreign(
    output: &OutputFolder,
    below: &str,
    format: ModelFormat,
) -> Result<(), Failure> {
    const OF_OTHER: &str = "this file belongs to another model, and COLMAP would read it with the \
        new one: choose another folder, or move it away";
    const INSTEAD: &str = "COLMAP would read this file and not the text beside it: choose another \
        folder, or move it away";
    let foreign: &[(&str, &str)] = match format {
        ModelFormat::ColmapText => &[
            ("cameras.bin", INSTEAD),
            ("rigs.txt", OF_OTHER),
            ("frames.txt", OF_OTHER),
        ],
        ModelFormat::ColmapBinary => &[("rigs.bin", OF_OTHER), ("frames.bin", OF_OTHER)],
        _ => &[],
    };
    for (name, message) in foreign {
        let name = format!("{below}{name}");
        if output.holds_foreign(&name) {
            return Err(Failure::new("write", *message).about(&output.folder().join(name)));
        }
    }
    Ok(())
}
