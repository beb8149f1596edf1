//! `slides/<chapter>.html`: a reveal.js slide deck for each numbered chapter.

mod arrange;
mod questions;
mod slide;

use crate::edition::filled;
use crate::render::page::Page;
use crate::write::assets::Assets;
use crate::write::policy::CONTENT_SECURITY_POLICY;
use anyhow::Result;
use mdbook_driver::config::Config;
use serde::Serialize;
use slide::Stack;
use std::collections::BTreeMap;
use std::path::Path;

#[derive(Serialize)]
struct Data<'a> {
    language: &'a str,
    policy: &'a str,
    book_title: &'a str,
    title: &'a str,
    number: &'a str,
    /// Path from the deck to the chapter.
    chapter: String,
    stacks: Vec<Stack>,
    assets: &'a Assets,
}

/// Adds the decks, made with `web/slides/deck.hbs`.
///
/// # Errors
/// An unreadable template.
pub(crate) fn add(
    files: &mut BTreeMap<String, Vec<u8>>,
    project: &Path,
    config: &Config,
    assets: &Assets,
    pages: &[Page],
) -> Result<()> {
    let template = project.join("web/slides/deck.hbs");
    for page in pages {
        let Some(path) = page.deck() else {
            continue;
        };
        let data = Data {
            language: config.book.language.as_deref().unwrap_or("en"),
            policy: CONTENT_SECURITY_POLICY,
            book_title: config.book.title.as_deref().unwrap_or("Book"),
            title: &page.title,
            number: page.number.as_deref().unwrap_or_default(),
            chapter: format!("../{}", page.path),
            stacks: arrange::stacks(&page.html, &page.path),
            assets,
        };
        files.insert(path, filled(&template, &data)?.into_bytes());
    }
    Ok(())
}
