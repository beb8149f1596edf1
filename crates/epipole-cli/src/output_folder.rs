//! A folder of results that is written again: files of the run before do not stay behind.

use crate::failure::Failure;
use crate::files;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// List of the files that the last run wrote: a checksum and a path a line.
const LIST: &str = ".epipole-files";

/// Files to be written to a folder.
#[derive(Debug)]
pub(crate) struct OutputFolder {
    folder: PathBuf,
    /// Checksums by path below the folder, with `/`.
    written: BTreeMap<String, u64>,
}

impl OutputFolder {
    pub(crate) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            written: BTreeMap::new(),
        }
    }

    /// Writes a file and returns its path.
    ///
    /// * `name`: path below the folder, with `/`
    ///
    /// # Errors
    /// A sentence naming the file.
    pub(crate) fn write(&mut self, name: &str, bytes: &[u8]) -> Result<PathBuf, Failure> {
        let path = self.folder.join(name);
        files::make_folder(path.parent().unwrap_or(&self.folder))?;
        files::write(&path, bytes)?;
        self.written.insert(name.to_owned(), checksum(bytes));
        Ok(path)
    }

    /// Removes the files of the run before that were not written again, and their folders if nothing
    /// else is in them; returns their paths. A file that was changed since is not ours and stays.
    ///
    /// # Errors
    /// A sentence naming a file that cannot be removed or written.
    pub(crate) fn finish(self) -> Result<Vec<PathBuf>, Failure> {
        let list = self.folder.join(LIST);
        let mut removed = Vec::new();
        for (name, sum) in parse(&fs::read_to_string(&list).unwrap_or_default()) {
            let path = self.folder.join(&name);
            let is_ours = || fs::read(&path).is_ok_and(|bytes| checksum(&bytes) == sum);
            if self.written.contains_key(&name) || path.is_symlink() || !is_ours() {
                continue;
            }
            fs::remove_file(&path).map_err(|error| {
                Failure::new("write", format!("cannot be removed: {error}")).about(&path)
            })?;
            let mut parent = Path::new(&name).parent();
            while let Some(folder) = parent.filter(|folder| !folder.as_os_str().is_empty()) {
                // Fails as long as something is in it.
                if fs::remove_dir(self.folder.join(folder)).is_err() {
                    break;
                }
                parent = folder.parent();
            }
            removed.push(path);
        }
        let lines = self.written.iter();
        let lines: String = (lines.map(|(name, sum)| format!("{sum:016x} {name}\n"))).collect();
        files::write(&list, lines.as_bytes())?;
        Ok(removed)
    }
}

/// The lines of a list; those that lead out of the folder are left out.
fn parse(text: &str) -> Vec<(String, u64)> {
    let is_below = |name: &str| {
        let mut parts = Path::new(name).components();
        parts.all(|part| matches!(part, Component::Normal(_)))
    };
    let line = |line: &str| {
        let (sum, name) = line.split_once(' ')?;
        let sum = u64::from_str_radix(sum, 16).ok()?;
        is_below(name).then(|| (name.to_owned(), sum))
    };
    text.lines().filter_map(line).collect()
}

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(folder: &Path, names: &[&str]) -> usize {
        let mut output = OutputFolder::new(folder);
        for name in names {
            output.write(name, name.as_bytes()).unwrap();
        }
        output.finish().unwrap().len()
    }

    #[test]
    fn only_unchanged_files_of_the_run_before_are_removed() {
        let folder = std::env::temp_dir().join(format!("epipole-again-{}", std::process::id()));
        let at = |name: &str| folder.join(name);
        assert_eq!(
            written(&folder, &["a.txt", "two/b.txt", "two/c.txt", "three/d"]),
            0
        );
        fs::write(at("notes.txt"), "mine").unwrap();
        fs::write(at("two/c.txt"), "changed").unwrap();
        assert_eq!(written(&folder, &["a.txt", "e.txt"]), 2);
        assert!(at("a.txt").exists() && at("e.txt").exists() && at("notes.txt").exists());
        assert!(!at("two/b.txt").exists() && at("two/c.txt").exists() && !at("three").exists());
        // What was left is nobody's from now on.
        assert_eq!(written(&folder, &["a.txt", "e.txt"]), 0);
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(
            parse("00ff a b\n1 ../c\n1 /d\nx e\n"),
            [("a b".to_owned(), 255)]
        );
    }
}
