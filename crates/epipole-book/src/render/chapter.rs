//! A chapter on its way through the stages: parsed, resolved, rendered.

use super::directive::{Parsed, Parser, Resolved};
use super::notebook;
use super::page::Page;
use super::writer::Writer;
use crate::html::path_to_root;
use crate::parse::book::Chapter;
use crate::parse::content::Content;
use crate::parse::outline::Outline;
use crate::parse::text::{Entry, Text};
use crate::problems::{Place, Problems};
use crate::resolve::book::Book;

/// A chapter whose text is at the stage `D` of its directives.
pub(crate) struct Draft<D> {
    page: Page,
    text: Text<D>,
    /// Letters of the chapter that its figures draw as well.
    symbols: Vec<String>,
    /// Its first line.
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

    /// Asks the core all that the chapter wants to know. Problems are reported.
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
    /// Makes the page. Problems are reported.
    pub(crate) fn render(self, problems: &Problems) -> Page {
        let mut writer = Writer::new(self.page, &self.symbols, problems);
        let html = self.text.block(&mut writer);
        let mut page = writer.page;
        page.html = html + &add_notebook(&mut page);
        page.end_section();
        let headings = page.headings.iter();
        if headings.filter(|heading| heading.level == 1).count() != 1 {
            let message = "a chapter starts with its title, `# …`, and has no other of that level";
            problems.report(self.start, message);
        }
        page
    }
}

/// Adds the notebook of a page that has Python. Returns a link to it.
fn add_notebook(page: &mut Page) -> String {
    if page.cells.is_empty() {
        return String::new();
    }
    let path = notebook::path(&page.path);
    let title = page.headings.first().map_or("", |heading| &heading.title);
    let notebook = notebook::notebook(title, &page.cells);
    page.files.insert(path.clone(), notebook.into_bytes());
    let name = path.rsplit('/').next().unwrap_or(&path);
    format!(
        "<p class=\"notebook\"><a href=\"{root}{path}\" download>Download the notebook of this chapter</a> \
         <span>{name}: all of its Python, to run and to change in Jupyter, VS Code or Colab</span></p>\n",
        root = path_to_root(&page.path),
    )
}
