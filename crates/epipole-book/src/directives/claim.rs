//! `{{#claim ransac-race outliers=0.8 | budget > 100}}`: invisible; the build fails if the figure
//! contradicts it.

use crate::parse::outline::{own_settings, with_settings};
use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::claims;

/// A claim about a figure in a state.
pub(super) struct Claim {
    figure: String,
    settings: Vec<(String, String)>,
    claim: String,
}

impl Directive for Claim {
    const NAME: &'static str = "claim";
    type Resolved = ();

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let ([wanted], Some(body)) = (&request.call.words[..], &request.body) else {
            return Err("write {{#claim figure key=value … | readout > number}}".to_owned());
        };
        let figure = parser.outline.nearest(wanted, &request.place)?;
        Ok(Claim {
            figure: figure.name.clone(),
            settings: with_settings(figure.settings.clone(), &own_settings(request.call)),
            claim: body.text().to_owned(),
        })
    }

    fn resolve(self, book: &Book) -> Result<(), String> {
        let facts = book.facts(&self.figure, &self.settings)?;
        claims::check(&self.claim, &facts)
    }

    fn render((): (), _: &mut Writer) -> Insert {
        Insert::nothing()
    }
}
