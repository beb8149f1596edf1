//! The three stages of a directive, and of the texts that hold directives.

use super::insert::Insert;
use super::markdown::{self, Markdown};
use super::writer::Writer;
use crate::parse::text::{self, Entry, Request};
use crate::resolve::book::Book;

/// A directive of the authors' notation. Each stage uses only what the stages before it use.
pub(crate) trait Directive: Sized + Send + 'static {
    /// Name behind `{{#`.
    const NAME: &'static str;

    /// The directive once the core has answered.
    type Resolved: Send + 'static;

    /// Takes the directive's words apart, without asking anybody but the content folder.
    ///
    /// # Errors
    /// A sentence: what is wrong, and how to write it.
    fn parse(request: &Request, parser: &Parser) -> Result<Self, String>;

    /// Asks the core.
    ///
    /// # Errors
    /// A sentence: what is wrong, and what would be right.
    fn resolve(self, book: &Book) -> Result<Self::Resolved, String>;

    /// Makes HTML, and notes on the page what it needs.
    fn render(resolved: Self::Resolved, page: &mut Writer) -> Insert;
}

/// A directive of any kind that is parsed.
pub(crate) struct Parsed(Box<Resolve>);

/// A directive of any kind that is resolved.
pub(crate) struct Resolved(Box<Render>);

/// The stages of a directive that are still to come, its own type erased.
type Resolve = dyn FnOnce(&Book) -> Option<Resolved> + Send;
type Render = dyn FnOnce(&mut Writer) -> Insert + Send;

/// Parser for the texts of a chapter.
pub(crate) type Parser<'a> = text::Parser<'a, Parsed>;

/// A parsed text.
pub(crate) type ParsedText = text::Text<Parsed>;

/// A resolved text.
pub(crate) type Text = text::Text<Resolved>;

/// The line of a directive in the vocabulary.
pub(crate) const fn entry<D: Directive>() -> Entry<Parsed> {
    Entry {
        name: D::NAME,
        parse: parse::<D>,
    }
}

fn parse<D: Directive>(request: &Request, parser: &Parser) -> Result<Parsed, String> {
    let directive = D::parse(request, parser)?;
    let place = request.place.clone();
    Ok(Parsed(Box::new(move |book| {
        match directive.resolve(book) {
            Ok(resolved) => Some(Resolved(Box::new(|page| D::render(resolved, page)))),
            Err(message) => {
                book.problems.report(place, message);
                None
            }
        }
    })))
}

impl ParsedText {
    /// Resolves all directives of the text. Problems are reported.
    pub(crate) fn resolve(self, book: &Book) -> Text {
        self.map(|Parsed(resolve)| resolve(book))
    }
}

impl Text {
    /// A whole text with paragraphs, headings and so on.
    pub(crate) fn block(self, page: &mut Writer) -> String {
        markdown::block(&self.inserted(page), page)
    }

    /// A text that stands inside a paragraph, such as a caption.
    pub(crate) fn inline(self, page: &mut Writer) -> String {
        markdown::inline(&self.inserted(page), page)
    }

    /// The text with its directives rendered, in their order. They come before the text that they
    /// stand in; their words for the search belong into it.
    fn inserted(self, page: &mut Writer) -> Markdown {
        let (mut inserts, mut found) = (Vec::new(), Vec::new());
        for directive in self.directives {
            let before = std::mem::take(&mut page.page.words);
            inserts.push(match directive {
                Some(Resolved(render)) => render(page),
                None => Insert::nothing(),
            });
            found.push(std::mem::replace(&mut page.page.words, before));
        }
        Markdown {
            source: self.source,
            inserts,
            found,
        }
    }
}
