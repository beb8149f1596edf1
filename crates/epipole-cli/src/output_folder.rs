//! Output folder that removes the files of an earlier run.

pub(crate) mod colmap;

use crate::failure::Failure;
use crate::files;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// List of files that commands wrote: checksum, command and path per line.
const LIST: &str = ".epipole-files";

/// A file that a command wrote.
#[derive(Debug, Clone, PartialEq)]
struct Written {
    checksum: u64,
    owner: String,
}

/// Files to be written to a folder.
#[derive(Debug)]
pub(crate) struct OutputFolder {
    folder: PathBuf,
    owner: &'static str,
    /// Files of earlier runs, by path below the folder, with `/`.
    before: BTreeMap<String, Written>,
    /// Files of this run.
    now: BTreeMap<String, Written>,
}

impl OutputFolder {
    /// * `owner`: the command and what it writes, without blanks
    pub(crate) fn new(folder: &Path, owner: &'static str) -> Self {
        let list = fs::read_to_string(folder.join(LIST)).unwrap_or_default();
        Self {
            folder: folder.to_owned(),
            owner,
            before: parse(&list),
            now: BTreeMap::new(),
        }
    }

    /// Returns the path of the folder.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Returns whether a file exists that this command did not write or that was changed since.
    pub(crate) fn holds_foreign(&self, name: &str) -> bool {
        let is_mine = |written: &Written| written.owner == self.owner;
        self.folder.join(name).exists()
            && !(self.before.get(name)).is_some_and(|w| is_mine(w) && self.is_unchanged(name, w))
    }

    fn is_unchanged(&self, name: &str, written: &Written) -> bool {
        let path = self.folder.join(name);
        !path.is_symlink() && fs::read(path).is_ok_and(|bytes| checksum(&bytes) == written.checksum)
    }

    /// Writes a file and returns its path.
    ///
    /// * `name`: path below the folder, with `/`
    ///
    /// # Errors
    /// A failure naming the file.
    pub(crate) fn write(&mut self, name: &str, bytes: &[u8]) -> Result<PathBuf, Failure> {
        let path = self.folder.join(name);
        files::make_folder(path.parent().unwrap_or(&self.folder))?;
        files::write(&path, bytes)?;
        let written = Written {
            checksum: checksum(bytes),
            owner: self.owner.to_owned(),
        };
        self.now.insert(name.to_owned(), written);
        Ok(path)
    }

    /// Removes files of earlier runs of this command that were not rewritten, and their folders if
    /// empty. Files changed since are kept.
    ///
    /// # Errors
    /// A failure naming a file that cannot be removed or written.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        let owner = self.owner;
        self.finish_with(|written| written.owner == owner)
    }

    /// Does the work of [`finish`](Self::finish) for the files of all commands, because files
    /// derived from an earlier result do not fit this one.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    pub(crate) fn finish_anew(self) -> Result<(), Failure> {
        self.finish_with(|_| true)
    }

    fn finish_with(mut self, is_stale: impl Fn(&Written) -> bool) -> Result<(), Failure> {
        for (name, written) in &self.before {
            if self.now.contains_key(name) {
                continue;
            }
            if !is_stale(written) {
                self.now.insert(name.clone(), written.clone());
            } else if self.is_unchanged(name, written) {
                self.remove(name)?;
            }
        }
        let lines = self.now.iter();
        let lines = lines.map(|(name, w)| format!("{:016x} {} {name}\n", w.checksum, w.owner));
        files::write(
            &self.folder.join(LIST),
            lines.collect::<String>().as_bytes(),
        )
    }

    fn remove(&self, name: &str) -> Result<(), Failure> {
        let path = self.folder.join(name);
        fs::remove_file(&path).map_err(|error| {
            Failure::new("write", format!("cannot be removed: {error}")).about(&path)
        })?;
        let mut parent = Path::new(name).parent();
        while let Some(folder) = parent.filter(|folder| !folder.as_os_str().is_empty()) {
            // Fails if the folder is not empty.
            if fs::remove_dir(self.folder.join(folder)).is_err() {
                break;
            }
            parent = folder.parent();
        }
        Ok(())
    }
}

/// Parses a list, without paths that lead out of the folder.
fn parse(text: &str) -> BTreeMap<String, Written> {
    let is_below = |name: &str| {
        let mut parts = Path::new(name).components();
        parts.all(|part| matches!(part, Component::Normal(_)))
    };
    let line = |line: &str| {
        let mut parts = line.splitn(3, ' ');
        let checksum = u64::from_str_radix(parts.next()?, 16).ok()?;
        let owner = parts.next()?.to_owned();
        let name = parts.next().filter(|name| is_below(name))?;
        Some((name.to_owned(), Written { checksum, owner }))
    };
    text.lines().filter_map(line).collect()
}

/// Returns the 64-bit FNV-1a checksum.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output(folder: &Path, owner: &'static str, names: &[&str]) -> OutputFolder {
        let mut output = OutputFolder::new(folder, owner);
        for name in names {
            output.write(name, name.as_bytes()).unwrap();
        }
        output
    }

    #[test]
    fn only_unchanged_files_of_earlier_runs_are_removed() {
        let folder = std::env::temp_dir().join(format!("epipole-again-{}", std::process::id()));
        let is_there = |name: &str| folder.join(name).exists();
        let first = ["a.txt", "two/b.txt", "two/c.txt", "three/d"];
        output(&folder, "sfm", &first).finish_anew().unwrap();
        fs::write(folder.join("notes.txt"), "mine").unwrap();
        fs::write(folder.join("two/c.txt"), "changed").unwrap();
        output(&folder, "ply", &["e.ply"]).finish().unwrap();
        assert!(first.iter().all(|name| is_there(name)));
        let again = output(&folder, "ply", &["f.ply"]);
        assert!(again.holds_foreign("a.txt") && again.holds_foreign("notes.txt"));
        assert!(!again.holds_foreign("e.ply") && !again.holds_foreign("none"));
        again.finish().unwrap();
        assert!(is_there("a.txt") && !is_there("e.ply") && is_there("f.ply"));
        output(&folder, "sfm", &["a.txt"]).finish_anew().unwrap();
        assert!(is_there("a.txt") && is_there("notes.txt") && is_there("two/c.txt"));
        assert!(!is_there("two/b.txt") && !is_there("three") && !is_there("f.ply"));
        fs::remove_dir_all(&folder).unwrap();
        let parsed = parse("00ff sfm a b\n1 sfm ../c\n1 sfm /d\nx sfm e\n1 sfm\n");
        assert_eq!(parsed.keys().collect::<Vec<_>>(), ["a b"]);
    }
}
