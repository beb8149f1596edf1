//! The content folder: chapters and the files beside them.

use super::source::Source;
use crate::problems::Place;
use std::path::{Path, PathBuf};

/// The folder with `SUMMARY.md` and the chapters.
#[derive(Debug, Clone)]
pub(crate) struct Content {
    folder: PathBuf,
    /// Name of the folder in messages.
    shown_as: PathBuf,
}

impl Content {
    pub(crate) fn new(folder: &Path) -> Content {
        let shown_as = folder.file_name().map_or(folder, Path::new);
        Content {
            folder: folder.to_path_buf(),
            shown_as: shown_as.to_path_buf(),
        }
    }

    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Returns a line of a file, for messages.
    pub(crate) fn place(&self, file: &str, line: usize) -> Place {
        Place::new(self.shown_as.join(file), line)
    }

    /// Returns the full path of a file.
    pub(crate) fn path(&self, file: &str) -> PathBuf {
        self.folder.join(file)
    }

    /// Reads a text file; `None` if it is unreadable.
    pub(crate) fn read(&self, file: &str) -> Option<Source> {
        let text = std::fs::read_to_string(self.path(file)).ok()?;
        Some(Source::new(text, self.place(file, 1)))
    }

    /// Returns the names of the files in a folder; empty if there is no such folder.
    pub(crate) fn files_in(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.path(folder)).into_iter();
        let entries = entries.flatten().flatten();
        entries
            .filter(|entry| entry.path().is_file())
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect()
    }
}
