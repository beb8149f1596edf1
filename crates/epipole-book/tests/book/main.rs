//! Small books in temporary folders: what comes out, and what each mistake says.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod epub;
mod figures;
mod listings;
mod mistakes;
mod pages;
mod prose;
mod site;
mod tiny;
