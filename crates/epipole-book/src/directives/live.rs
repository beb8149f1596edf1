//! `{{#live ransac-race.best}}`: a number of a figure, kept up to date; initially its value when
//! the page loads.

use crate::html::escape;
use crate::parse::outline::Instance;
use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// A readout or a control of a figure.
pub(super) struct Live {
    figure: Instance,
    shows: String,
}

/// A readout in the figure's initial state.
pub(super) struct Quoted {
    /// Anchor of the figure.
    id: String,
    shows: String,
    text: String,
}

impl Directive for Live {
    const NAME: &'static str = "live";
    type Resolved = Quoted;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let how = "write {{#live figure.readout}}";
        let ([word], []) = (&request.call.words[..], &request.call.settings[..]) else {
            return Err(how.to_owned());
        };
        let (wanted, shows) = word.rsplit_once('.').ok_or(how)?;
        let figure = parser.outline.nearest(wanted, &request.place)?;
        Ok(Live {
            figure: figure.clone(),
            shows: shows.to_owned(),
        })
    }

    fn resolve(self, book: &Book) -> Result<Quoted, String> {
        let Instance {
            name, id, settings, ..
        } = self.figure;
        let shown = book.facts(&name, &settings)?.shown(&self.shows);
        let shown = shown.map_err(|error| format!("figure {name}: {error}"))?;
        Ok(Quoted {
            id,
            shows: self.shows,
            text: shown.text,
        })
    }

    fn render(Quoted { id, shows, text }: Quoted, _: &mut Writer) -> Insert {
        // The number is an inline box; a word joiner keeps a following comma on its line.
        let html = format!(
            "<span class=\"live\" data-figure=\"{}\" data-shows=\"{}\">{}</span>\u{2060}",
            escape(&id),
            escape(&shows),
            escape(&text)
        );
        Insert::Inline { html, text }
    }
}
