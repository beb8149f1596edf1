//! The three stages of a directive, and of the texts that hold directives.

use super::insert::Insert;
use super::markdown::{self, Markdown};
use super::writer::Writer;
use crate::parse::text::{self, Entry, Request};
use crate::resolve::book::Book;

/// A directive of the authors' notation. Each stage uses only the results of the one before.
pub(crate) trait Directive: Sized + Send + 'static {
    /// Name after `{{#`.
    const NAME: &'static str;

    /// The resolved directive.
    type Resolved: Send + 'static;

    /// Parses the directive, using nothing but the content folder.
    ///
    /// # Errors
    /// A message with the problem and the correct syntax.
    fn parse(request: &Request, parser: &Parser) -> Result<Self, String>;

    /// Resolves the directive, using the core.
    ///
    /// # Errors
    /// A message with the problem and its remedy.
    fn resolve(self, book: &Book) -> Result<Self::Resolved, String>;

    /// Renders the directive, and adds its requirements to the page.
    fn render(resolved: Self::Resolved, page: &mut Writer) -> Insert;
}

/// A parsed directive of any kind.
pub(crate) struct Parsed(Box<Resolve>);

/// A resolved directive of any kind.
pub(crate) struct Resolved(Box<Render>);

/// Remaining stages of a directive, with its type erased.
type Resolve = dyn FnOnce(&Book) -> Option<Resolved> + Send;
type Render = dyn FnOnce(&mut Writer) -> Insert + Send;

/// Parser for the texts of a chapter.
pub(crate) type Parser<'a> = text::Parser<'a, Parsed>;

/// A parsed text.
pub(crate) type ParsedText = text::Text<Parsed>;

/// A resolved text.
pub(crate) type Text = text::Text<Resolved>;

/// Returns the entry of a directive in the vocabulary.
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
    /// Renders a text with paragraphs, headings and other blocks.
    pub(crate) fn block(self, page: &mut Writer) -> String {
        markdown::block(&self.inserted(page), page)
    }

    /// Renders a text inside a paragraph, such as a caption.
    pub(crate) fn inline(self, page: &mut Writer) -> String {
        markdown::inline(&self.inserted(page), page)
    }

    /// Renders the directives of the text, in order. They are rendered before the text around them,
    /// which their words for the search index belong to.
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
