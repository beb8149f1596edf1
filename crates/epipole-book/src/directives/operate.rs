//! Prose that operates figures: `{{#do …}}` sets one, `{{#live …}}` quotes its numbers. Both are words of
//! the sentence; a script of the page (`web/book/operate.ts`) brings them to life.

use crate::directives::expand::Insert;
use crate::html::escape;
use crate::parse::outline::{
    Instance, clicked_before, nearest, own_settings, setting, with_wishes,
};
use crate::parse::source::Source;
use crate::parse::syntax::Directive;
use crate::problems::Place;
use crate::render::markdown::Renderer;
use crate::resolve::claims;
use crate::resolve::facts::Facts;
use std::sync::Arc;

/// `{{#do figure key=value … | words}}`: the words, and where they take the figure.
pub(crate) fn set(
    renderer: &mut Renderer,
    directive: &Directive,
    body: Option<Source>,
    place: &Place,
) -> Result<Insert, String> {
    let how = "write {{#do figure key=value … | words}}";
    let ([wanted], Some(body)) = (&directive.words[..], body) else {
        return Err(how.to_owned());
    };
    let wishes = own_settings(directive);
    if wishes.is_empty() || body.text().trim().is_empty() {
        return Err(how.to_owned());
    }
    let figure = nearest(wanted, place, &renderer.instances)?.clone();
    let facts = after(renderer, &figure, &wishes)?;
    if let Some(claim) = setting(directive, "claim") {
        claims::check(claim, &facts)?;
        // What the words say holds for whoever has clicked other words before.
        for clicked in clicked_before(&figure, (place, &wishes), &renderer.acts) {
            let settings = clicked
                .iter()
                .fold(figure.settings.clone(), |settings, act| {
                    with_wishes(settings, &act.wishes)
                });
            let settings = with_wishes(settings, &wishes);
            let facts = renderer.shared.facts(&figure.name, &settings)?;
            claims::check(claim, &facts)
                .map_err(|error| format!("once other words have set the figure, {error}"))?;
        }
    }
    let html = renderer.inline(&body);
    let parameters =
        serde_json::Map::from_iter(wishes.into_iter().map(|(key, value)| (key, value.into())));
    let parameters = serde_json::Value::Object(parameters).to_string();
    Ok(Insert::Inline {
        html: format!(
            "<span class=\"do\" data-figure=\"{}\" data-parameters=\"{}\">{html}</span>",
            escape(&figure.id),
            escape(&parameters)
        ),
        text: String::new(),
    })
}

/// `{{#live figure.readout}}`: a number that follows the figure, as it is when the page comes.
pub(crate) fn quote(
    renderer: &mut Renderer,
    directive: &Directive,
    place: &Place,
) -> Result<Insert, String> {
    let how = "write {{#live figure.readout}}";
    let ([word], true) = (&directive.words[..], directive.settings.is_empty()) else {
        return Err(how.to_owned());
    };
    let (wanted, id) = word.rsplit_once('.').ok_or(how)?;
    let figure = nearest(wanted, place, &renderer.instances)?.clone();
    let shown = after(renderer, &figure, &[])?
        .shown(id)
        .map_err(|error| format!("figure {}: {error}", figure.name))?;
    Ok(Insert::Inline {
        html: format!(
            "<span class=\"live\" data-figure=\"{}\" data-shows=\"{}\">{}</span>",
            escape(&figure.id),
            escape(id),
            escape(&shown.text)
        ),
        text: shown.text,
    })
}

/// `{{#claim figure key=value … | readout > number}}`: nothing to see; the build fails if it is false.
pub(crate) fn claim(
    renderer: &mut Renderer,
    directive: &Directive,
    body: Option<Source>,
    place: &Place,
) -> Result<Insert, String> {
    let ([wanted], Some(body)) = (&directive.words[..], body) else {
        return Err("write {{#claim figure key=value … | readout > number}}".to_owned());
    };
    let figure = nearest(wanted, place, &renderer.instances)?.clone();
    let facts = after(renderer, &figure, &own_settings(directive))?;
    claims::check(body.text(), &facts)?;
    Ok(Insert::Inline {
        html: String::new(),
        text: String::new(),
    })
}

/// What a figure of the page shows once `wishes` are put on top of the chapter's own settings.
fn after(
    renderer: &Renderer,
    figure: &Instance,
    wishes: &[(String, String)],
) -> Result<Arc<Facts>, String> {
    let settings = with_wishes(figure.settings.clone(), wishes);
    renderer.shared.facts(&figure.name, &settings)
}
