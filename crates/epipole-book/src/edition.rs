//! The book without scripts, for paper and e-readers: without controls, with all answers at the
//! end.

mod answers;
mod arrange;
mod captions;
mod contents;
pub(crate) mod sentence;
pub(crate) mod tree;

pub(crate) use answers::AnswerLinks;
pub(crate) use contents::{Part, parts};

use crate::parse::book::Entry;
use crate::phases::Phases;
use crate::reading::{Joined, Outcome, Reading};
use crate::render::page::Page;
use crate::resolve::figures::Gallery;
use crate::resolve::posters::Medium;
use crate::tools::read;
use crate::write::address::address;
use crate::write::page_files;
use anyhow::{Context, Result};
use handlebars::Handlebars;
use mdbook_driver::config::Config;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Key of the Markdown files whose pages need scripts.
const NOT_PRINTED: &str = "output.epipole.not-printed";

/// Options of an edition.
#[derive(Debug, Clone)]
pub struct EditionOptions {
    /// The folder with `content/`, `web/` and `crates/`.
    pub project: PathBuf,
    /// Output folder; for an edition in one file, that file.
    pub out: PathBuf,
    /// Address of the published book, for links to its figures; `None` for that of `book.toml`.
    pub address: Option<String>,
}

/// An edition to write.
pub(crate) struct Edition {
    pub(crate) config: Config,
    pub(crate) contents: Vec<Entry>,
    /// Pages; the last one may contain the answers.
    pub(crate) pages: Vec<Page>,
    /// Pictures and other files of the pages.
    pub(crate) files: BTreeMap<String, Vec<u8>>,
    /// Address of the published book, with a trailing slash.
    pub(crate) address: Option<String>,
}

impl Edition {
    pub(crate) fn title(&self) -> &str {
        self.config.book.title.as_deref().unwrap_or("Book")
    }

    pub(crate) fn language(&self) -> &str {
        self.config.book.language.as_deref().unwrap_or("en")
    }
}

/// Reads and arranges the book, and passes it on unless the content has problems.
///
/// # Errors
/// A missing tool or an unreadable folder.
pub(crate) fn make(
    options: &EditionOptions,
    links: AnswerLinks,
    gallery: &dyn Gallery,
    phases: &Phases,
    write: impl FnOnce(Edition) -> Result<Outcome>,
) -> Result<Outcome> {
    let reading = Reading::new(&options.project, gallery, Some(Medium::Paper), phases);
    let no_panels = |_: &[Page]| Ok(Vec::new());
    reading.joined(no_panels, |joined| {
        let Joined {
            config,
            contents,
            mut pages,
            content,
            ..
        } = joined;
        let excluded: Vec<String> = config.get(NOT_PRINTED)?.unwrap_or_default();
        pages.retain(|page| {
            let listed = page.parent.as_ref().unwrap_or(&page.path);
            !excluded.contains(&listed.replace(".html", ".md"))
        });
        let files = page_files::files(&mut pages, content);
        let root = options.address.as_deref();
        let root = root.map(|address| format!("{}/", address.trim_end_matches('/')));
        let address = root.or_else(|| address(&config));
        phases.run("arrange pages", 0, |_| arrange::arrange(&mut pages, links));
        write(Edition {
            config,
            contents,
            pages,
            files,
            address,
        })
    })
}

/// Fills in a template.
///
/// # Errors
/// A template that is unreadable or names an unknown variable.
pub(crate) fn filled(file: &Path, data: &impl Serialize) -> Result<String> {
    let source =
        String::from_utf8(read(file)?).with_context(|| format!("{} is no text", file.display()))?;
    let mut handlebars = Handlebars::new();
    handlebars.set_strict_mode(true);
    (handlebars.render_template(&source, data))
        .with_context(|| format!("{} is not a template", file.display()))
}
