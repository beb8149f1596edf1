//! A rendered page and its requirements on other pages, the content folder and the site.

use super::notebook::Cell;
use crate::problems::Place;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// A heading of a page.
#[derive(Debug, Clone)]
pub struct Heading {
    /// 1 to 6.
    pub level: u8,
    /// Its anchor.
    pub id: String,
    /// Its words.
    pub title: String,
    /// Its HTML, without the heading tags.
    pub html: String,
}

/// A figure of a page.
#[derive(Debug, Clone)]
pub struct FigureEntry {
    /// Such as `ransac-race`.
    pub name: String,
    /// Its permanent anchor.
    pub id: String,
    /// `4.1`.
    pub number: String,
    /// Path of its light poster for a column, in the site.
    pub poster: String,
    /// Description of its initial state.
    pub description: String,
    /// Location in the chapter.
    pub place: Place,
}

/// A link to another place of the book, to be checked when all pages are known.
#[derive(Debug, Clone)]
pub struct Link {
    /// Path of the page, such as `ransac.html`.
    pub page: String,
    /// Fragment, without `#`.
    pub fragment: Option<String>,
    /// As the author wrote it.
    pub written: String,
    /// Location in the chapter.
    pub place: Place,
}

/// A stretch of a page that the search can find.
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
    /// Its words.
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
    /// Hash of its wording: a solution of another wording does not count.
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

/// A file of the content folder, copied to the same path of the site.
#[derive(Debug, Clone)]
pub struct WantedFile {
    /// From the content folder.
    pub path: String,
    /// Location in the chapter.
    pub place: Place,
    /// The problem if there is no such file.
    pub missing: String,
}

/// A page of the book.
#[derive(Debug, Clone, Default)]
pub struct Page {
    /// Path in the site, such as `epipolar.html`.
    pub path: String,
    /// The chapter's name in `SUMMARY.md`.
    pub title: String,
    /// The chapter's number, such as `4`.
    pub number: Option<String>,
    /// Path of the page that it belongs to, if the contents do not list it.
    pub parent: Option<String>,
    /// The body.
    pub html: String,
    /// The first paragraph in plain words, for search engines.
    pub description: String,
    /// Estimate for a chapter; other pages have none.
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
    /// Whether it has JavaScript that readers run.
    pub has_programs: bool,
    /// Tasks that are solved in the page.
    pub tasks: Vec<Solvable>,
    /// Cells of the chapter's notebook.
    pub cells: Vec<Cell>,
    /// Letters that the chapter's figures also draw.
    pub symbols: Vec<String>,
    /// Whether the list of references is here.
    pub has_references: bool,
    /// Quizzes.
    pub quizzes: Vec<QuizEntry>,
    /// Goals of its figures that it shows, each `figure/goal`.
    pub goals: BTreeSet<String>,
    /// Figures that it refers to, and where.
    pub wanted_figures: Vec<(String, Place)>,
    /// Terms that it uses, and where.
    pub terms: Vec<(String, Place)>,
    /// Terms that it defines, and where.
    pub definitions: Vec<(String, Place)>,
    /// Terms of the glossary, if that is here, and their places in its file.
    pub glossary: Option<Vec<(String, Place)>>,
    /// Location of the first citation.
    pub cites: Option<Place>,
    /// Panels of its figures.
    pub panels: Vec<PanelRequest>,
    /// Files that were made for it, by their path in the site.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Files that it links to or shows.
    pub wanted_files: Vec<WantedFile>,
    /// Pages that belong to it; empty once all pages are rendered.
    pub parts: Vec<Page>,
    /// Words of the section that is being rendered.
    pub(crate) words: String,
}

impl Page {
    /// The number of the next figure: `4.1` in a numbered chapter, else `1`.
    pub(crate) fn next_figure_number(&self) -> String {
        let count = self.figures.len() + 1;
        match &self.number {
            Some(number) => format!("{number}.{count}"),
            None => count.to_string(),
        }
    }

    /// Path of its slides, from the root of the site; numbered chapters have some.
    pub(crate) fn deck(&self) -> Option<String> {
        let name = self.path.trim_end_matches(".html").replace('/', "-");
        self.number.as_ref().map(|_| format!("slides/{name}.html"))
    }

    /// Its goals between blanks, for an attribute.
    pub(crate) fn goal_list(&self) -> String {
        let goals: Vec<&str> = self.goals.iter().map(String::as_str).collect();
        goals.join(" ")
    }

    /// Attribute of the last figure's picture: the first of a page may be visible at once, the
    /// others load lazily.
    pub(crate) fn loading_of_last_figure(&self) -> &'static str {
        match self.figures.len() {
            1 => "fetchpriority=\"high\"",
            _ => "loading=\"lazy\"",
        }
    }

    /// Takes the first paragraph as the description.
    pub(crate) fn describe(&mut self, words: impl FnOnce() -> String) {
        if self.description.is_empty() {
            self.description = shorten(&words(), 160);
        }
    }

    /// Ends a section for the search and starts the next.
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

/// At most `limit` characters, cut between words.
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
