//! Small pictures of figures: where a paragraph tells what other chapters hold, it can show it.

use crate::directives::expand::Insert;
use crate::html::escape;
use crate::parse::outline::{own_settings, setting, with_wishes};
use crate::parse::source::Source;
use crate::parse::syntax::Directive;
use crate::problems::Place;
use crate::render::links;
use crate::render::markdown::Renderer;
use crate::resolve::figures::Room;
use crate::resolve::posters::{self, Posters};
use crate::resolve::shared::token;

/// `{{#small figure key=value … page=sfm.md | words}}`: the figure's picture for a phone, with words below
/// it. With `moves="key=value …"` the picture comes to life where a reader looks at it: the figure goes there and back
/// (`web/book/small.ts`). It leads to the page, once there is such a page: chapters can name those that are still to come. If the
/// page has a quiz, the script of the page says how much of it the reader has solved.
pub(crate) fn picture(
    renderer: &mut Renderer,
    directive: &Directive,
    body: Option<Source>,
    place: &Place,
) -> Result<Insert, String> {
    let ([name], Some(body)) = (&directive.words[..], body) else {
        return Err("write {{#small figure key=value … page=… | words}}".to_owned());
    };
    let shared = renderer.shared;
    let settings = own_settings(directive);
    let problem = |error: String| format!("figure {name}: {error}");
    let figure = shared.gallery.open(name, &settings).map_err(problem)?;
    let posters = match shared.posters_in() {
        Some(folder) => {
            let rooms = &[Room::Phone];
            posters::draw(figure.as_ref(), rooms, name, &settings, renderer, folder)?
        }
        None => Posters::default(),
    };
    let moves = match setting(directive, "moves") {
        Some(moves) => {
            let moves = moves_of(moves, &settings)?;
            // What the page would ask of it can be asked.
            let there = with_wishes(settings.clone(), &moves);
            shared.gallery.open(name, &there).map_err(problem)?;
            life(name, &settings, &moves)
        }
        None => String::new(),
    };
    let words = renderer.inline(&body);
    // What the picture shows, the words say.
    let inside = format!(
        "<picture>{}<img src=\"{}\" alt=\"\" loading=\"lazy\" decoding=\"async\"></picture>\
         <span>{words}</span>",
        posters.sources, posters.src
    );
    let page = setting(directive, "page").map(|page| {
        let file = page.split('#').next().unwrap_or(page);
        (page, shared.read(file).is_some())
    });
    let html = match page {
        Some((page, true)) => {
            let href = links::rewrite(renderer, page, place.clone());
            // Which quiz the page has is known once it is rendered.
            let solved = token("solved", page.split('#').next().unwrap_or(page));
            let href = escape(&href);
            format!("<a class=\"small\"{moves} href=\"{href}\">{inside}{solved}</a>")
        }
        _ => format!("<span class=\"small\">{inside}</span>"),
    };
    let text = String::new();
    Ok(Insert::Inline { html, text })
}

/// Where the figure goes: each setting with a place to come back to.
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

/// The attributes that the script of the page reads.
fn life(name: &str, settings: &[(String, String)], moves: &[(String, String)]) -> String {
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
            life("four-poses", &settings, &moves),
            " data-figure=\"four-poses\" data-state=\"{&quot;turn&quot;:&quot;16&quot;}\" \
             data-moves=\"{&quot;turn&quot;:&quot;-30&quot;}\""
        );
        let sentence = moves_of("zoom=2", &settings).unwrap_err();
        assert!(sentence.contains("moves zoom, and does not say"));
        assert!(moves_of("turn", &settings).is_err());
    }
}
