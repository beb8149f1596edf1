//! `{{#gallery}}`: a list of all figures. Each has its own page with its settings, readouts and
//! keys, as reported by the figure itself, and a snippet for other pages, which a script updates to
//! the state set by the reader.

mod tables;

use crate::html::{escape, path_to_root};
use crate::parse::text::Request;
use crate::problems::Place;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::page::{FigureEntry, Heading, Page, PanelRequest};
use crate::render::pictures;
use crate::render::tokens::{CHAPTERS_OF_FIGURE, PANEL, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::facts::Facts;
use crate::resolve::figures::{Room, frame_path};
use crate::resolve::posters::Posters;
use std::sync::Arc;

/// The list of all figures.
pub(super) struct Gallery(Place);

/// A figure in its initial state.
struct Exhibit {
    name: String,
    title: String,
    help: String,
    facts: Arc<Facts>,
    posters: Posters,
    /// The poster for the list.
    small: Posters,
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
        let items: String = exhibits.map(|exhibit| exhibit.add(page, &place)).collect();
        let html = format!("<ul class=\"gallery\">\n{items}</ul>\n");
        Insert::Block { html }
    }
}

fn exhibit(name: String, book: &Book) -> Result<Exhibit, String> {
    let facts = book.facts(&name, &[])?;
    let posters = book.posters(&name, &[], Room::all_for(facts.aspect()))?;
    let small = book.posters(&name, &[], &[Room::Phone])?;
    let (title, help) = book.gallery.about(&name);
    Ok(Exhibit {
        name,
        title,
        help,
        facts,
        posters,
        small,
    })
}

impl Exhibit {
    /// Adds the figure's own page. Returns its item in the list.
    fn add(mut self, list: &mut Writer, place: &Place) -> String {
        let item = self.item(list);
        let page = self.page(list, place);
        list.page.parts.push(page);
        item
    }

    fn path(&self) -> String {
        format!("figures/{}.html", self.name)
    }

    fn item(&mut self, list: &mut Writer) -> String {
        let pictures = pictures::add(list, &self.name, std::mem::take(&mut self.small));
        list.page.words.push_str(&format!("{} ", self.title));
        format!(
            "<li id=\"{name}\"><a href=\"{root}{path}\"><picture>{sources}<img src=\"{src}\" alt=\"\" \
             loading=\"lazy\" decoding=\"async\"></picture> <span>{title}</span></a> \
             <code>{name}</code></li>\n",
            name = self.name,
            root = path_to_root(&list.page.path),
            path = self.path(),
            sources = pictures.sources,
            src = pictures.src,
            title = escape(&self.title),
        )
    }

    fn page(self, list: &Writer, place: &Place) -> Page {
        let page = Page {
            path: self.path(),
            title: self.title.clone(),
            parent: Some(list.page.path.clone()),
            ..Page::default()
        };
        let Exhibit {
            name,
            title,
            help,
            facts,
            posters,
            ..
        } = self;
        let mut writer = list.beside(page);
        let sizes = posters.sizes();
        let pictures = pictures::add(&mut writer, &name, posters);
        let page = &mut writer.page;
        page.headings.push(Heading {
            level: 1,
            id: name.clone(),
            title: title.clone(),
            html: escape(&title),
        });
        page.start_section(&name, &title);
        page.words.push_str(facts.description());
        page.describe(|| facts.description().to_owned());
        page.figures.push(FigureEntry {
            name: name.clone(),
            id: format!("figure-{name}"),
            number: page.next_figure_number(),
            poster: pictures.poster,
            description: facts.description().to_owned(),
            place: place.clone(),
        });
        page.panels.push(PanelRequest {
            name: name.clone(),
            title: title.clone(),
            help: help.clone(),
            snapshot: facts.snapshot().clone(),
            attributes: Default::default(),
            sizes,
        });
        let root = path_to_root(&page.path);
        let frame = frame_path(&name);
        page.html = format!(
            "<p class=\"up\"><a href=\"{root}{list}\">{all}</a></p>\n\
             <h1 id=\"{name}\">{title}</h1>\n\
             <figure class=\"epipole\" id=\"figure-{name}\">\n\
             <epipole-figure name=\"{name}\">{panel}<picture>{sources}<img src=\"{src}\" alt=\"{alt}\" \
             {loading} decoding=\"async\"></picture></epipole-figure>\n\
             <figcaption><code>{name}</code> {alt}</figcaption>\n</figure>\n\
             <p>{help}</p>\n{chapters}\
             <section class=\"embedding\" data-name=\"{name}\">\n\
             {snippet}<p>Its page for frames: <a class=\"frame-page\" href=\"{root}{frame}\">{frame}</a>.</p>\n\
             {tables}</section>\n",
            list = list.page.path,
            all = escape(&list.page.title),
            title = escape(&title),
            panel = token(PANEL, "0"),
            sources = pictures.sources,
            src = pictures.src,
            alt = escape(facts.description()),
            loading = page.loading_of_last_figure(),
            help = escape(&help),
            chapters = token(CHAPTERS_OF_FIGURE, &name),
            snippet = snippet(&name),
            tables = tables::tables(facts.snapshot()),
        );
        page.end_section();
        writer.page
    }
}

/// Returns the code that embeds a figure in another site; the page's script knows further kinds of
/// pages.
fn snippet(name: &str) -> String {
    let code = format!("<epipole-figure name=\"{name}\"></epipole-figure>");
    format!(
        "<div class=\"listing snippet\"><div class=\"listing-bar\"><p class=\"listing-title\">For your page</p>\
         <button type=\"button\" class=\"copy\" hidden>Copy</button></div>\
         <div class=\"listing-part\"><pre><code>{}</code></pre></div></div>\n",
        escape(&code)
    )
}
