//! `{{#define epipole}}`: the definition of a term. The glossary links to it.

use super::term::Named;
use crate::html::escape;
use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::terms::anchor_of;
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// The definition of a term.
pub(super) struct Define(Named);

impl Directive for Define {
    const NAME: &'static str = "define";
    type Resolved = Self;

    fn parse(request: &Request, _: &Parser) -> Result<Self, String> {
        Named::parse(request).map(Define)
    }

    fn resolve(self, _: &Book) -> Result<Self, String> {
        Ok(self)
    }

    fn render(Define(Named { key, words, place }): Self, page: &mut Writer) -> Insert {
        let (id, shown) = (escape(&anchor_of(&key)), escape(&words));
        page.page.definitions.push((key, place));
        Insert::Inline {
            html: format!("<dfn id=\"{id}\">{shown}</dfn>"),
            text: words,
        }
    }
}
