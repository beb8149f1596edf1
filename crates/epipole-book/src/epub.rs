//! The book as an EPUB 3 file, with an XHTML file for each page.

mod archive;
mod figures;
mod links;
mod package;
mod questions;
mod xhtml;

use crate::edition::tree::Tree;
use crate::edition::{self, AnswerLinks, Edition, EditionOptions, filled, parts};
use crate::html::path_to_root;
use crate::phases::Phases;
use crate::reading::Outcome;
use crate::render::page::Page;
use crate::resolve::figures::Gallery;
use crate::tools::read;
use crate::write::assets;
use anyhow::{Context, Result, bail};
use links::{Places, xhtml_path};
use package::{FOLDER, Item, Package};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

const STYLES: &str = "book.css";
/// File name in the style sheet.
const MATH_FONT: &str = "math.woff2";

/// Options of the file.
#[derive(Debug, Clone)]
pub struct EpubOptions {
    /// Options of any edition.
    pub edition: EditionOptions,
    /// Time of the last change in UTC, such as `2026-01-31T12:00:00Z`.
    pub modified: String,
    /// Whether to embed the math font: without one, brackets do not grow with matrices.
    pub font: bool,
}

/// Variables of `page.hbs`.
#[derive(Serialize)]
struct Data<'a> {
    language: &'a str,
    title: &'a str,
    root: String,
    content: String,
}

/// Variables of `title.hbs`.
#[derive(Serialize)]
struct Title<'a> {
    language: &'a str,
    title: &'a str,
    description: &'a str,
    authors: String,
    address: Option<&'a str>,
}

/// Writes the file.
///
/// # Errors
/// A missing tool or an unreadable folder. Problems of the content are [`Outcome::Problems`].
pub fn epub(options: &EpubOptions, gallery: &dyn Gallery, phases: &Phases) -> Result<Outcome> {
    let EpubOptions {
        modified, edition, ..
    } = options;
    if !package::is_time(modified) {
        bail!("\"{modified}\" is no time in UTC: write it as 2026-01-31T12:00:00Z");
    }
    let (project, out) = (&edition.project, &edition.out);
    edition::make(edition, AnswerLinks::Both, gallery, phases, |edition| {
        let files = phases.run("convert pages", 0, |_| files(options, &edition))?;
        let count = files.len();
        let bytes = phases.run("compress", 0, |_| archive::pack(&files))?;
        let folder = out.parent().unwrap_or(project);
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        std::fs::write(out, bytes).with_context(|| format!("cannot write {}", out.display()))?;
        Ok(Outcome::Built {
            pages: edition.pages.len(),
            files: count,
        })
    })
}

/// Returns the files below [`FOLDER`], and the one that names the package.
fn files(options: &EpubOptions, edition: &Edition) -> Result<BTreeMap<String, Vec<u8>>> {
    let project = &options.edition.project;
    let web = project.join("web/epub");
    let mut trees: Vec<(&Page, Tree)> = edition
        .pages
        .iter()
        .map(|page| (page, plain(page, edition)))
        .collect();
    let places = Places::of(&trees, edition.address.as_deref());
    let cover = trees
        .iter()
        .find_map(|(page, tree)| figures::first(tree, &page.path));
    let mut pictures = BTreeSet::new();
    let mut files = BTreeMap::new();
    let mut items = Vec::new();
    for (page, tree) in &mut trees {
        places.lead(tree, &page.path);
        pictures.extend(figures::paths(tree, &page.path));
        let (content, properties) = xhtml::xhtml(tree);
        let data = Data {
            language: edition.language(),
            title: &page.title,
            root: path_to_root(&page.path),
            content,
        };
        let path = xhtml_path(&page.path);
        files.insert(path.clone(), filled(&web.join("page.hbs"), &data)?);
        items.push(Item::page(path, properties));
    }
    let book = &edition.config.book;
    let title = Title {
        language: edition.language(),
        title: edition.title(),
        description: book.description.as_deref().unwrap_or_default(),
        authors: book.authors.join(", "),
        address: edition.address.as_deref(),
    };
    files.insert(
        "title.xhtml".to_owned(),
        filled(&web.join("title.hbs"), &title)?,
    );
    let mut parts = parts(&edition.contents, &edition.pages);
    for page in parts.iter_mut().flat_map(|part| &mut part.pages) {
        page.path = xhtml_path(&page.path);
        for section in &mut page.sections {
            section.path = xhtml_path(&section.path);
        }
    }
    let mut package = Package::new(edition, &options.modified, parts, items);
    package.add_pictures(&pictures, cover.as_deref())?;
    let font = match options.font {
        true => {
            package.add_font(MATH_FONT);
            let letters = assets::used_letters(&edition.pages);
            Some((MATH_FONT.to_owned(), assets::math_font(project, &letters)?))
        }
        false => None,
    };
    files.insert(
        "contents.xhtml".to_owned(),
        filled(&web.join("contents.hbs"), &package)?,
    );
    files.insert(
        "package.opf".to_owned(),
        filled(&web.join("package.hbs"), &package)?,
    );
    let texts = files
        .into_iter()
        .map(|(path, text)| (path, text.into_bytes()));
    let mut files: BTreeMap<String, Vec<u8>> = texts.chain(font).collect();
    files.insert(STYLES.to_owned(), read(&web.join(STYLES))?);
    for path in pictures {
        let bytes = (edition.files.get(&path))
            .with_context(|| format!("the picture {path} is not among the files of the book"))?;
        files.insert(path, bytes.clone());
    }
    let files = files.into_iter();
    let files = files.map(|(path, bytes)| (format!("{FOLDER}/{path}"), bytes));
    let container = ("META-INF/container.xml".to_owned(), package::container());
    Ok(files.chain([container]).collect())
}

/// Returns a page whose figures and questions need no browser.
fn plain(page: &Page, edition: &Edition) -> Tree {
    let mut tree = Tree::parse(&page.html);
    figures::flatten(&mut tree, &page.path, edition.address.as_deref());
    questions::flatten(&mut tree);
    // Browsers place it beside the title.
    let rest = tree.all("h1 ~ *");
    if let (Some(&next), Some(&time)) = (rest.first(), tree.all(".reading-time").first()) {
        tree.move_before(next, time);
    }
    if edition.address.is_none() {
        for notebook in tree.all(".notebook") {
            tree.remove(notebook);
        }
    }
    tree
}
