//! `{{#small figure key=value … page=sfm.md | words}}`: a small picture of a figure in that state,
//! with a text below it.
//!
//! With `moves="key=value …"` the figure runs while in view, and moves to these values and back
//! (`web/book/small.ts`). It links to the page once that exists, as chapters may name future pages.
//! If the page has a quiz, the page's script shows the number of questions solved.

use crate::html::escape;
use crate::parse::outline::{own_settings, with_settings};
use crate::parse::text::Request;
use crate::problems::Place;
use crate::render::directive::{Directive, ParsedText, Parser, Text};
use crate::render::insert::Insert;
use crate::render::links;
use crate::render::pictures;
use crate::render::tokens::{SOLVED, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::figures::Room;
use crate::resolve::posters::Posters;

/// A figure in a state, and its page. `T` is the stage of its text.
pub(super) struct Small<T> {
    name: String,
    settings: Vec<(String, String)>,
    moves: Option<String>,
    /// The page, if it exists.
    page: Option<String>,
    words: T,
    place: Place,
}

/// A small picture, drawn.
pub(super) struct Drawn {
    small: Small<Text>,
    posters: Posters,
    /// Attributes for the running figure.
    attributes: String,
}

impl Directive for Small<ParsedText> {
    const NAME: &'static str = "small";
    type Resolved = Drawn;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let ([name], Some(body)) = (&request.call.words[..], &request.body) else {
            return Err("write {{#small figure key=value … page=… | words}}".to_owned());
        };
        let page = request.setting("page");
        let exists = |page: &&str| parser.content.read(file_of(page)).is_some();
        Ok(Small {
            name: name.clone(),
            settings: own_settings(request.call),
            moves: request.setting("moves").map(str::to_owned),
            page: page.filter(exists).map(str::to_owned),
            words: parser.text(body),
            place: request.place.clone(),
        })
    }

    fn resolve(self, book: &Book) -> Result<Drawn, String> {
        let Small { name, settings, .. } = &self;
        let problem = |error: String| format!("figure {name}: {error}");
        book.gallery.open(name, settings).map_err(problem)?;
        let posters = book.posters(name, settings, &[Room::Phone])?;
        let attributes = match &self.moves {
            Some(moves) => {
                let moves = moves_of(moves, settings)?;
                // The figure must accept all settings that the page will apply.
                let there = with_settings(settings.clone(), &moves);
                book.gallery.open(name, &there).map_err(problem)?;
                attributes(name, settings, &moves)
            }
            None => String::new(),
        };
        Ok(Drawn {
            small: Small {
                name: self.name,
                settings: self.settings,
                moves: self.moves,
                page: self.page,
                words: self.words.resolve(book),
                place: self.place,
            },
            posters,
            attributes,
        })
    }

    fn render(drawn: Drawn, page: &mut Writer) -> Insert {
        let Drawn {
            small,
            posters,
            attributes,
        } = drawn;
        let pictures = pictures::add(page, &small.name, posters);
        let words = small.words.inline(page);
        // The text describes the picture, so its alternative text is empty.
        let inside = format!(
            "<picture>{}<img src=\"{}\" alt=\"\" loading=\"lazy\" decoding=\"async\"></picture>\
             <span>{words}</span>",
            pictures.sources, pictures.src
        );
        let Some(target) = &small.page else {
            return Insert::inline(format!("<span class=\"small\">{inside}</span>"));
        };
        let href = escape(&links::rewrite(page, target, small.place));
        // The quiz of the page is known once that page is rendered.
        let solved = token(SOLVED, file_of(target));
        Insert::inline(format!(
            "<a class=\"small\"{attributes} href=\"{href}\">{inside}{solved}</a>"
        ))
    }
}

/// Returns the file of a link to a section.
fn file_of(page: &str) -> &str {
    page.split('#').next().unwrap_or(page)
}

/// Parses the settings that the figure moves to, each of which needs an initial value to return to.
fn moves_of(moves: &str, settings: &[(String, String)]) -> Result<Vec<(String, String)>, String> {
    let one = |word: &str| {
        let (key, value) = word
            .split_once('=')
            .ok_or_else(|| format!("moves=\"{moves}\" is not written key=value"))?;
        if settings.iter().all(|(known, _)| known != key) {
            return Err(format!(
                "the picture moves {key}, and does not say where it begins"
            ));
        }
        Ok((key.to_owned(), value.to_owned()))
    };
    moves.split_whitespace().map(one).collect()
}

/// Renders the attributes that the script of the page reads.
fn attributes(name: &str, settings: &[(String, String)], moves: &[(String, String)]) -> String {
    let object = |pairs: &[(String, String)]| {
        let pairs = pairs
            .iter()
            .map(|(key, value)| (key.clone(), value.clone().into()));
        escape(&serde_json::Value::Object(serde_json::Map::from_iter(pairs)).to_string())
    };
    format!(
        " data-figure=\"{}\" data-state=\"{}\" data-moves=\"{}\"",
        escape(name),
        object(settings),
        object(moves)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_moves_from_where_it_is() {
        let settings = [("turn".to_owned(), "16".to_owned())];
        let moves = moves_of("turn=-30", &settings).unwrap();
        assert_eq!(moves, [("turn".to_owned(), "-30".to_owned())]);
        assert_eq!(
            attributes("four-poses", &settings, &moves),
            " data-figure=\"four-poses\" data-state=\"{&quot;turn&quot;:&quot;16&quot;}\" \
             data-moves=\"{&quot;turn&quot;:&quot;-30&quot;}\""
        );
        let sentence = moves_of("zoom=2", &settings).unwrap_err();
        assert!(sentence.contains("moves zoom, and does not say"));
        assert!(moves_of("turn", &settings).is_err());
    }
}
