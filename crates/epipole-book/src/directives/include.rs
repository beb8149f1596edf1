//! `{{#include file}}`, `{{#include file:anchor}}`: files, included before directives are parsed.

use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use std::convert::Infallible;

/// An include that remains because it is malformed.
pub(super) struct Include(Infallible);

impl Directive for Include {
    const NAME: &'static str = "include";
    type Resolved = Self;

    fn parse(_: &Request, _: &Parser) -> Result<Self, String> {
        Err("{{#include}} could not be read".to_owned())
    }

    fn resolve(self, _: &Book) -> Result<Self, String> {
        Ok(self)
    }

    fn render(include: Self, _: &mut Writer) -> Insert {
        match include.0 {}
    }
}
