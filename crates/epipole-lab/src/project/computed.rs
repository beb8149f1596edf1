//! Precomputed results in the file of a project or of the sample.

use super::bytes::{Blob, to_bytes};
use serde::{Deserialize, Serialize};

/// Hash of the code that computes results; results of other code are rejected.
pub const COMPUTED_BY: &str = env!("EPIPOLE_LAB_COMPUTED_BY");

/// Results by key, with the version of the code that computed them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Computed {
    /// [`COMPUTED_BY`] of the build that computed them.
    pub by: String,
    /// Keys and serialized outputs.
    pub results: Vec<(u64, Blob)>,
}

impl Computed {
    /// Serializes the results.
    pub fn to_bytes(&self) -> Vec<u8> {
        to_bytes(self)
    }

    /// Parses the bytes; empty if they are invalid.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        postcard::from_bytes(bytes).unwrap_or_default()
    }
}
