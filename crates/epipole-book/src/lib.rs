//! The book builder, from chapters in Markdown to a static site.
//!
//! Stages run one way: [`parse`] reads chapters, [`resolve`] asks the core for their numbers and
//! figures, [`render`] makes pages, [`write`](mod@write) makes the site. Each directive of the
//! authors' notation is a file in `directives`, which uses the first three. [`site`] runs the
//! stages, [`serve`] shows the result while chapters are edited. [`edition`] removes the scripts
//! from the pages, for paper ([`print`](mod@print)) and for e-readers ([`mod@epub`]).
//!
//! Problems in the content are reported together, with file and line, and fail the build.

mod directives;
pub mod edition;
pub mod epub;
mod hash;
pub mod html;
mod parallel;
pub mod parse;
pub mod phases;
pub mod print;
pub mod problems;
mod reading;
pub mod render;
pub mod resolve;
pub mod serve;
pub mod site;
mod slides;
mod tools;
pub mod write;
