//! `{{#term epipole | epipoles}}`: a phrase linked to the entry of its term in the glossary.

use crate::html::escape;
use crate::parse::text::Request;
use crate::problems::Place;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::terms::name_of;
use crate::render::tokens::{PAGE_OF_GLOSSARY, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// A phrase that names a term.
pub(super) struct Named {
    pub(super) key: String,
    pub(super) words: String,
    pub(super) place: Place,
}

impl Named {
    /// Parses `key | words`. The words default to the name of the term.
    ///
    /// # Errors
    /// A message, unless there is exactly one key.
    pub(super) fn parse(request: &Request) -> Result<Self, String> {
        let key = request.one_word("key | words")?;
        let body = request.body.as_ref();
        Ok(Named {
            key: key.to_owned(),
            words: body.map_or_else(|| name_of(key), |body| body.text().to_owned()),
            place: request.place.clone(),
        })
    }
}

/// A term used in a sentence.
pub(super) struct Term(Named);

impl Directive for Term {
    const NAME: &'static str = "term";
    type Resolved = Self;

    fn parse(request: &Request, _: &Parser) -> Result<Self, String> {
        Named::parse(request).map(Term)
    }

    fn resolve(self, _: &Book) -> Result<Self, String> {
        Ok(self)
    }

    fn render(Term(Named { key, words, place }): Self, page: &mut Writer) -> Insert {
        let html = format!(
            "<a class=\"term\" href=\"{}#{}\">{}</a>",
            token(PAGE_OF_GLOSSARY, ""),
            escape(&key),
            escape(&words)
        );
        page.page.terms.push((key, place));
        Insert::Inline { html, text: words }
    }
}
