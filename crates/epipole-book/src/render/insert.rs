//! The HTML that takes a directive's place in its text.

use super::writer::Writer;
use crate::html::escape;
use crate::parse::placeholders::{Part, parts};
use crate::problems::Place;

/// Rendered form of a directive.
pub(crate) enum Insert {
    /// A printed number.
    Value(String),
    /// Something inside a paragraph, and its words for the search.
    Inline { html: String, text: String },
    /// Something that is a paragraph of its own.
    Block { html: String },
    /// The opening of a block that extends to its end, likewise a paragraph of its own.
    Opening(Box<dyn Block>),
}

/// A block of words and fences between two directives.
pub(crate) trait Block {
    /// The paragraph that ends it.
    fn end(&self) -> &'static str;

    /// Returns the HTML. `words` come before the fences.
    fn render(&self, page: &mut Writer, words: Words, fences: &[Fence], place: &Place) -> String;
}

/// The words of a block.
#[derive(Default)]
pub(crate) struct Words {
    pub(crate) html: String,
    pub(crate) markdown: String,
}

/// A fence inside a block.
pub(crate) struct Fence {
    pub(crate) language: String,
    /// The word behind the language.
    pub(crate) word: String,
    pub(crate) code: String,
    /// The line of the fence itself.
    pub(crate) place: Place,
}

impl Insert {
    /// Nothing at all.
    pub(crate) fn nothing() -> Insert {
        Insert::inline(String::new())
    }

    /// Something inside a paragraph without words of its own.
    pub(crate) fn inline(html: String) -> Insert {
        let text = String::new();
        Insert::Inline { html, text }
    }

    /// As plain text, or LaTeX.
    pub(crate) fn text(&self) -> String {
        match self {
            Insert::Value(text) | Insert::Inline { text, .. } => text.clone(),
            Insert::Block { .. } | Insert::Opening(_) => String::new(),
        }
    }

    /// As HTML. A number gets a real minus sign.
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
