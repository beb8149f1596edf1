//! Reading of the book up to cross-linked pages, shared by all editions.

use crate::directives::VOCABULARY;
use crate::parallel;
use crate::parse::book::{self, Chapter, Entry};
use crate::parse::content::Content;
use crate::phases::Phases;
use crate::problems::{Problem, Problems};
use crate::render::chapter::Draft;
use crate::render::join;
use crate::render::page::Page;
use crate::resolve::book::Book;
use crate::resolve::cache::Cache;
use crate::resolve::figures::Gallery;
use crate::resolve::posters::Medium;
use crate::tools::target_folder;
use anyhow::{Context, Result};
use mdbook_driver::config::Config;
use std::path::Path;

/// Outcome of a build.
#[derive(Debug)]
pub enum Outcome {
    /// The site is written.
    Built {
        /// Number of pages.
        pages: usize,
        /// Number of files, including compressed ones.
        files: usize,
    },
    /// The content has problems; nothing was written.
    Problems(Vec<Problem>),
}

/// A book to be built.
pub(crate) struct Reading<'a> {
    project: &'a Path,
    gallery: &'a dyn Gallery,
    medium: Option<Medium>,
    phases: &'a Phases,
}

/// Cross-linked pages of a book without problems.
pub(crate) struct Joined<'a> {
    pub(crate) config: Config,
    pub(crate) contents: Vec<Entry>,
    pub(crate) pages: Vec<Page>,
    pub(crate) content: &'a Content,
    pub(crate) book: &'a Book<'a>,
}

impl<'a> Reading<'a> {
    /// * `project`: the folder with `content/`
    /// * `medium`: medium of the posters; without one, none are drawn
    pub(crate) fn new(
        project: &'a Path,
        gallery: &'a dyn Gallery,
        medium: Option<Medium>,
        phases: &'a Phases,
    ) -> Self {
        Reading {
            project,
            gallery,
            medium,
            phases,
        }
    }

    /// Reads, resolves, renders and joins all chapters, and passes them on unless the content has
    /// problems.
    ///
    /// * `panels`: makes the panels of the figures, for all pages in their order
    ///
    /// # Errors
    /// A missing tool or an unreadable folder.
    pub(crate) fn joined(
        &self,
        panels: impl FnOnce(&[Page]) -> Result<Vec<String>>,
        then: impl FnOnce(Joined) -> Result<Outcome>,
    ) -> Result<Outcome> {
        let phases = self.phases;
        let content = Content::new(&self.project.join("content"));
        let problems = Problems::default();
        let read = phases.run("read chapters", 0, |_| book::read(&content, &problems))?;
        let Some(manuscript) = read else {
            return Ok(Outcome::Problems(problems.sorted()));
        };
        let cache = cache(self.project)?;
        let book = Book::new(&content, self.gallery, cache, self.medium, &problems);
        let mut pages = pages(manuscript.chapters, &content, &book, phases);
        let panels = panels(&pages)?;
        phases.run("check links", 0, |_| {
            join::join(&mut pages, &panels, &problems);
            join::check(&pages, &content, &problems);
        });
        if !problems.sorted().is_empty() {
            return Ok(Outcome::Problems(problems.sorted()));
        }
        then(Joined {
            config: manuscript.config,
            contents: manuscript.contents,
            pages,
            content: &content,
            book: &book,
        })
    }
}

/// Opens the cache of posters and snapshots.
///
/// # Errors
/// A folder that cannot be created.
fn cache(project: &Path) -> Result<Cache> {
    let folder = target_folder(project).join("book-work/posters");
    std::fs::create_dir_all(&folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    Ok(Cache::new(&folder))
}

/// Parses, resolves and renders all chapters.
fn pages(chapters: Vec<Chapter>, content: &Content, book: &Book, phases: &Phases) -> Vec<Page> {
    let (count, problems) = (chapters.len(), book.problems);
    let parsed: Vec<_> = phases.run("parse chapters", 0, |_| {
        let chapters = chapters.into_iter();
        chapters
            .map(|chapter| Draft::parse(chapter, VOCABULARY, content, problems))
            .collect()
    });
    let resolved: Vec<_> = phases.run("ask figures and draw posters", count, |steps| {
        parallel::map(parsed, |draft| {
            let resolved = draft.resolve(book);
            steps.done();
            resolved
        })
    });
    phases.run("render pages", 0, |_| {
        let pages = resolved.into_iter().map(|draft| draft.render(problems));
        let mut pages: Vec<Page> = pages.collect();
        let parts = pages.iter_mut().map(|page| std::mem::take(&mut page.parts));
        let parts: Vec<Vec<Page>> = parts.collect();
        pages.extend(parts.into_iter().flatten());
        pages
    })
}
