//! `{{#gallery}}`: every figure with its settings, readouts and actions, as reported by the figure
//! itself, and a snippet for other pages. A script keeps the snippets at the state set by the
//! reader.

use crate::html::{escape, path_to_root};
use crate::parse::text::Request;
use crate::problems::Place;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::page::{FigureEntry, Heading, PanelRequest};
use crate::render::pictures;
use crate::render::tokens::{PANEL, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::facts::Facts;
use crate::resolve::figures::{Room, frame_path};
use crate::resolve::posters::Posters;
use serde_json::Value;
use std::sync::Arc;

/// The list of all figures.
pub(super) struct Gallery(Place);

/// A figure in its first state.
struct Exhibit {
    name: String,
    title: String,
    help: String,
    facts: Arc<Facts>,
    posters: Posters,
}

/// All figures.
pub(super) struct Exhibits(Vec<Exhibit>, Place);

impl Directive for Gallery {
    const NAME: &'static str = "gallery";
    type Resolved = Exhibits;

    fn parse(request: &Request, _: &Parser) -> Result<Self, String> {
        Ok(Gallery(request.place.clone()))
    }

    fn resolve(self, book: &Book) -> Result<Exhibits, String> {
        let names = book.gallery.names().into_iter();
        let exhibits: Result<_, String> = names.map(|name| exhibit(name, book)).collect();
        Ok(Exhibits(exhibits?, self.0))
    }

    fn render(Exhibits(exhibits, place): Exhibits, page: &mut Writer) -> Insert {
        let exhibits = exhibits.into_iter();
        let html = exhibits.map(|exhibit| exhibit.html(page, &place)).collect();
        Insert::Block { html }
    }
}

fn exhibit(name: String, book: &Book) -> Result<Exhibit, String> {
    let facts = book.facts(&name, &[])?;
    let posters = book.posters(&name, &[], Room::all_for(facts.aspect()))?;
    let (title, help) = book.gallery.about(&name);
    Ok(Exhibit {
        name,
        title,
        help,
        facts,
        posters,
    })
}

impl Exhibit {
    fn html(self, page: &mut Writer, place: &Place) -> String {
        let Exhibit {
            name,
            title,
            help,
            facts,
            posters,
        } = self;
        let sizes = posters.sizes();
        let pictures = pictures::add(page, &name, posters);
        let snapshot = facts.snapshot();
        let page = &mut page.page;
        let id = format!("figure-{name}");
        page.headings.push(Heading {
            level: 2,
            id: name.clone(),
            title: title.clone(),
            html: escape(&title),
        });
        page.start_section(&name, &title);
        page.words.push_str(facts.description());
        let number = page.next_figure_number();
        page.figures.push(FigureEntry {
            id: id.clone(),
            number,
            place: place.clone(),
        });
        let panel = token(PANEL, &page.panels.len().to_string());
        page.panels.push(PanelRequest {
            name: name.clone(),
            title: title.clone(),
            help: help.clone(),
            snapshot: snapshot.clone(),
            attributes: Default::default(),
            sizes,
        });
        let root = path_to_root(&page.path);
        let frame = frame_path(&name);
        format!(
            "<section class=\"gallery\" data-name=\"{name}\">\n\
             <h2 id=\"{name}\"><a href=\"#{name}\">{title}</a></h2>\n\
             <figure class=\"epipole\" id=\"{id}\">\n\
             <epipole-figure name=\"{name}\">{panel}<picture>{sources}<img src=\"{src}\" alt=\"{alt}\" \
             {loading} decoding=\"async\"></picture></epipole-figure>\n\
             <figcaption><code>{name}</code> {alt}</figcaption>\n</figure>\n\
             <p>{help} Its own page, for frames: <a class=\"own-page\" href=\"{root}{frame}\">{frame}</a>.</p>\n\
             {snippet}{settings}{readouts}{buttons}{keys}</section>\n",
            title = escape(&title),
            sources = pictures.sources,
            src = pictures.src,
            alt = escape(facts.description()),
            loading = page.loading_of_last_figure(),
            help = escape(&help),
            snippet = snippet(&name),
            settings = settings_table(snapshot),
            readouts = readouts_table(snapshot),
            buttons = buttons(snapshot),
            keys = keys(snapshot),
        )
    }
}

/// The code that embeds a figure in another site; the page's script knows further kinds of pages.
fn snippet(name: &str) -> String {
    let code = format!("<epipole-figure name=\"{name}\"></epipole-figure>");
    format!(
        "<div class=\"listing snippet\"><div class=\"listing-bar\"><p class=\"listing-title\">For your page</p>\
         <button type=\"button\" class=\"copy\" hidden>Copy</button></div>\
         <div class=\"listing-part\"><pre><code>{}</code></pre></div></div>\n",
        escape(&code)
    )
}

fn entries<'a>(snapshot: &'a Value, list: &str) -> impl Iterator<Item = &'a Value> {
    snapshot[list].as_array().into_iter().flatten()
}

fn words<'a>(entry: &'a Value, key: &str) -> &'a str {
    entry[key].as_str().unwrap_or_default()
}

/// A number or a truth as an attribute takes it.
fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null => String::new(),
        other => other.to_string(),
    }
}

fn table(summary: &str, columns: &[&str], rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let head: String = columns
        .iter()
        .map(|column| format!("<th scope=\"col\">{column}</th>"))
        .collect();
    let body: String = rows
        .iter()
        .map(|cells| {
            let mut cells = cells.iter();
            let name = cells.next().map_or("", String::as_str);
            let rest: String = cells
                .map(|cell| format!("<td>{}</td>", escape(cell)))
                .collect();
            format!(
                "<tr><th scope=\"row\"><code>{}</code></th>{rest}</tr>\n",
                escape(name)
            )
        })
        .collect();
    format!(
        "<details><summary>{summary}</summary>\n<div class=\"table\"><table>\n\
         <thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n</details>\n"
    )
}

/// Everything that an attribute, a property or an address can set.
fn settings_table(snapshot: &Value) -> String {
    let controls = entries(snapshot, "controls").filter_map(|control| {
        let values = match words(control, "kind") {
            "slider" => format!(
                "{} to {}, in steps of {}",
                plain(&control["min"]),
                plain(&control["max"]),
                plain(&control["step"])
            ),
            "toggle" => "true or false".to_owned(),
            "choice" => {
                let options = entries(control, "options").filter_map(|option| option[0].as_str());
                options.collect::<Vec<_>>().join(", ")
            }
            _ => return None,
        };
        let (id, label) = (words(control, "id"), words(control, "label"));
        Some(vec![
            id.to_owned(),
            label.to_owned(),
            values,
            plain(&control["default"]),
        ])
    });
    let handles = entries(snapshot, "handles").map(|handle| {
        let digits = handle["digits"].as_u64().unwrap_or(2) as usize;
        let place = |axis: &str| handle[axis].as_f64().unwrap_or_default();
        vec![
            words(handle, "id").to_owned(),
            words(handle, "label").to_owned(),
            "a point: x,y".to_owned(),
            format!("{:.digits$},{:.digits$}", place("x"), place("y")),
        ]
    });
    let rows: Vec<Vec<String>> = controls.chain(handles).collect();
    let columns = ["Name", "Label", "Values", "At first"];
    table("What can be set", &columns, &rows)
}

fn readouts_table(snapshot: &Value) -> String {
    let rows: Vec<Vec<String>> = entries(snapshot, "readouts")
        .map(|readout| {
            let shown = ["id", "label", "text"].map(|key| words(readout, key).to_owned());
            shown.to_vec()
        })
        .collect();
    table("What can be read", &["Name", "Label", "At first"], &rows)
}

fn buttons(snapshot: &Value) -> String {
    let rows: Vec<Vec<String>> = entries(snapshot, "controls")
        .filter(|control| words(control, "kind") == "button")
        .map(|button| {
            vec![
                words(button, "id").to_owned(),
                words(button, "label").to_owned(),
            ]
        })
        .collect();
    table("What can be pressed", &["Name", "Label"], &rows)
}

/// Keyboard help for the items of this figure, matching `web/src/handles.ts`.
fn keys(snapshot: &Value) -> String {
    let has = |list: &str, what: &dyn Fn(&Value) -> bool| entries(snapshot, list).any(what);
    let points = has("handles", &|_| true);
    let removable = has("handles", &|handle| handle["removable"] == true);
    let sliders = has("controls", &|control| words(control, "kind") == "slider");
    let spaces = has("spaces", &|_| true);
    let panels = snapshot["layout"]["panels"].as_array();
    let clickable = panels
        .into_iter()
        .flatten()
        .any(|panel| panel["clickable"] == true);
    let mut rows = vec![("Tab", "to the next thing that can be operated, and out")];
    if points || sliders {
        rows.push((
            "arrows",
            "one step of the point or slider that has the focus",
        ));
    }
    if points {
        rows.push(("Shift and arrows", "a fifth of a step of the point"));
    }
    if points || sliders {
        rows.push(("Page Up, Page Down", "several steps"));
        rows.push(("Home, End", "as far as it goes"));
    }
    if removable {
        rows.push(("Delete", "removes the point"));
    }
    if spaces {
        rows.push((
            "+, −",
            "larger and smaller, on the point that turns the space",
        ));
    }
    if clickable {
        rows.push((
            "Enter",
            "clicks where the crosshair stands, which arrows move",
        ));
    }
    rows.push(("Escape", "gives the focus back to the page"));
    let rows: Vec<Vec<String>> = rows
        .into_iter()
        .map(|(key, deed)| vec![key.to_owned(), deed.to_owned()])
        .collect();
    table("Keys", &["Key", "What it does"], &rows)
}
