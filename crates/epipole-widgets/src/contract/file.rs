//! Files that a figure offers for download, besides its picture.

use serde::Serialize;

/// A file that a figure offers, such as a point cloud for other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct FileOffer {
    /// Label of the button.
    pub label: &'static str,
    /// Contents of the file and its use, as a tooltip.
    pub hint: &'static str,
    /// Extension of the file name, without the dot.
    pub extension: &'static str,
    /// Whether the file can be saved now.
    pub is_ready: bool,
}
