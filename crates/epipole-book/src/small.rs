//! Small pictures of figures: where a paragraph tells what other chapters hold, it can show it.

use crate::directives::Directive;
use crate::expand::Insert;
use crate::figures::Room;
use crate::html::escape;
use crate::instances::{own_settings, setting};
use crate::links;
use crate::markdown::Renderer;
use crate::posters::{self, Posters};
use crate::problems::Place;
use crate::shared::token;
use crate::source::Source;

/// `{{#small figure key=value … page=sfm.md | words}}`: the figure's picture for a phone, with words below
/// it. It leads to the page, once there is such a page: chapters can name those that are still to come. If the
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
            format!("<a class=\"small\" href=\"{href}\">{inside}{solved}</a>")
        }
        _ => format!("<span class=\"small\">{inside}</span>"),
    };
    let text = String::new();
    Ok(Insert::Inline { html, text })
}
