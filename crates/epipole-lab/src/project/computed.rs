//! Results in a file: of a project, or of the sample.

use super::bytes::{Blob, to_bytes};
use serde::{Deserialize, Serialize};

/// Hash of the code that computes results; results of other code are rejected.
pub const COMPUTED_BY: &str = env!("EPIPOLE_LAB_COMPUTED_BY");

/// Results by key, and the code that computed them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Computed {
    /// [`COMPUTED_BY`] of the build that computed them.
    pub by: String,
    /// Keys, and bytes of outputs.
    pub results: Vec<(u64, Blob)>,
}

impl Computed {
    /// The same as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        to_bytes(self)
    }

    /// Parses the bytes; empty if they are invalid.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        postcard::from_bytes(bytes).unwrap_or_default()
    }
}
