//! A rendered page and its requirements on other pages, the content folder and the site.

use super::notebook::Cell;
use crate::problems::Place;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// A heading of a page.
#[derive(Debug, Clone)]
pub struct Heading {
    /// Level, 1 to 6.
    pub level: u8,
    /// Its anchor.
    pub id: String,
    /// Plain text.
    pub title: String,
    /// Its HTML, without the heading tags.
    pub html: String,
}

/// A figure of a page.
#[derive(Debug, Clone)]
pub struct FigureEntry {
    /// Name, such as `ransac-race`.
    pub name: String,
    /// Its permanent anchor.
    pub id: String,
    /// Number, such as `4.1`.
    pub number: String,
    /// Path of its light poster at column width, in the site.
    pub poster: String,
    /// Description of its initial state.
    pub description: String,
    /// Location in the chapter.
    pub place: Place,
}

/// An internal link, to be checked when all pages are known.
#[derive(Debug, Clone)]
pub struct Link {
    /// Path of the page, such as `ransac.html`.
    pub page: String,
    /// Fragment, without `#`.
    pub fragment: Option<String>,
    /// The link as written by the author.
    pub written: String,
    /// Location in the chapter.
    pub place: Place,
}

/// A section of a page in the search index.
#[derive(Debug, Clone, Deserialize, Serialize)]
pub struct Section {
    /// Path and anchor.
    #[serde(rename = "u")]
    pub url: String,
    /// Title of the chapter.
    #[serde(rename = "c")]
    pub chapter: String,
    /// Title of the section.
    #[serde(rename = "t")]
    pub title: String,
    /// Plain text.
    #[serde(rename = "w")]
    pub words: String,
}

/// A quiz of a page.
#[derive(Debug, Clone)]
pub struct QuizEntry {
    /// Its file, without `.toml`.
    pub name: String,
    /// Its questions.
    pub questions: Vec<Solvable>,
}

/// A question or a task.
#[derive(Debug, Clone)]
pub struct Solvable {
    /// Its anchor.
    pub id: String,
    /// Hash of its wording: solutions of other wordings do not count.
    pub hash: String,
}

/// Input of `web/prerender.mjs` for one figure.
#[derive(Debug, Clone, Serialize)]
pub struct PanelRequest {
    /// The figure.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Help for the reader.
    pub help: String,
    /// Snapshot of its texts, numbers and controls.
    pub snapshot: serde_json::Value,
    /// Attributes of the element.
    pub attributes: BTreeMap<String, String>,
    /// Width and height of its posters, CSS pixels.
    pub sizes: Vec<(u32, f64)>,
}

/// A file of the content folder to copy to the same path of the site.
#[derive(Debug, Clone)]
pub struct WantedFile {
    /// Path in the content folder.
    pub path: String,
    /// Location in the chapter.
    pub place: Place,
    /// Error message if the file does not exist.
    pub missing: String,
}

/// A page of the book.
#[derive(Debug, Clone, Default)]
pub struct Page {
    /// Path in the site, such as `epipolar.html`.
    pub path: String,
    /// Name of the chapter in `SUMMARY.md`.
    pub title: String,
    /// Number of the chapter, such as `4`.
    pub number: Option<String>,
    /// Path of the page that it belongs to, if the contents do not list it.
    pub parent: Option<String>,
    /// The body.
    pub html: String,
    /// First paragraph as plain text, for search engines.
    pub description: String,
    /// Estimated reading time of a chapter, minutes.
    pub reading_time_min: Option<usize>,
    /// All headings.
    pub headings: Vec<Heading>,
    /// All figures.
    pub figures: Vec<FigureEntry>,
    /// Links into the book.
    pub links: Vec<Link>,
    /// Sections in the search index.
    pub sections: Vec<Section>,
    /// Names of listings and tasks.
    pub listings: Vec<String>,
    /// Whether readers can run JavaScript in it.
    pub has_programs: bool,
    /// Tasks that are solved in the page.
    pub tasks: Vec<Solvable>,
    /// Cells of the chapter's notebook.
    pub cells: Vec<Cell>,
    /// Symbols of the chapter that its figures also draw.
    pub symbols: Vec<String>,
    /// Whether it contains the list of references.
    pub has_references: bool,
    /// Quizzes.
    pub quizzes: Vec<QuizEntry>,
    /// Visible goals of its figures, each `figure/goal`.
    pub goals: BTreeSet<String>,
    /// Figures that it refers to, with the locations.
    pub wanted_figures: Vec<(String, Place)>,
    /// Terms that it uses, with the locations.
    pub terms: Vec<(String, Place)>,
    /// Terms that it defines, with the locations.
    pub definitions: Vec<(String, Place)>,
    /// Terms of the glossary with their locations in its file, if the page contains it.
    pub glossary: Option<Vec<(String, Place)>>,
    /// Location of the first citation.
    pub cites: Option<Place>,
    /// Panels of its figures.
    pub panels: Vec<PanelRequest>,
    /// Files generated for it, by their path in the site.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Files that it links to or displays.
    pub wanted_files: Vec<WantedFile>,
    /// Subpages; empty once all pages are rendered.
    pub parts: Vec<Page>,
    /// Text of the section being rendered.
    pub(crate) words: String,
}

impl Page {
    /// Returns the number of the next figure: `4.1` in a numbered chapter, else `1`.
    pub(crate) fn next_figure_number(&self) -> String {
        let count = self.figures.len() + 1;
        match &self.number {
            Some(number) => format!("{number}.{count}"),
            None => count.to_string(),
        }
    }

    /// Returns the path of its slides from the root of the site; only numbered chapters have
    /// slides.
    pub(crate) fn deck(&self) -> Option<String> {
        let name = self.path.trim_end_matches(".html").replace('/', "-");
        self.number.as_ref().map(|_| format!("slides/{name}.html"))
    }

    /// Returns its goals, separated by spaces, for an attribute.
    pub(crate) fn goal_list(&self) -> String {
        let goals: Vec<&str> = self.goals.iter().map(String::as_str).collect();
        goals.join(" ")
    }

    /// Returns an attribute of the last figure's picture: the first of a page may be visible at
    /// once, the others load lazily.
    pub(crate) fn loading_of_last_figure(&self) -> &'static str {
        match self.figures.len() {
            1 => "fetchpriority=\"high\"",
            _ => "loading=\"lazy\"",
        }
    }

    /// Sets the description, unless the page has one already.
    pub(crate) fn describe(&mut self, words: impl FnOnce() -> String) {
        if self.description.is_empty() {
            self.description = shorten(&words(), 160);
        }
    }

    /// Ends a section of the search index and starts the next.
    pub(crate) fn start_section(&mut self, id: &str, title: &str) {
        self.end_section();
        let url = format!("{}#{id}", self.path);
        let (chapter, title) = (self.title.clone(), title.to_owned());
        self.sections.push(Section {
            url,
            chapter,
            title,
            words: String::new(),
        });
    }

    /// Ends the last section.
    pub(crate) fn end_section(&mut self) {
        let words = std::mem::take(&mut self.words);
        if let Some(section) = self.sections.last_mut() {
            section.words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        }
    }
}

/// Shortens a text to at most `limit` characters, cut between words.
fn shorten(words: &str, limit: usize) -> String {
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    if words.chars().count() <= limit {
        return words;
    }
    let mut short: String = words.chars().take(limit - 1).collect();
    if let Some(space) = short.rfind(' ') {
        short.truncate(space);
    }
    short.push('…');
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn descriptions_end_between_words() {
        assert_eq!(shorten("one  two", 20), "one two");
        assert_eq!(shorten("one two three", 10), "one two…");
    }

    #[test]
    fn figures_are_numbered_in_their_chapter() {
        let page = Page {
            number: Some("4".to_owned()),
            ..Page::default()
        };
        assert_eq!(page.next_figure_number(), "4.1");
        assert_eq!(Page::default().next_figure_number(), "1");
    }
}
