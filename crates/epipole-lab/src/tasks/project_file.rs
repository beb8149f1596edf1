//! Zip file of a project: original photographs, settings and results.

use super::photograph::Photograph;
use super::task::Task;
#[cfg(feature = "files")]
use super::task::{Monitor, Run};
use crate::project::{Blob, Computed, LensCamera, Saved, Source};
use serde::{Deserialize, Serialize};

/// A photograph for an archive.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Packed {
    /// Its unique name.
    pub name: String,
    /// Original file or sample.
    pub source: Source,
    /// The photograph as it was reconstructed; not needed for a project.
    pub used: Option<Photograph>,
    /// Camera whose distortion was removed if it has the photograph's size; not needed for a
    /// project.
    pub camera: Option<LensCamera>,
}

/// Writes original photographs and settings to a zip file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SaveProject {
    /// The photographs.
    pub photographs: Vec<Packed>,
    /// The project without its photographs.
    pub project: Saved,
    /// Cached results.
    pub computed: Computed,
}

impl Task for SaveProject {
    /// A zip file.
    type Output = Blob;
}

/// Reads the zip file of a project.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OpenProject {
    /// Its bytes.
    pub archive: Blob,
}

/// A project read from its zip file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Opened {
    /// The project without its photographs.
    pub project: Saved,
    /// Names and files of the photographs.
    pub files: Vec<(String, Blob)>,
    /// Results; empty if another version of the Lab computed them.
    pub computed: Computed,
}

impl Task for OpenProject {
    type Output = Opened;
}

/// Settings in the zip file of a project.
#[cfg(feature = "files")]
const PROJECT: &str = "project.json";
/// Folder of the photographs.
#[cfg(feature = "files")]
const PHOTOGRAPHS: &str = "photographs/";
/// Folder of the results, with a subfolder named by the build that computed them.
#[cfg(feature = "files")]
const RESULTS: &str = "results/";
#[cfg(feature = "files")]
const DAMAGED: &str = "this file is no project of the Lab, or it is damaged";
/// Maximum unpacked size of a project, bytes.
#[cfg(feature = "files")]
const MAX_BYTES: u64 = 2_000_000_000;

#[cfg(feature = "files")]
impl Run for SaveProject {
    fn run(self, _monitor: Monitor<'_>) -> Result<Blob, String> {
        use super::archive::Archive;
        let mut archive = Archive::new();
        let text =
            serde_json::to_string_pretty(&self.project).map_err(|error| error.to_string())?;
        archive.add(PROJECT, text.as_bytes())?;
        for photograph in &self.photographs {
            // Samples are rendered again when opened.
            if let Source::File(bytes) = &photograph.source {
                archive.add(&format!("{PHOTOGRAPHS}{}", photograph.name), bytes)?;
            }
        }
        for (key, bytes) in &self.computed.results {
            archive.add(&format!("{RESULTS}{}/{key:016x}", self.computed.by), bytes)?;
        }
        Ok(archive.finish()?.into())
    }
}

#[cfg(feature = "files")]
impl Run for OpenProject {
    fn run(self, _monitor: Monitor<'_>) -> Result<Opened, String> {
        use crate::project::COMPUTED_BY;
        use std::io::{Cursor, Read};
        use zip::ZipArchive;
        let damaged = DAMAGED;
        let mut archive = ZipArchive::new(Cursor::new(&self.archive[..])).map_err(|_| damaged)?;
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
            // A damaged entry may be larger than its header claims.
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
        Ok(Opened {
            project: project.ok_or(damaged)?,
            files,
            computed,
        })
    }
}

/// Parses the settings, if their version is supported.
#[cfg(feature = "files")]
fn read(text: &[u8]) -> Result<Saved, String> {
    #[derive(serde::Deserialize)]
    struct Head {
        version: u32,
    }
    let head: Head = serde_json::from_slice(text).map_err(|_| DAMAGED)?;
    if head.version > crate::project::VERSION {
        return Err("this project was saved by a newer Lab: reload the page to get it".to_owned());
    }
    serde_json::from_slice(text).map_err(|_| DAMAGED.to_owned())
}

#[cfg(all(test, feature = "files"))]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use crate::project::{COMPUTED_BY, VERSION};
    use std::ops::ControlFlow;

    fn save(photographs: &[Packed], project: &Saved, computed: &Computed) -> Result<Blob, String> {
        let task = SaveProject {
            photographs: photographs.to_vec(),
            project: project.clone(),
            computed: computed.clone(),
        };
        task.run(&mut |_| ControlFlow::Continue(()))
    }

    fn open(bytes: &[u8]) -> Result<Opened, String> {
        let archive = bytes.to_vec().into();
        OpenProject { archive }.run(&mut |_| ControlFlow::Continue(()))
    }

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
            camera: None,
        }];
        let computed = Computed {
            by: COMPUTED_BY.to_owned(),
            results: vec![(7, vec![4, 5].into()), (u64::MAX, Blob::default())],
        };
        let bytes = save(&photographs, &project(), &computed).unwrap();
        let opened = open(&bytes).unwrap();
        assert_eq!(opened.computed, computed);
        // Results of another build are ignored.
        let older = Computed {
            by: "older".to_owned(),
            ..computed
        };
        let older = save(&photographs, &project(), &older).unwrap();
        assert_eq!(open(&older).unwrap().computed.results, []);
        assert_eq!(opened.project, project());
        assert_eq!(
            opened.files,
            [("a.jpg".to_owned(), Blob::from(vec![1, 2, 3]))]
        );
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
