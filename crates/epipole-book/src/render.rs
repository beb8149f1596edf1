//! Rendering of pages: HTML, MathML, listings, notebooks, panels.

mod blocks;
pub(crate) mod chapter;
pub(crate) mod code;
pub(crate) mod directive;
pub mod highlight;
pub(crate) mod insert;
pub(crate) mod join;
pub(crate) mod links;
pub(crate) mod listing;
mod markdown;
pub mod math;
pub mod notebook;
pub mod page;
pub(crate) mod panels;
pub(crate) mod pictures;
mod progress;
mod reading_time;
pub(crate) mod symbols;
mod tables;
pub(crate) mod terms;
pub(crate) mod tokens;
mod words;
pub(crate) mod writer;
