//! `{{#figure ransac-race outliers=0.5 id=fig-x | Caption}}`: a live figure with its poster, number
//! and caption.
//!
//! `controls="a b"`, `readouts="a b"` and `goals=none` (`one`, `all`) select what is shown beside
//! the picture, `play=button` what a reader can start; `claim="readout > 3"` is checked.

use crate::html::escape;
use crate::parse::outline::Instance;
use crate::parse::text::Request;
use crate::problems::{Place, name_list};
use crate::render::directive::{Directive, Parser};
use crate::render::directive::{ParsedText, Text};
use crate::render::insert::Insert;
use crate::render::page::{FigureEntry, PanelRequest};
use crate::render::pictures;
use crate::render::tokens::{PANEL, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::claims;
use crate::resolve::facts::Facts;
use crate::resolve::figures::Room;
use crate::resolve::posters::Posters;
use std::sync::Arc;

/// A figure as written in a chapter. `T` is the stage of its caption.
pub(super) struct Figure<T> {
    instance: Instance,
    caption: T,
    place: Place,
    /// Attributes that select what the page shows of it.
    shown: Vec<(String, String)>,
    claim: Option<String>,
    play: Option<String>,
}

/// A figure with its facts from the core.
pub(super) struct Answered {
    figure: Figure<Text>,
    facts: Arc<Facts>,
    posters: Posters,
    title: String,
    help: String,
}

impl Directive for Figure<ParsedText> {
    const NAME: &'static str = "figure";
    type Resolved = Answered;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let name = request.one_word("name key=value … | caption")?;
        let Some(caption) = &request.body else {
            return Err(format!(
                "figure {name} needs a caption: {{{{#figure {name} … | caption}}}}"
            ));
        };
        let Some(instance) = parser.outline.at(&request.place) else {
            return Err("a figure must stand in a paragraph of its own".to_owned());
        };
        let shown = ["controls", "readouts", "goals"].into_iter();
        let shown = shown.filter_map(|key| {
            let value = request.setting(key)?;
            Some((key.to_owned(), value.to_owned()))
        });
        Ok(Figure {
            instance: instance.clone(),
            caption: parser.text(caption),
            place: request.place.clone(),
            shown: shown.collect(),
            claim: request.setting("claim").map(str::to_owned),
            play: request.setting("play").map(str::to_owned),
        })
    }

    fn resolve(self, book: &Book) -> Result<Answered, String> {
        let Instance { name, settings, .. } = &self.instance;
        let names = book.gallery.names();
        if !names.contains(name) {
            return Err(format!(
                "unknown figure \"{name}\"; known figures: {}",
                name_list(&names)
            ));
        }
        let facts = book.facts(name, settings)?;
        check_shown(&self.shown, &facts).map_err(|error| format!("figure {name}: {error}"))?;
        if let Some(claim) = &self.claim {
            claims::check(claim, &facts)?;
        }
        if let Some(button) = &self.play {
            facts.check_names("controls", button)?;
        }
        let posters = book.posters(name, settings, Room::all_for(facts.aspect()))?;
        let (title, help) = book.gallery.about(name);
        Ok(Answered {
            figure: Figure {
                instance: self.instance,
                caption: self.caption.resolve(book),
                place: self.place,
                shown: self.shown,
                claim: self.claim,
                play: self.play,
            },
            facts,
            posters,
            title,
            help,
        })
    }

    fn render(answered: Answered, page: &mut Writer) -> Insert {
        let html = answered.html(page);
        Insert::Block { html }
    }
}

impl<T> Figure<T> {
    fn shows_goals(&self) -> bool {
        shows_goals(&self.shown)
    }
}

fn shows_goals(shown: &[(String, String)]) -> bool {
    let mut shown = shown.iter();
    !shown.any(|(key, value)| key == "goals" && value == "none")
}

/// Checks the selection of what a page shows of a figure.
fn check_shown(shown: &[(String, String)], facts: &Facts) -> Result<(), String> {
    for (key, value) in shown {
        match key.as_str() {
            "goals" if matches!(value.as_str(), "none" | "one" | "all") => {}
            "goals" => return Err(format!("goals={value}: it is none, one or all")),
            list => facts.check_names(list, value)?,
        }
    }
    if !shows_goals(shown) {
        return Ok(());
    }
    let mut goals = facts.ids("challenges").into_iter();
    let is_reached = |goal: &&str| {
        let shown = facts.shown(&format!("goal.{goal}"));
        shown.is_ok_and(|shown| shown.text == "true")
    };
    match goals.find(is_reached) {
        None => Ok(()),
        Some(goal) => Err(format!(
            "its goal \"{goal}\" is reached before the reader has done anything: show another state, or goals=none"
        )),
    }
}

impl Answered {
    fn html(self, page: &mut Writer) -> String {
        let Answered {
            figure,
            facts,
            posters,
            title,
            help,
        } = self;
        let Instance {
            name, id, settings, ..
        } = &figure.instance;
        if figure.shows_goals() {
            let goals = facts.ids("challenges").into_iter();
            let goals = goals.map(|goal| format!("{name}/{goal}"));
            page.page.goals.extend(goals);
        }
        let number = page.page.next_figure_number();
        let sizes = posters.sizes();
        let pictures = pictures::add(page, name, posters);
        let description = facts.description();
        page.page.figures.push(FigureEntry {
            name: name.clone(),
            id: id.clone(),
            number: number.clone(),
            poster: pictures.poster,
            description: description.to_owned(),
            place: figure.place,
        });
        page.page.words.push_str(description);
        page.page.words.push(' ');
        let caption = figure.caption.inline(page);
        let attributes = || settings.iter().chain(&figure.shown);
        let panel = page.page.panels.len();
        page.page.panels.push(PanelRequest {
            name: name.clone(),
            title,
            help,
            snapshot: facts.snapshot().clone(),
            attributes: attributes().cloned().collect(),
            sizes,
        });
        let mut attributes: String = attributes()
            .map(|(key, value)| format!(" {}=\"{}\"", escape(key), escape(value)))
            .collect();
        if let Some(button) = &figure.play {
            attributes.push_str(&format!(" data-play=\"{}\"", escape(button)));
        }
        format!(
            "<figure class=\"epipole\" id=\"{id}\">\n\
             <epipole-figure name=\"{name}\"{attributes}>{panel}\
             <picture>{sources}<img src=\"{src}\" alt=\"{alt}\" {loading} decoding=\"async\">\
             </picture></epipole-figure>\n\
             <figcaption><a class=\"figure-number\" href=\"#{id}\">Figure {number}</a> {caption}</figcaption>\n\
             </figure>\n",
            id = escape(id),
            panel = token(PANEL, &panel.to_string()),
            alt = escape(description),
            loading = page.page.loading_of_last_figure(),
            sources = pictures.sources,
            src = pictures.src,
        )
    }
}
