//! Zip files in memory.

use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// A zip file in memory.
pub(super) struct Archive(ZipWriter<Cursor<Vec<u8>>>);

impl Archive {
    pub(super) fn new() -> Self {
        Self(ZipWriter::new(Cursor::new(Vec::new())))
    }

    /// Adds a file. Photographs are already compressed, so they are stored.
    pub(super) fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let is_packed = [".jpg", ".jpeg", ".png", ".webp"]
            .iter()
            .any(|end| name.to_lowercase().ends_with(end));
        let method = match is_packed {
            true => CompressionMethod::Stored,
            false => CompressionMethod::Deflated,
        };
        let options = SimpleFileOptions::default().compression_method(method);
        let sentence = |why: String| format!("{name} could not be written: {why}");
        self.0
            .start_file(name, options)
            .map_err(|error| sentence(error.to_string()))?;
        self.0
            .write_all(bytes)
            .map_err(|error| sentence(error.to_string()))
    }

    pub(super) fn finish(self) -> Result<Vec<u8>, String> {
        let written = self.0.finish().map_err(|error| error.to_string())?;
        Ok(written.into_inner())
    }
}
