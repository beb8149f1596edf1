//! Parsing of chapters: Markdown, directives, and the file and line of each word.

pub(crate) mod book;
pub(crate) mod content;
pub(crate) mod events;
mod include;
pub(crate) mod outline;
pub(crate) mod placeholders;
pub mod source;
pub mod stretches;
pub mod syntax;
pub(crate) mod text;
