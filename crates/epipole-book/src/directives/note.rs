//! `{{#note | text}}`: a numbered note in the margin.

use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::directive::{ParsedText, Text};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// The text of the note.
pub(super) struct Note(ParsedText);

impl Directive for Note {
    const NAME: &'static str = "note";
    type Resolved = Text;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let body = request.body.as_ref().ok_or("write {{#note | text}}")?;
        Ok(Note(parser.text(body)))
    }

    fn resolve(self, book: &Book) -> Result<Text, String> {
        Ok(self.0.resolve(book))
    }

    fn render(words: Text, page: &mut Writer) -> Insert {
        let html = words.inline(page);
        Insert::inline(page.note(&html))
    }
}
