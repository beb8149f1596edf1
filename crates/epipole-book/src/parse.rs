//! Chapters to data: Markdown, directives, and the place that each word came from.

pub(crate) mod events;
pub(crate) mod include;
pub(crate) mod outline;
pub mod rhythm;
pub mod source;
pub(crate) mod stand_ins;
pub mod syntax;
