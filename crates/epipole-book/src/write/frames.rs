//! `embed/<figure>.html`: the page of one figure, for frames on other pages. It contains poster and
//! text for readers without script; its address sets the figure. If the address of the book is
//! configured, each page links to its oEmbed data.

use super::address::address;
use super::assets::Assets;
use super::policy::CONTENT_SECURITY_POLICY;
use crate::html::escape;
use crate::render::page::Page;
use crate::render::pictures::{self, Pictures};
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::figures::{Room, frame_path};
use anyhow::{Context, Result, anyhow};
use handlebars::Handlebars;
use mdbook_driver::config::Config;
use serde::Serialize;
use serde_json::json;
use std::collections::BTreeMap;
use std::path::Path;

/// Height of a frame beyond the poster, for title, buttons, numbers and sliders, CSS pixels. A page
/// that listens receives the true height.
const BESIDE_POSTER: f64 = 300.0;

/// One figure, ready for its page.
pub(crate) struct Frame {
    name: String,
    title: String,
    description: String,
    sources: String,
    src: String,
    width: u32,
    height: f64,
    files: BTreeMap<String, Vec<u8>>,
}

/// Draws the posters of all figures in their initial state, on separate pages, whose files belong
/// to the site.
///
/// # Errors
/// The message of a figure that cannot be drawn.
pub(crate) fn draw(book: &Book) -> Result<Vec<Frame>> {
    let frame = |name: &String| {
        let facts = book.facts(name, &[])?;
        let posters = book.posters(name, &[], Room::all_for(facts.aspect()))?;
        let sizes = posters.sizes();
        let column = sizes
            .iter()
            .find(|(width, _)| *width == Room::Column.width());
        let (width, height) = column.copied().unwrap_or_default();
        let page = Page {
            path: frame_path(name),
            ..Page::default()
        };
        let mut writer = Writer::new(page, &[], book.problems);
        let Pictures { sources, src, .. } = pictures::add(&mut writer, name, posters);
        Ok(Frame {
            name: name.clone(),
            title: book.gallery.about(name).0,
            description: facts.description().to_owned(),
            sources,
            src,
            width,
            height,
            files: writer.page.files,
        })
    };
    let frames: Result<Vec<Frame>, String> = book.gallery.names().iter().map(frame).collect();
    frames.map_err(|problem| anyhow!(problem))
}

#[derive(Serialize)]
struct Data<'a> {
    language: &'a str,
    policy: &'a str,
    book_title: &'a str,
    title: &'a str,
    name: &'a str,
    description: &'a str,
    sources: &'a str,
    src: &'a str,
    oembed: Option<String>,
    assets: &'a Assets,
}

/// Adds the pages, made with `web/theme/frame.hbs`.
///
/// # Errors
/// An unreadable template.
pub(crate) fn add(
    files: &mut BTreeMap<String, Vec<u8>>,
    project: &Path,
    config: &Config,
    assets: &Assets,
    frames: Vec<Frame>,
) -> Result<()> {
    let file = project.join("web/theme/frame.hbs");
    let source = std::fs::read_to_string(&file)
        .with_context(|| format!("{} cannot be read", file.display()))?;
    let mut handlebars = Handlebars::new();
    handlebars.set_strict_mode(true);
    handlebars.register_template_string("frame", source)?;
    let address = address(config);
    let book_title = config.book.title.as_deref().unwrap_or("Book");
    for frame in frames {
        let path = frame_path(&frame.name);
        let described = path.replace(".html", ".json");
        let data = Data {
            language: config.book.language.as_deref().unwrap_or("en"),
            policy: CONTENT_SECURITY_POLICY,
            book_title,
            title: &frame.title,
            name: &frame.name,
            description: &frame.description,
            sources: &frame.sources,
            src: &frame.src,
            oembed: address.as_ref().map(|root| format!("{root}{described}")),
            assets,
        };
        let html = handlebars
            .render("frame", &data)
            .with_context(|| format!("the page {path} cannot be made"))?;
        files.insert(path.clone(), html.into_bytes());
        if let Some(root) = &address {
            let height = frame.height + BESIDE_POSTER;
            let facts = json!({
                "version": "1.0",
                "type": "rich",
                "provider_name": book_title,
                "provider_url": root,
                "title": frame.title,
                "width": frame.width,
                "height": height.ceil(),
                "html": snippet(&format!("{root}{path}"), &frame.title, height),
            });
            files.insert(described, facts.to_string().into_bytes());
        }
        files.extend(frame.files);
    }
    Ok(())
}

/// Returns the HTML that embeds the frame in another page.
fn snippet(address: &str, title: &str, height: f64) -> String {
    format!(
        "<iframe src=\"{}\" title=\"{}\" width=\"100%\" height=\"{}\" loading=\"lazy\" \
         allow=\"fullscreen; clipboard-write\"></iframe>",
        escape(address),
        escape(title),
        height.ceil()
    )
}
