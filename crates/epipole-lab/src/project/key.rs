//! Keys of results: a hash of everything that a result depends on.

use super::bytes::to_bytes;
use serde::Serialize;
use std::hash::{DefaultHasher, Hasher};

/// Key of a result. Equal inputs have equal keys, on every machine and in each run of the same
/// program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key(pub u64);

impl Key {
    /// Hashes the inputs of a result.
    pub(crate) fn of<T: Serialize>(inputs: &T) -> Self {
        let mut hasher = DefaultHasher::new();
        hasher.write(&to_bytes(inputs));
        Self(hasher.finish())
    }

    /// Hashes the bytes of a file.
    pub(crate) fn of_bytes(bytes: &[u8]) -> Self {
        let mut hasher = DefaultHasher::new();
        hasher.write(bytes);
        hasher.write_u64(bytes.len() as u64);
        Self(hasher.finish())
    }
}

impl std::fmt::Display for Key {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}
