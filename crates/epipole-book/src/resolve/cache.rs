//! Cache of posters and snapshots of figures between builds.

use crate::hash::fnv;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Hash of the sources that draw figures; entries with another hash are drawn again.
const DRAWN_BY: &str = env!("EPIPOLE_BOOK_DRAWN_BY");

/// A folder of results, each named by a hash of all its inputs.
#[derive(Debug, Clone)]
pub(crate) struct Cache(PathBuf);

impl Cache {
    /// Opens the cache in an existing folder.
    pub(crate) fn new(folder: &Path) -> Cache {
        Cache(folder.to_path_buf())
    }

    /// Returns the cached data of a figure in a state, or calls `make` and caches the result.
    ///
    /// # Errors
    /// Those of `make`.
    pub(crate) fn get_or<T>(
        &self,
        (name, settings, what): (&str, &[(String, String)], &str),
        read: impl FnOnce(&[u8]) -> Option<T>,
        make: impl FnOnce() -> Result<(T, Vec<u8>), String>,
    ) -> Result<T, String> {
        let key = fnv(format!("{DRAWN_BY}{name}{settings:?}{what}").as_bytes());
        let file = self.0.join(format!("{name}-{key:016x}"));
        let cached = fs::read(&file).ok();
        if let Some(cached) = cached.and_then(|bytes| read(&bytes)) {
            return Ok(cached);
        }
        let (made, bytes) = make()?;
        // A failure to write the cache only costs time.
        let part = file.with_extension(part_name());
        let _ = fs::write(&part, bytes).and_then(|()| fs::rename(&part, &file));
        Ok(made)
    }
}

/// Returns a unique extension for each file being written, as two threads may write the same.
fn part_name() -> String {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    format!("{}-{count}.part", std::process::id())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_cached_under_their_key() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path());
        let settings = [("size".to_owned(), "2".to_owned())];
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).ok();
        let make = |word: &str| Ok((word.to_owned(), word.as_bytes().to_vec()));
        let nothing = || Err("nothing".to_owned());
        let key = ("dot", &settings[..], "facts");
        assert_eq!(cache.get_or(key, text, || make("made")).unwrap(), "made");
        assert_eq!(cache.get_or(key, text, nothing).unwrap(), "made");
        assert!(cache.get_or(("dot", &[], "facts"), text, nothing).is_err());
        assert!(
            cache
                .get_or(("dot", &settings, "360"), text, nothing)
                .is_err()
        );
        // An unreadable entry is computed again.
        assert!(cache.get_or(key, |_| None, nothing).is_err());
    }
}
