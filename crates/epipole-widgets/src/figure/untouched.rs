//! State of a figure before the reader moves a handle.

use crate::contract::Handle;

/// State of a figure before the reader moves a handle.
pub(super) struct Untouched {
    /// Visible controls that differ from the default state.
    pub(super) controls: Vec<(String, String)>,
    pub(super) handles: Vec<Handle>,
}
