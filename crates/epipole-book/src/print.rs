//! The book as one document for paper, which `web/print/` lays out and prints.

use crate::edition::{self, AnswerLinks, Edition, EditionOptions, Part, filled, parts};
use crate::html::escape;
use crate::phases::Phases;
use crate::reading::Outcome;
use crate::render::page::{FigureEntry, Page};
use crate::resolve::figures::Gallery;
use crate::tools::read;
use crate::write::address::of_page;
use crate::write::assets;
use crate::write::disk::write;
use anyhow::{Result, anyhow};
use qrcode::QrCode;
use qrcode::render::svg;
use serde::Serialize;

/// Files of `web/print/` that belong to the document.
const PARTS: [&str; 2] = ["book.css", "arrange.js"];

#[derive(Serialize)]
struct Data {
    language: String,
    title: String,
    description: String,
    authors: String,
    address: Option<String>,
    css: String,
    parts: Vec<Part>,
    pages: Vec<DataPage>,
}

#[derive(Serialize)]
struct DataPage {
    path: String,
    title: String,
    number: String,
    class: &'static str,
    content: String,
    permalinks: Vec<Permalink>,
}

/// Address of a figure on the web, as text and as a QR code.
#[derive(Serialize)]
struct Permalink {
    figure: String,
    address: String,
    code: String,
}

/// Writes `print.html` and its files.
///
/// # Errors
/// A missing tool or an unreadable folder. Problems of the content are [`Outcome::Problems`].
pub fn print(options: &EditionOptions, gallery: &dyn Gallery, phases: &Phases) -> Result<Outcome> {
    edition::make(
        options,
        AnswerLinks::None,
        gallery,
        phases,
        |mut edition| {
            let used = assets::used_letters(&edition.pages);
            let assets = phases.run("bundle styles and fonts", 0, |_| {
                assets::make(&options.project, true, &used, None)
            })?;
            let mut files = std::mem::take(&mut edition.files);
            files.extend(assets.files.clone());
            let web = options.project.join("web/print");
            for name in PARTS {
                files.insert(format!("print/{name}"), read(&web.join(name))?);
            }
            let html = filled(&web.join("book.hbs"), &data(&edition, &assets.css)?)?;
            files.insert("print.html".to_owned(), html.into_bytes());
            phases.run("write", 0, |_| write(&files, &options.out))?;
            Ok(Outcome::Built {
                pages: edition.pages.len(),
                files: files.len(),
            })
        },
    )
}

fn data(edition: &Edition, css: &str) -> Result<Data> {
    let book = &edition.config.book;
    let page = |page: &Page| {
        let address = edition.address.as_deref();
        let permalinks = address.map(|root| permalinks(root, page));
        Ok(DataPage {
            path: page.path.clone(),
            title: page.title.clone(),
            number: page.number.clone().unwrap_or_default(),
            class: match page.number {
                Some(_) => "chapter",
                None => "plain",
            },
            content: page.html.clone(),
            permalinks: permalinks.transpose()?.unwrap_or_default(),
        })
    };
    Ok(Data {
        language: edition.language().to_owned(),
        title: edition.title().to_owned(),
        description: book.description.clone().unwrap_or_default(),
        authors: book.authors.join(", "),
        address: edition.address.clone(),
        css: css.to_owned(),
        parts: parts(&edition.contents, &edition.pages),
        pages: edition.pages.iter().map(page).collect::<Result<_>>()?,
    })
}

fn permalinks(root: &str, page: &Page) -> Result<Vec<Permalink>> {
    let permalink = |figure: &FigureEntry| {
        let address = format!("{}#{}", of_page(root, &page.path), figure.id);
        let code = QrCode::new(&address)
            .map_err(|error| anyhow!("{address} is no QR code: {error}"))?
            .render::<svg::Color>()
            .quiet_zone(false)
            .build();
        // Without the XML declaration, which is not allowed inside an element.
        let start = code.find("<svg").unwrap_or_default();
        Ok(Permalink {
            figure: figure.id.clone(),
            address: escape(&address),
            code: code[start..].to_owned(),
        })
    };
    page.figures.iter().map(permalink).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problems::Place;

    fn page() -> Page {
        Page {
            path: "rays.html".to_owned(),
            title: "Rays".to_owned(),
            number: Some("0".to_owned()),
            figures: vec![FigureEntry {
                name: "dot".to_owned(),
                id: "fig-dot".to_owned(),
                number: "0.1".to_owned(),
                poster: String::new(),
                description: String::new(),
                place: Place::new("rays.md", 3),
            }],
            ..Page::default()
        }
    }

    #[test]
    fn each_figure_has_its_address_on_the_web() {
        let all = permalinks("https://example.org/a/", &page()).unwrap();
        let [permalink] = &all[..] else {
            panic!("one figure, {} links", all.len())
        };
        assert_eq!(permalink.address, "https://example.org/a/rays.html#fig-dot");
        assert!(permalink.code.starts_with("<svg"), "{}", permalink.code);
    }
}
