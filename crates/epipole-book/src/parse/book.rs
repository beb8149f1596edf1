//! Settings, table of contents and chapters of the book, in mdBook's format.

use super::content::Content;
use super::include::include;
use super::source::Source;
use crate::problems::Problems;
use anyhow::{Context, Result};
use mdbook_driver::MDBook;
use mdbook_driver::book::{Book, BookItem, Chapter as BookChapter};
use mdbook_driver::config::Config;
use pulldown_cmark::{Event, Parser, Tag};
use std::path::Path;

/// The parsed `book.toml` and `SUMMARY.md`, and the chapters.
pub(crate) struct Manuscript {
    pub(crate) config: Config,
    pub(crate) contents: Vec<Entry>,
    pub(crate) chapters: Vec<Chapter>,
}

/// A line of the table of contents.
#[derive(Debug, Clone)]
pub(crate) enum Entry {
    Part(String),
    Separator,
    Chapter {
        number: Option<String>,
        title: String,
        /// Path of the page; `None` for a draft.
        path: Option<String>,
    },
}

/// A chapter with its includes expanded.
#[derive(Debug)]
pub(crate) struct Chapter {
    /// Path of the page, such as `part/ransac.html`.
    pub(crate) path: String,
    pub(crate) title: String,
    /// Number, such as `4`.
    pub(crate) number: Option<String>,
    pub(crate) source: Source,
}

/// Reads the book. `None` if the table of contents has problems, which are reported.
///
/// # Errors
/// Unreadable settings or chapters.
pub(crate) fn read(content: &Content, problems: &Problems) -> Result<Option<Manuscript>> {
    check_contents(content, problems);
    if !problems.sorted().is_empty() {
        return Ok(None);
    }
    let file = content.path("book.toml");
    let mut config =
        Config::from_disk(&file).with_context(|| format!("{} cannot be read", file.display()))?;
    config.book.src = ".".into();
    config.build.create_missing = false;
    config.build.use_default_preprocessors = false;
    let MDBook { book, config, .. } = MDBook::load_with_config(content.folder(), config)?;
    let first = first_chapter(&config);
    let chapters = book.chapters();
    let chapters = chapters
        .map(|read| chapter(read, first, content, problems))
        .collect();
    Ok(Some(Manuscript {
        contents: entries(&book, first),
        config,
        chapters,
    }))
}

fn chapter(read: &BookChapter, first: u32, content: &Content, problems: &Problems) -> Chapter {
    let file = read.path.as_deref().unwrap_or(Path::new(""));
    let file = file.to_string_lossy().replace('\\', "/");
    let source = Source::new(read.content.clone(), content.place(&file, 1));
    let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
    Chapter {
        path: html_path(&file),
        title: read.name.clone(),
        number: number(read, first),
        source: include(&source, folder, content, problems),
    }
}

fn entries(book: &Book, first: u32) -> Vec<Entry> {
    let entry = |item: &BookItem| match item {
        BookItem::Separator => Entry::Separator,
        BookItem::PartTitle(title) => Entry::Part(title.clone()),
        BookItem::Chapter(chapter) => {
            let path = chapter.path.as_ref();
            Entry::Chapter {
                number: number(chapter, first),
                title: chapter.name.clone(),
                path: path.map(|path| html_path(&path.to_string_lossy())),
            }
        }
    };
    book.iter().map(entry).collect()
}

fn html_path(file: &str) -> String {
    format!("{}.html", file.strip_suffix(".md").unwrap_or(file))
}

/// Returns the number of the first numbered chapter, `[output.epipole] first-chapter` in
/// `book.toml`.
fn first_chapter(config: &Config) -> u32 {
    let written = config.get::<u32>("output.epipole.first-chapter");
    written.ok().flatten().unwrap_or(1)
}

fn number(chapter: &BookChapter, first: u32) -> Option<String> {
    let numbers = chapter.number.as_ref()?.iter().enumerate();
    let shifted = numbers.map(|(level, &number)| match level {
        0 => (number + first).saturating_sub(1).to_string(),
        _ => number.to_string(),
    });
    Some(shifted.collect::<Vec<_>>().join("."))
}

/// Reports missing chapters of `SUMMARY.md`, by line.
fn check_contents(content: &Content, problems: &Problems) {
    let Some(source) = content.read("SUMMARY.md") else {
        let place = content.place("SUMMARY.md", 1);
        problems.report(place, "there is no table of contents");
        return;
    };
    for (event, range) in Parser::new(source.text()).into_offset_iter() {
        if let Event::Start(Tag::Link { dest_url, .. }) = event
            && !dest_url.is_empty()
            && !content.path(&dest_url).is_file()
        {
            let message = format!("there is no chapter {dest_url} (a draft has empty parentheses)");
            problems.report(source.place(range.start), message);
        }
    }
}
