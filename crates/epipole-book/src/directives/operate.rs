//! `{{#do ransac-race outliers=0.7 | words}}`: a phrase that sets the nearest figure of that name
//! when clicked, by a script of the page (`web/book/operate.ts`).

use crate::html::escape;
use crate::parse::outline::{Instance, own_settings, with_settings};
use crate::parse::text::Request;
use crate::render::directive::{Directive, ParsedText, Parser, Text};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::claims;

/// The phrase and its settings. `T` is the stage of the phrase.
pub(super) struct Do<T> {
    figure: Instance,
    changes: Vec<(String, String)>,
    claim: Option<String>,
    /// States of the figure for readers who clicked other phrases before.
    after_others: [Vec<(String, String)>; 2],
    words: T,
}

/// The directive after its claim was checked.
pub(super) struct Checked {
    /// Anchor of the figure.
    id: String,
    changes: Vec<(String, String)>,
    words: Text,
}

impl Directive for Do<ParsedText> {
    const NAME: &'static str = "do";
    type Resolved = Checked;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let how = "write {{#do figure key=value … | words}}";
        let ([wanted], Some(body)) = (&request.call.words[..], &request.body) else {
            return Err(how.to_owned());
        };
        let changes = own_settings(request.call);
        if changes.is_empty() || body.text().trim().is_empty() {
            return Err(how.to_owned());
        }
        let figure = parser.outline.nearest(wanted, &request.place)?;
        let outline = parser.outline;
        Ok(Do {
            after_others: outline.after_others(figure, &request.place, &changes),
            figure: figure.clone(),
            changes,
            claim: request.setting("claim").map(str::to_owned),
            words: parser.text(body),
        })
    }

    fn resolve(self, book: &Book) -> Result<Checked, String> {
        let Instance { name, settings, .. } = &self.figure;
        let settings = with_settings(settings.clone(), &self.changes);
        let facts = book.facts(name, &settings)?;
        if let Some(claim) = &self.claim {
            claims::check(claim, &facts)?;
            // The claim must also hold after clicks on other phrases.
            for settings in &self.after_others {
                let facts = book.facts(name, settings)?;
                claims::check(claim, &facts)
                    .map_err(|error| format!("once other words have set the figure, {error}"))?;
            }
        }
        Ok(Checked {
            id: self.figure.id,
            changes: self.changes,
            words: self.words.resolve(book),
        })
    }

    fn render(checked: Checked, page: &mut Writer) -> Insert {
        let html = checked.words.inline(page);
        let changes = checked.changes.into_iter();
        let parameters = changes.map(|(key, value)| (key, value.into()));
        let parameters = serde_json::Map::from_iter(parameters);
        let parameters = serde_json::Value::Object(parameters).to_string();
        Insert::inline(format!(
            "<span class=\"do\" data-figure=\"{}\" data-parameters=\"{}\">{html}</span>",
            escape(&checked.id),
            escape(&parameters)
        ))
    }
}
