//! What a reader can keep of a figure besides its picture.

use serde::Serialize;

/// A file that a figure offers, such as a cloud of points for other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct FileOffer {
    /// The words on the button.
    pub label: &'static str,
    /// What will be in the file, and for whom.
    pub hint: &'static str,
    /// How its name ends, without the dot.
    pub extension: &'static str,
    /// Whether there is something to save already.
    pub is_ready: bool,
}
