//! What each directive becomes. This table is the authors' vocabulary:
//!
//! | written | becomes |
//! |---|---|
//! | `{{#figure name key=value … \| caption}}` | a live figure with its poster, number and caption; `controls="a b"`, `readouts="…"` and `goals=none` choose what it shows, `claim="readout > 3"` is checked |
//! | `{{#do figure key=value … \| words}}` | words of a sentence that take the nearest figure of that name there; of several, `name#id` |
//! | `{{#live figure.readout}}` | a number of a figure, which follows it |
//! | `{{#claim figure key=value … \| readout > 3}}` | nothing; the build fails if the figure shows otherwise |
//! | `{{#small figure key=value … page=sfm.md \| words}}` | a small picture of a figure with words, linked to the page; without a link while there is no such page |
//! | `{{#listing name \| Title}}` … `{{/listing}}` | a listing with a tab for each of its fences, see `blocks.rs`; what it prints; cells of the notebook |
//! | `{{#task name \| Title}}` … `{{/task}}` | a programming task for the notebook: fences to start from, to check and to solve it |
//! | `{{#ref fig-name}}` | a link "Figure 4.1" |
//! | `{{#value name key=value … digits=2}}` | a number computed by the core; also in formulas |
//! | `{{#symbols P p p' e'}}` | a list of letters that the figures draw; in the chapter's formulas they have their colors |
//! | `{{#cite key other \| §3}}` | a citation, linked to the list of references |
//! | `{{#note text}}` or `{{#note \| text}}` | a numbered note in the margin (as a footnote `[^x]`) |
//! | `{{#quiz name}}` | the quiz `quizzes/name.toml` |
//! | `{{#references}}` | the list of all cited works |
//! | `{{#gallery}}` | every figure, with what can be set and read, and words to copy for other pages |
//! | `{{#progress}}` | which questions the reader has solved and which goals reached, kept in their own browser |
//! | `{{#include file}}`, `{{#include file:anchor}}` | the text of a file, or of its part between `ANCHOR: name` and `ANCHOR_END: name`; also in listings |

use crate::directives::blocks::{Kind, Opening};
use crate::directives::{gallery, operate, quiz, small};
use crate::html::escape;
use crate::parse::outline::{self, Instance, setting};
use crate::parse::source::Source;
use crate::parse::syntax::Directive;
use crate::problems::{Place, name_list};
use crate::render::markdown::Renderer;
use crate::render::page::FigureEntry;
use crate::render::symbols;
use crate::resolve::claims;
use crate::resolve::facts::Facts;
use crate::resolve::figures::Room;
use crate::resolve::numbers;
use crate::resolve::posters::{self, Posters};
use crate::resolve::references::cite;
use crate::resolve::shared::{PAGE_OF_REFERENCES, PanelRequest, QuizEntry, token};

const KNOWN: [&str; 17] = [
    "cite",
    "claim",
    "do",
    "figure",
    "gallery",
    "include",
    "listing",
    "live",
    "note",
    "progress",
    "quiz",
    "ref",
    "references",
    "small",
    "symbols",
    "task",
    "value",
];

/// The HTML that takes a directive's place.
pub(crate) enum Insert {
    /// A printed number.
    Value(String),
    /// Something inside a paragraph, and its words for the search.
    Inline { html: String, text: String },
    /// Something that is a paragraph of its own.
    Block { html: String },
    /// The beginning of a block that goes on to its end, likewise a paragraph of its own.
    Opening(Opening),
}

impl Insert {
    /// As plain text, or LaTeX.
    pub(crate) fn text(&self) -> String {
        match self {
            Insert::Value(text) | Insert::Inline { text, .. } => text.clone(),
            Insert::Block { .. } | Insert::Opening(_) => String::new(),
        }
    }

    /// As HTML. A number gets a real minus sign.
    pub(crate) fn html(&self) -> String {
        match self {
            Insert::Value(text) => {
                let shown = text
                    .strip_prefix('-')
                    .map_or(text.clone(), |rest| format!("−{rest}"));
                format!("<span class=\"value\">{}</span>", escape(&shown))
            }
            Insert::Inline { html, .. } | Insert::Block { html } => html.clone(),
            Insert::Opening(_) => String::new(),
        }
    }
}

/// What a directive becomes, or a sentence that says what is wrong with it.
pub(crate) fn expand(
    renderer: &mut Renderer,
    directive: &Directive,
    body: Option<Source>,
    place: &Place,
) -> Result<Insert, String> {
    let words = &directive.words;
    let one_word = |what: &str| match &words[..] {
        [word] => Ok(word.clone()),
        _ => Err(format!("write {{{{#{} {what}}}}}", directive.name)),
    };
    match directive.name.as_str() {
        "value" => {
            numbers::print(&one_word("name key=value …")?, &directive.settings).map(Insert::Value)
        }
        "figure" => figure(
            renderer,
            directive,
            one_word("name key=value … | caption")?,
            body,
            place,
        ),
        "ref" => {
            let id = one_word("figure-id")?;
            renderer.shared.wants_figure(&id, place);
            let html = format!(
                "<a class=\"ref\" href=\"{}\">{}</a>",
                token("figure-page", &id),
                token("figure-number", &id)
            );
            Ok(Insert::Inline {
                html,
                text: String::new(),
            })
        }
        "cite" => {
            if words.is_empty() {
                return Err("write {{#cite key …}}".to_owned());
            }
            if words
                .iter()
                .any(|key| renderer.shared.references.label(key).is_some())
            {
                renderer.shared.wants_references(place);
            }
            let locator = body.map(|body| body.text().to_owned());
            let shared = renderer.shared;
            let page = token(PAGE_OF_REFERENCES, "");
            let html = cite(
                words,
                locator.as_deref(),
                &shared.references,
                &page,
                place,
                shared.problems,
            );
            let labels: Vec<String> = words
                .iter()
                .filter_map(|key| shared.references.label(key))
                .collect();
            Ok(Insert::Inline {
                html,
                text: labels.join("; "),
            })
        }
        "note" => {
            let Some(body) = body else {
                return Err("write {{#note | text}}".to_owned());
            };
            let html = renderer.inline(&body);
            Ok(Insert::Inline {
                html: renderer.note(&html),
                text: String::new(),
            })
        }
        "quiz" => quiz_block(renderer, &one_word("name")?),
        "references" => {
            renderer.page.has_references = true;
            Ok(Insert::Block {
                html: renderer.shared.references.list(),
            })
        }
        "gallery" => gallery::list(renderer, place).map(|html| Insert::Block { html }),
        "progress" => Ok(Insert::Block {
            html: token("progress", ""),
        }),
        "small" => small::picture(renderer, directive, body, place),
        "do" => operate::set(renderer, directive, body, place),
        "live" => operate::quote(renderer, directive, place),
        "claim" => operate::claim(renderer, directive, body, place),
        "listing" | "task" => {
            let name = one_word("name | Title")?;
            let Some(title) = body else {
                return Err(format!("write {{{{#{} name | Title}}}}", directive.name));
            };
            let kind = match directive.name.as_str() {
                "task" => Kind::Task,
                _ => Kind::Listing,
            };
            Ok(Insert::Opening(Opening {
                kind,
                name,
                html: renderer.inline(&title),
                title: title.text().to_owned(),
                picture: setting(directive, "picture").map(str::to_owned),
            }))
        }
        "symbols" => symbols::list(words).map(|html| Insert::Block { html }),
        "include" => Err("{{#include}} could not be read".to_owned()),
        other => Err(format!(
            "unknown directive \"{other}\"; known: {}",
            name_list(&KNOWN)
        )),
    }
}

fn figure(
    renderer: &mut Renderer,
    directive: &Directive,
    name: String,
    caption: Option<Source>,
    place: &Place,
) -> Result<Insert, String> {
    let shared = renderer.shared;
    let names = shared.gallery.names();
    if !names.contains(&name) {
        return Err(format!(
            "unknown figure \"{name}\"; known figures: {}",
            name_list(&names)
        ));
    }
    let Some(caption) = caption else {
        return Err(format!(
            "figure {name} needs a caption: {{{{#figure {name} … | caption}}}}"
        ));
    };
    let figure = outline::at(place, &renderer.instances).cloned();
    let Some(Instance { id, settings, .. }) = figure else {
        return Err("a figure must stand in a paragraph of its own".to_owned());
    };
    let figure = shared
        .gallery
        .open(&name, &settings)
        .map_err(|error| format!("figure {name}: {error}"))?;
    let facts = shared.facts(&name, &settings)?;
    let shown =
        what_is_shown(directive, &facts).map_err(|error| format!("figure {name}: {error}"))?;
    if let Some(claim) = setting(directive, "claim") {
        claims::check(claim, &facts)?;
    }
    if setting(directive, "goals") != Some("none") {
        shared.add_goals(&renderer.page.path, &name, &facts.ids("challenges"));
    }
    let number = renderer.page.next_figure_number();
    let entry = FigureEntry {
        id: id.clone(),
        number: number.clone(),
        place: place.clone(),
    };
    renderer.page.figures.push(entry);

    let posters = match shared.posters_in() {
        Some(folder) => {
            let rooms = Room::all_for(facts.aspect());
            posters::draw(figure.as_ref(), rooms, &name, &settings, renderer, folder)?
        }
        None => Posters::default(),
    };
    let description = facts.description();
    renderer.page.words.push_str(description);
    renderer.page.words.push(' ');
    let caption = renderer.inline(&caption);
    let (title, help) = shared.gallery.about(&name);
    let panel = shared.wants_panel(PanelRequest {
        name: name.clone(),
        title,
        help,
        snapshot: facts.snapshot().clone(),
        attributes: settings.iter().chain(&shown).cloned().collect(),
        sizes: posters.sizes.clone(),
    });
    let mut attributes: String = settings
        .iter()
        .chain(&shown)
        .map(|(key, value)| format!(" {}=\"{}\"", escape(key), escape(value)))
        .collect();
    if let Some(button) = setting(directive, "play") {
        facts.check_names("controls", button)?;
        attributes.push_str(&format!(" data-play=\"{}\"", escape(button)));
    }
    // The first figure of a page may be in sight at once; the others can wait.
    let loading = match renderer.page.figures.len() {
        1 => "fetchpriority=\"high\"",
        _ => "loading=\"lazy\"",
    };
    let html = format!(
        "<figure class=\"epipole\" id=\"{id}\">\n\
         <epipole-figure name=\"{name}\"{attributes}>{panel}\
         <picture>{sources}<img src=\"{src}\" alt=\"{alt}\" {loading} decoding=\"async\">\
         </picture></epipole-figure>\n\
         <figcaption><a class=\"figure-number\" href=\"#{id}\">Figure {number}</a> {caption}</figcaption>\n\
         </figure>\n",
        id = escape(&id),
        panel = token("panel", &panel.to_string()),
        alt = escape(description),
        sources = posters.sources,
        src = posters.src,
    );
    Ok(Insert::Block { html })
}

/// What a page shows of the figure, by the attributes of the same names; checked.
fn what_is_shown(directive: &Directive, facts: &Facts) -> Result<Vec<(String, String)>, String> {
    let mut shown = Vec::new();
    for key in ["controls", "readouts", "goals"] {
        let Some(value) = setting(directive, key) else {
            continue;
        };
        match key {
            "goals" if matches!(value, "none" | "one" | "all") => {}
            "goals" => return Err(format!("goals={value}: it is none, one or all")),
            list => facts.check_names(list, value)?,
        }
        shown.push((key.to_owned(), value.to_owned()));
    }
    if setting(directive, "goals") != Some("none") {
        let mut goals = facts.ids("challenges").into_iter();
        let is_reached = |goal: &&str| {
            let shown = facts.shown(&format!("goal.{goal}"));
            shown.is_ok_and(|shown| shown.text == "true")
        };
        if let Some(goal) = goals.find(is_reached) {
            return Err(format!(
                "its goal \"{goal}\" is reached before the reader has done anything: show another state, or goals=none"
            ));
        }
    }
    Ok(shown)
}

fn quiz_block(renderer: &mut Renderer, name: &str) -> Result<Insert, String> {
    let shared = renderer.shared;
    if !name
        .chars()
        .all(|letter| letter.is_ascii_alphanumeric() || letter == '-')
    {
        return Err(format!("\"{name}\" is not the name of a quiz"));
    }
    let Some(source) = shared.read(&format!("quizzes/{name}.toml")) else {
        return Err(format!("there is no quizzes/{name}.toml"));
    };
    let mut inline = |text: &str, place: Place| renderer.inline(&Source::new(text, place));
    let (html, questions) = quiz::render(name, &source, &mut inline, shared.problems);
    let page = renderer.page.path.clone();
    let title = renderer.page.title.clone();
    shared.add_quiz(QuizEntry {
        name: name.to_owned(),
        page,
        title,
        questions,
    });
    Ok(Insert::Block { html })
}
