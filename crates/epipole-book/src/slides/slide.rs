//! A slide and a stack of slides, for the template.

use serde::Serialize;

/// Main content of a slide, which determines its layout.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Words,
    Formula,
    Figure,
    Table,
    List,
    Question,
}

/// A slide, in HTML.
#[derive(Debug, Serialize)]
pub(super) struct Slide {
    pub(super) kind: Kind,
    pub(super) heading: String,
    pub(super) body: String,
    /// Buttons that operate the figure.
    pub(super) actions: String,
    pub(super) notes: String,
}

/// The slides of a section.
#[derive(Debug, Default, Serialize)]
pub(super) struct Stack {
    pub(super) slides: Vec<Slide>,
}
