//! `{{#ref fig-x}}`: a link "Figure 4.1", from any chapter.

use crate::parse::text::Request;
use crate::problems::Place;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::tokens::{NUMBER_OF_FIGURE, PAGE_OF_FIGURE, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// The anchor of a figure.
pub(super) struct Reference {
    id: String,
    place: Place,
}

impl Directive for Reference {
    const NAME: &'static str = "ref";
    type Resolved = Self;

    fn parse(request: &Request, _: &Parser) -> Result<Self, String> {
        Ok(Reference {
            id: request.one_word("figure-id")?.to_owned(),
            place: request.place.clone(),
        })
    }

    fn resolve(self, _: &Book) -> Result<Self, String> {
        Ok(self)
    }

    fn render(Reference { id, place }: Self, page: &mut Writer) -> Insert {
        let html = format!(
            "<a class=\"ref\" href=\"{}\">{}</a>",
            token(PAGE_OF_FIGURE, &id),
            token(NUMBER_OF_FIGURE, &id)
        );
        page.page.wanted_figures.push((id, place));
        Insert::inline(html)
    }
}
