//! Markdown with parsed directives, also inside captions, notes and quizzes.

use super::content::Content;
use super::outline::Outline;
use super::placeholders;
use super::source::Source;
use super::syntax::{Call, Piece, split};
use crate::problems::{Place, Problems, name_list};

/// Markdown with placeholders for its directives. `D` is a directive at some stage.
pub(crate) struct Text<D> {
    /// The Markdown with its placeholders.
    pub(crate) source: Source,
    /// Directives by the index of their placeholders; `None` if a problem was reported.
    pub(crate) directives: Vec<Option<D>>,
}

impl<D> Text<D> {
    /// Maps the text to the next stage.
    pub(crate) fn map<E>(self, next: impl FnMut(D) -> Option<E>) -> Text<E> {
        let mut next = next;
        let directives = self.directives.into_iter();
        Text {
            source: self.source,
            directives: directives.map(|known| known.and_then(&mut next)).collect(),
        }
    }
}

/// A directive as written, to be parsed.
pub(crate) struct Request<'a> {
    pub(crate) call: &'a Call,
    /// The text after ` | `.
    pub(crate) body: Option<Source>,
    pub(crate) place: Place,
}

impl<'a> Request<'a> {
    /// Returns the only word.
    ///
    /// # Errors
    /// A message with `usage`, unless there is exactly one.
    pub(crate) fn one_word(&self, usage: &str) -> Result<&'a str, String> {
        match &self.call.words[..] {
            [word] => Ok(word),
            _ => Err(format!("write {{{{#{} {usage}}}}}", self.call.name)),
        }
    }

    /// Returns the value of a setting.
    pub(crate) fn setting(&self, key: &str) -> Option<&'a str> {
        self.call.setting(key)
    }
}

/// A line of the vocabulary.
pub(crate) struct Entry<D> {
    /// Name after `{{#`.
    pub(crate) name: &'static str,
    pub(crate) parse: fn(&Request, &Parser<D>) -> Result<D, String>,
}

/// Parser for the texts of one chapter.
pub(crate) struct Parser<'a, D> {
    pub(crate) content: &'a Content,
    pub(crate) problems: &'a Problems,
    /// Path of the page, such as `part/ransac.html`.
    pub(crate) page: &'a str,
    pub(crate) outline: &'a Outline,
    /// Directives, sorted by name.
    pub(crate) vocabulary: &'a [Entry<D>],
}

impl<D> Parser<'_, D> {
    /// Parses a text and the texts inside its directives. Problems are reported.
    pub(crate) fn text(&self, source: &Source) -> Text<D> {
        let mut text = Text {
            source: Source::default(),
            directives: Vec::new(),
        };
        for piece in split(source) {
            match piece {
                Piece::Text(range) => text.source.push_slice(source, range),
                Piece::Broken(range, message) => {
                    self.problems.report(source.place(range.start), message);
                }
                Piece::Directive(call) => {
                    let place = source.place(call.span.start);
                    let placeholder = placeholders::of(text.directives.len());
                    text.directives
                        .push(self.directive(source, &call, place.clone()));
                    text.source.push(&placeholder, place);
                }
            }
        }
        text
    }

    /// Parses a text from `place` in another file.
    pub(crate) fn verbatim(&self, text: &str, place: &Place) -> Text<D> {
        self.text(&Source::new(text, place.clone()))
    }

    fn directive(&self, source: &Source, call: &Call, place: Place) -> Option<D> {
        let body = call.body.clone().map(|range| source.slice(range));
        let request = Request { call, body, place };
        let entry = self
            .vocabulary
            .iter()
            .find(|entry| entry.name == call.name)
            .ok_or_else(|| {
                let known = self.vocabulary.iter();
                let known: Vec<&str> = known.map(|entry| entry.name).collect();
                let (name, known) = (&call.name, name_list(&known));
                format!("unknown directive \"{name}\"; known: {known}")
            });
        let parsed = entry.and_then(|entry| (entry.parse)(&request, self));
        parsed
            .map_err(|message| self.problems.report(request.place, message))
            .ok()
    }
}
