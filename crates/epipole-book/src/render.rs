//! Data to pages: HTML, MathML, listings, notebooks, panels.

pub mod highlight;
pub(crate) mod links;
pub(crate) mod listing;
pub(crate) mod markdown;
pub mod math;
pub mod notebook;
pub mod page;
pub(crate) mod panels;
pub(crate) mod progress;
pub(crate) mod symbols;
