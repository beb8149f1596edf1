//! A chapter at each of its stages: parsed, resolved, rendered.

use super::directive::{Parsed, Parser, Resolved};
use super::notebook::{self, Cell, Tasks};
use super::page::Page;
use super::reading_time::{reading_time, reading_time_min};
use super::writer::Writer;
use crate::html::path_to_root;
use crate::parse::book::Chapter;
use crate::parse::content::Content;
use crate::parse::outline::Outline;
use crate::parse::text::{Entry, Text};
use crate::problems::{Place, Problems};
use crate::resolve::book::Book;

/// A chapter whose directives are at stage `D`.
pub(crate) struct Draft<D> {
    page: Page,
    text: Text<D>,
    /// Symbols of the chapter that its figures also draw.
    symbols: Vec<String>,
    /// First line.
    start: Place,
}

impl Draft<Parsed> {
    /// Parses a chapter. Problems are reported.
    pub(crate) fn parse(
        chapter: Chapter,
        vocabulary: &[Entry<Parsed>],
        content: &Content,
        problems: &Problems,
    ) -> Self {
        let outline = Outline::of(&chapter.source);
        let parser = Parser {
            content,
            problems,
            page: &chapter.path,
            outline: &outline,
            vocabulary,
        };
        let text = parser.text(&chapter.source);
        Draft {
            text,
            symbols: outline.symbols,
            start: chapter.source.place(0),
            page: Page {
                path: chapter.path,
                title: chapter.title,
                number: chapter.number,
                ..Page::default()
            },
        }
    }

    /// Resolves all directives of the chapter. Problems are reported.
    pub(crate) fn resolve(self, book: &Book) -> Draft<Resolved> {
        Draft {
            page: self.page,
            text: self.text.resolve(book),
            symbols: self.symbols,
            start: self.start,
        }
    }
}

impl Draft<Resolved> {
    /// Renders the page. Problems are reported.
    pub(crate) fn render(self, problems: &Problems) -> Page {
        let mut writer = Writer::new(self.page, &self.symbols, problems);
        let html = self.text.block(&mut writer);
        let mut page = writer.page;
        page.end_section();
        page.reading_time_min = reading_time_min(&page);
        let notebook = add_notebook(&mut page);
        page.html = reading_time(page.reading_time_min) + &html + &notebook + &deck_link(&page);
        let headings = page.headings.iter();
        if headings.filter(|heading| heading.level == 1).count() != 1 {
            let message = "a chapter starts with its title, `# …`, and has no other of that level";
            problems.report(self.start, message);
        }
        page
    }
}

/// Adds the notebook of a page with Python code, and a copy with solved tasks. Returns links.
fn add_notebook(page: &mut Page) -> String {
    if page.cells.is_empty() {
        return String::new();
    }
    let title = page.headings.first().map_or("", |heading| &heading.title);
    let mut add = |tasks| {
        let path = notebook::path(&page.path, tasks);
        let notebook = notebook::notebook(title, &page.cells, tasks);
        page.files.insert(path.clone(), notebook.into_bytes());
        path
    };
    let path = add(Tasks::Open);
    let root = path_to_root(&page.path);
    let has_task = |cell: &Cell| matches!(cell, Cell::Code { solution, .. } if solution.is_some());
    let solved = match page.cells.iter().any(has_task) {
        true => format!(
            ". <a href=\"{root}{}\" download>The same with its task solved</a>",
            add(Tasks::Solved)
        ),
        false => String::new(),
    };
    let name = path.rsplit('/').next().unwrap_or(&path);
    format!(
        "<p class=\"notebook\"><a href=\"{root}{path}\" download>Download the notebook of this chapter</a> \
         <span>{name}: all of its Python, to run and to change in Jupyter, VS Code or Colab{solved}</span></p>\n",
    )
}

/// Returns a link to the slides of a numbered chapter.
fn deck_link(page: &Page) -> String {
    let root = path_to_root(&page.path);
    let link = page.deck().map(|path| {
        format!(
            "<p class=\"deck-link\"><a href=\"{root}{path}\">Slides of this chapter</a> \
             <span>figures to operate, questions, and notes for the speaker</span></p>\n"
        )
    });
    link.unwrap_or_default()
}
