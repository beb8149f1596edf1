//! Zip files: how they are written, and projects, which are read again.

use crate::project::{COMPUTED_BY, Computed, Saved, VERSION};
use crate::tasks::{Blob, Packed, Source};
use std::io::{Cursor, Read, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// The settings in the archive of a project.
const PROJECT: &str = "project.json";
/// The folder of its photographs.
const PHOTOGRAPHS: &str = "photographs/";
/// Folder of the results, with a subfolder named by the build that computed them.
const RESULTS: &str = "results/";
const DAMAGED: &str = "this file is no project of the Lab, or it is damaged";
/// Maximum unpacked size of a project, bytes.
const MAX_BYTES: u64 = 2_000_000_000;

/// Names, and what they hold.
type Files = Vec<(String, Blob)>;

/// A zip file in memory.
pub(super) struct Archive(ZipWriter<Cursor<Vec<u8>>>);

impl Archive {
    pub(super) fn new() -> Self {
        Self(ZipWriter::new(Cursor::new(Vec::new())))
    }

    /// Adds a file; photographs are compressed already, so they are stored.
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

/// Photographs as they were given, settings, and results.
///
/// # Errors
/// A sentence, if a file cannot be written.
pub(crate) fn save(
    photographs: &[Packed],
    project: &Saved,
    computed: &Computed,
) -> Result<Vec<u8>, String> {
    let mut archive = Archive::new();
    let text = serde_json::to_string_pretty(project).map_err(|error| error.to_string())?;
    archive.add(PROJECT, text.as_bytes())?;
    for photograph in photographs {
        // Samples are rendered again.
        if let Source::File(bytes) = &photograph.source {
            archive.add(&format!("{PHOTOGRAPHS}{}", photograph.name), bytes)?;
        }
    }
    for (key, bytes) in &computed.results {
        archive.add(&format!("{RESULTS}{}/{key:016x}", computed.by), bytes)?;
    }
    archive.finish()
}

/// The settings, photographs and results of a project; no results of another version of the Lab.
///
/// # Errors
/// A sentence, if the file is no project or is damaged.
pub(crate) fn open(bytes: &[u8]) -> Result<(Saved, Files, Computed), String> {
    let damaged = DAMAGED;
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|_| damaged)?;
    let mut project = None;
    let mut files = Vec::new();
    let mut computed = Computed {
        by: COMPUTED_BY.to_owned(),
        ..Computed::default()
    };
    let results = format!("{RESULTS}{COMPUTED_BY}/");
    let too_large = "this project is too large to open here";
    let mut left = MAX_BYTES;
    for index in 0..archive.len() {
        let entry = archive.by_index(index).map_err(|_| damaged)?;
        if entry.size() > left {
            return Err(too_large.to_owned());
        }
        let name = entry.name().to_owned();
        if name.starts_with(RESULTS) && !name.starts_with(&results) {
            continue;
        }
        let mut content = Vec::new();
        // A damaged entry may be larger than its header says.
        entry
            .take(left + 1)
            .read_to_end(&mut content)
            .map_err(|_| damaged)?;
        left = left.checked_sub(content.len() as u64).ok_or(too_large)?;
        if name == PROJECT {
            project = Some(read(&content)?);
        } else if let Some(name) = name.strip_prefix(PHOTOGRAPHS)
            && !name.is_empty()
        {
            files.push((name.to_owned(), content.into()));
        } else if let Some(name) = name.strip_prefix(&results)
            && let Ok(key) = u64::from_str_radix(name, 16)
        {
            computed.results.push((key, content.into()));
        }
    }
    Ok((project.ok_or(damaged)?, files, computed))
}

/// The settings, if they are of a version that is known here.
fn read(text: &[u8]) -> Result<Saved, String> {
    #[derive(serde::Deserialize)]
    struct Head {
        version: u32,
    }
    let head: Head = serde_json::from_slice(text).map_err(|_| DAMAGED)?;
    if head.version > VERSION {
        return Err("this project was saved by a newer Lab: reload the page to get it".to_owned());
    }
    serde_json::from_slice(text).map_err(|_| DAMAGED.to_owned())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;

    fn project() -> Saved {
        Saved {
            version: VERSION,
            ..Saved::default()
        }
    }

    #[test]
    fn a_project_comes_back() {
        let photographs = [Packed {
            name: "a.jpg".to_owned(),
            source: Source::File(vec![1, 2, 3].into()),
            used: None,
        }];
        let computed = Computed {
            by: COMPUTED_BY.to_owned(),
            results: vec![(7, vec![4, 5].into()), (u64::MAX, Blob::default())],
        };
        let bytes = save(&photographs, &project(), &computed).unwrap();
        let (read, files, again) = open(&bytes).unwrap();
        assert_eq!(again, computed);
        // Results of another build are not loaded.
        let older = Computed {
            by: "older".to_owned(),
            ..computed
        };
        let older = save(&photographs, &project(), &older).unwrap();
        assert_eq!(open(&older).unwrap().2.results, []);
        assert_eq!(read, project());
        assert_eq!(files, [("a.jpg".to_owned(), Blob::from(vec![1, 2, 3]))]);
        for end in [0, 10, bytes.len() - 5] {
            assert!(open(&bytes[..end]).is_err());
        }
    }

    #[test]
    fn a_newer_project_is_refused_in_words() {
        let newer = Saved {
            version: VERSION + 1,
            ..Saved::default()
        };
        let refused = open(&save(&[], &newer, &Computed::default()).unwrap()).unwrap_err();
        assert!(refused.contains("newer"), "{refused}");
    }
}
