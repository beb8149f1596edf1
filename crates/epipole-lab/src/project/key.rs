//! Names of results: a hash of everything that they depend on.

use super::bytes::to_bytes;
use serde::Serialize;
use std::hash::{DefaultHasher, Hasher};

/// The name of a result. Equal inputs have equal names, on every machine and in each run of the
/// same program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key(pub u64);

impl Key {
    /// The name of what depends on this.
    pub(crate) fn of<T: Serialize>(inputs: &T) -> Self {
        let mut hasher = DefaultHasher::new();
        hasher.write(&to_bytes(inputs));
        Self(hasher.finish())
    }

    /// The name of a file's bytes.
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
