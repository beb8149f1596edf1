//! The HTML that replaces a directive.

use super::writer::Writer;
use crate::html::escape;
use crate::parse::placeholders::{Part, parts};
use crate::problems::Place;

/// Rendered form of a directive.
pub(crate) enum Insert {
    /// A printed number.
    Value(String),
    /// Inline content, with its text for the search index.
    Inline { html: String, text: String },
    /// Content that forms its own paragraph.
    Block { html: String },
    /// The opening of a block, which forms its own paragraph.
    Opening(Box<dyn Block>),
}

/// A block of text and fences between two directives.
pub(crate) trait Block {
    /// Content of the paragraph that ends it.
    fn end(&self) -> &'static str;

    /// Renders the block. `words` come before the fences.
    fn render(&self, page: &mut Writer, words: Words, fences: &[Fence], place: &Place) -> String;
}

/// Text of a block.
#[derive(Default)]
pub(crate) struct Words {
    pub(crate) html: String,
    pub(crate) markdown: String,
}

/// A fence inside a block.
pub(crate) struct Fence {
    pub(crate) language: String,
    /// The word after the language.
    pub(crate) word: String,
    pub(crate) code: String,
    /// First line of the fence.
    pub(crate) place: Place,
}

impl Insert {
    /// Creates an empty insert.
    pub(crate) fn nothing() -> Insert {
        Insert::inline(String::new())
    }

    /// Creates an inline insert without text for the search index.
    pub(crate) fn inline(html: String) -> Insert {
        let text = String::new();
        Insert::Inline { html, text }
    }

    /// Returns the insert as plain text or LaTeX.
    pub(crate) fn text(&self) -> String {
        match self {
            Insert::Value(text) | Insert::Inline { text, .. } => text.clone(),
            Insert::Block { .. } | Insert::Opening(_) => String::new(),
        }
    }

    /// Returns the insert as HTML. Numbers get a real minus sign.
    pub(crate) fn html(&self) -> String {
        match self {
            Insert::Value(text) => {
                let shown = text
                    .strip_prefix('-')
                    .map_or(text.clone(), |rest| format!("−{rest}"));
                format!("<span class=\"value\">{}</span>", escape(&shown))
            }
            Insert::Inline { html, .. } | Insert::Block { html } => html.clone(),
            Insert::Opening(_) => String::new(),
        }
    }
}

/// Replaces the placeholders of a text by the inserts, each rendered by `form`.
pub(crate) fn substitute(words: &str, inserts: &[Insert], form: fn(&Insert) -> String) -> String {
    let mut text = String::new();
    for part in parts(words) {
        match part {
            Part::Words(words) => text.push_str(words),
            Part::Insert(index) => text.push_str(&inserts.get(index).map(form).unwrap_or_default()),
        }
    }
    text
}
