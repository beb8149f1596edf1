//! The book builder: chapters in Markdown to a static site.
//!
//! mdBook reads `content/` ([`site`]); this crate renders it: live figures with posters drawn at
//! build time ([`figures`]), formulas as MathML ([`math`]), numbers computed by the core
//! ([`numbers`]), citations ([`references`]), quizzes ([`quiz`]) and checked links ([`links`]). The
//! authors' notation is in [`directives`] and its vocabulary in `expand.rs`. [`assets`] makes what
//! the browser downloads beside the pages; [`serve`] shows the result while one writes.
//!
//! Whatever is wrong in the content is reported with file and line, all of it at once, and the
//! build fails.

pub mod assets;
mod blocks;
pub mod claims;
pub mod compress;
pub mod directives;
mod events;
mod expand;
pub mod facts;
pub mod figures;
mod frames;
mod gallery;
pub mod highlight;
pub mod html;
mod include;
mod instances;
mod links;
mod listing;
mod markdown;
pub mod math;
pub mod notebook;
pub mod numbers;
mod operate;
pub mod page;
mod panels;
mod posters;
pub mod problems;
mod progress;
pub mod quiz;
pub mod references;
pub mod rhythm;
pub mod serve;
mod shared;
pub mod site;
mod small;
pub mod source;
mod stand_ins;
pub mod stills;
mod symbols;
pub mod template;
