//! The book builder: chapters in Markdown to a static site.
//!
//! Stages run one way: [`parse`] reads chapters to data, [`resolve`] asks the core for what they
//! show, [`render`] makes pages, [`write`](mod@write) makes the site. Each directive of the
//! authors' notation is a file in `directives`, which uses the first three. [`site`] runs the
//! stages, [`serve`] shows the result while chapters are edited.
//!
//! Problems in the content are reported together, with file and line, and fail the build.

mod directives;
mod hash;
pub mod html;
mod parallel;
pub mod parse;
pub mod phases;
pub mod problems;
pub mod render;
pub mod resolve;
pub mod serve;
pub mod site;
mod tools;
pub mod write;
