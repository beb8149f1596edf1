//! The template of a page, `web/theme/index.hbs`, and its variables.

use super::assets::Assets;
use super::cards::Card;
use super::policy::{CONTENT_SECURITY_POLICY, PROGRAM_POLICY};
use super::published::Published;
use crate::html::path_to_root;
use crate::parse::book::Entry;
use crate::render::links::LAB_FOLDER;
use crate::render::page::Page;
use anyhow::{Context, Result};
use handlebars::Handlebars;
use mdbook_driver::config::Config;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Page for addresses that do not exist.
pub(crate) const NOT_FOUND: &str = "404.html";

/// The template and the content shared by all pages.
pub(crate) struct Template<'a> {
    handlebars: Handlebars<'static>,
    book_title: String,
    description: String,
    language: String,
    /// Facts for search engines, if the address of the published book is known.
    published: Option<Published>,
    /// Cards by the path of their page.
    cards: BTreeMap<String, Card>,
    assets: &'a Assets,
    search: &'a str,
    has_manual: bool,
    has_js_reference: bool,
    live: bool,
}

#[derive(Serialize)]
struct Data<'a> {
    language: &'a str,
    /// `Chapter · Book`; on the first page only the book.
    title: String,
    book_title: &'a str,
    description: &'a str,
    /// Address of the published page.
    canonical: Option<&'a str>,
    /// Facts for search engines, as JSON.
    structured: Option<String>,
    /// Preview picture for links to the published page.
    card: Option<Card>,
    /// Path from this page to the root of the site: empty or `../`s.
    root: &'a str,
    policy: &'a str,
    content: &'a str,
    page_class: &'a str,
    assets: &'a Assets,
    has_figures: bool,
    /// Whether it contains the list of references: the italic font of its titles is then preloaded,
    /// to avoid a layout shift.
    has_references: bool,
    /// Goals of a chapter's figures, each `figure/goal`, separated by spaces.
    goals: Option<String>,
    search: &'a str,
    /// Whether the manual of the Python package is part of the site.
    has_manual: bool,
    /// Whether the reference of the npm package is part of the site.
    has_js_reference: bool,
    live: bool,
    #[serde(flatten)]
    nav: &'a Nav,
}

/// Position of a page in the book.
#[derive(Serialize, Default)]
pub(crate) struct Nav {
    entries: Vec<NavEntry>,
    previous: Option<NavLink>,
    next: Option<NavLink>,
}

#[derive(Serialize, Default)]
struct NavEntry {
    part: Option<String>,
    separator: bool,
    chapter: bool,
    number: Option<String>,
    title: String,
    path: Option<String>,
    /// `aria-current` of the entry for this page or its parent.
    current: Option<&'static str>,
    sections: Vec<NavSection>,
}

#[derive(Serialize)]
struct NavSection {
    id: String,
    html: String,
}

#[derive(Serialize)]
struct NavLink {
    number: Option<String>,
    title: String,
    path: String,
}

impl Nav {
    /// Returns the position of `pages[index]`; beyond the last page, a position outside the book.
    pub(crate) fn new(entries: &[Entry], pages: &[Page], index: usize) -> Nav {
        let current = pages.get(index);
        let link = |page: &Page| NavLink {
            number: page.number.clone(),
            title: page.title.clone(),
            path: page.path.clone(),
        };
        let entries = entries
            .iter()
            .map(|entry| match entry {
                Entry::Part(title) => NavEntry {
                    part: Some(title.clone()),
                    ..NavEntry::default()
                },
                Entry::Separator => NavEntry {
                    separator: true,
                    ..NavEntry::default()
                },
                Entry::Chapter {
                    number,
                    title,
                    path,
                } => {
                    let page = current.filter(|page| path.as_ref() == Some(&page.path));
                    let part = current.filter(|page| path.is_some() && *path == page.parent);
                    let sections = page.map(sections).unwrap_or_default();
                    NavEntry {
                        chapter: true,
                        number: number.clone(),
                        title: title.clone(),
                        path: path.clone(),
                        current: page.map(|_| "page").or(part.map(|_| "true")),
                        sections,
                        ..NavEntry::default()
                    }
                }
            })
            .collect();
        // Pages of the same list: chapters, or the subpages of one page.
        let is_beside = |page: &&Page| current.is_none_or(|current| page.parent == current.parent);
        let previous = index.checked_sub(1).and_then(|before| pages.get(before));
        let next = pages.get(index + 1);
        Nav {
            entries,
            previous: previous.filter(is_beside).map(link),
            next: next.filter(is_beside).map(link),
        }
    }
}

fn sections(page: &Page) -> Vec<NavSection> {
    let second = page.headings.iter().filter(|heading| heading.level == 2);
    second
        .map(|heading| NavSection {
            id: heading.id.clone(),
            html: heading.html.clone(),
        })
        .collect()
}

impl<'a> Template<'a> {
    pub(crate) fn load(
        file: &Path,
        config: &Config,
        assets: &'a Assets,
        search: &'a str,
        has_manual: bool,
        has_js_reference: bool,
        live: bool,
    ) -> Result<Template<'a>> {
        let source = std::fs::read_to_string(file)
            .with_context(|| format!("{} cannot be read", file.display()))?;
        let mut handlebars = Handlebars::new();
        handlebars.set_strict_mode(true);
        handlebars
            .register_template_string("page", source)
            .with_context(|| format!("{} is not a template", file.display()))?;
        Ok(Template {
            handlebars,
            book_title: config
                .book
                .title
                .clone()
                .unwrap_or_else(|| "Book".to_owned()),
            description: config.book.description.clone().unwrap_or_default(),
            language: config
                .book
                .language
                .clone()
                .unwrap_or_else(|| "en".to_owned()),
            published: Published::of(config),
            cards: BTreeMap::new(),
            assets,
            search,
            has_manual,
            has_js_reference,
            live,
        })
    }

    /// Takes the cards of the pages, by their paths.
    pub(crate) fn add_cards(&mut self, cards: BTreeMap<String, Card>) {
        self.cards = cards;
    }

    /// Returns the HTML of a page.
    pub(crate) fn page(&self, page: &Page, nav: &Nav) -> Result<String> {
        let title = if page.path == "index.html" {
            self.book_title.clone()
        } else {
            format!("{} · {}", page.title, self.book_title)
        };
        let description = if page.description.is_empty() {
            &self.description
        } else {
            &page.description
        };
        // Servers send that page for any address.
        let is_anywhere = page.path == NOT_FOUND;
        let root = match &self.published {
            Some(book) if is_anywhere => book.folder().to_owned(),
            _ => path_to_root(&page.path),
        };
        let published = self.published.as_ref().filter(|_| !is_anywhere);
        let canonical = published.map(|book| book.address_of(page));
        let class = if page.number.is_some() {
            "chapter"
        } else {
            "plain"
        };
        let data = Data {
            language: &self.language,
            title,
            book_title: &self.book_title,
            description,
            canonical: canonical.as_deref(),
            card: published.and_then(|book| Some(book.with_address(self.cards.get(&page.path)?))),
            structured: published.and_then(|book| book.facts(page, description)),
            root: &root,
            policy: match page.has_programs {
                true => PROGRAM_POLICY,
                false => CONTENT_SECURITY_POLICY,
            },
            content: &page.html,
            page_class: class,
            assets: self.assets,
            has_figures: !page.figures.is_empty() && self.assets.elements.is_some(),
            has_references: page.has_references,
            goals: page.number.as_ref().map(|_| page.goal_list()),
            search: self.search,
            has_manual: self.has_manual,
            has_js_reference: self.has_js_reference,
            live: self.live,
            nav,
        };
        let html = self.handlebars.render("page", &data);
        html.with_context(|| format!("the page {} cannot be made", page.path))
    }

    /// Returns the page for addresses that do not exist. Its links start at the root of the server
    /// if the address of the book is known; otherwise they are relative to the folder of the site.
    pub(crate) fn not_found(&self, entries: &[Entry], pages: &[Page]) -> Result<String> {
        let page = Page {
            path: NOT_FOUND.to_owned(),
            title: "Page not found".to_owned(),
            html: "<h1>There is no such page</h1>\n<p>The address may have changed. The contents \
                   and the search lead to every chapter.</p>\n"
                .to_owned(),
            ..Page::default()
        };
        self.page(&page, &Nav::new(entries, pages, pages.len() + 1))
    }

    /// Returns a placeholder for the Lab, which the book links to: building the Lab takes minutes.
    pub(crate) fn without_lab(&self, entries: &[Entry], pages: &[Page]) -> Result<String> {
        let page = Page {
            path: format!("{LAB_FOLDER}/index.html"),
            title: "The Lab".to_owned(),
            html: "<h1>The Lab</h1>\n<p>The Lab takes your own photographs all the way to a measured cloud of points. \
                   It is not part of this copy of the book: whoever builds the book adds it with <code>make \
                   lab</code>, which takes some minutes. The <a href=\"../index.html\">book</a> works \
                   without it.</p>\n"
                .to_owned(),
            ..Page::default()
        };
        self.page(&page, &Nav::new(entries, pages, pages.len() + 1))
    }
}
