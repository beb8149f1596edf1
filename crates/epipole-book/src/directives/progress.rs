//! `{{#progress}}`: solved questions and reached goals, stored in the reader's own browser.

use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::tokens::{PROGRESS, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// The table of quizzes and goals.
pub(super) struct Progress;

impl Directive for Progress {
    const NAME: &'static str = "progress";
    type Resolved = Self;

    fn parse(_: &Request, _: &Parser) -> Result<Self, String> {
        Ok(Progress)
    }

    fn resolve(self, _: &Book) -> Result<Self, String> {
        Ok(self)
    }

    fn render(_: Self, _: &mut Writer) -> Insert {
        let html = token(PROGRESS, "");
        Insert::Block { html }
    }
}
