//! References between pages, filled in and checked once all pages are rendered.

use super::page::Page;
use super::progress::{progress_table, solved_mark};
use super::terms::Terms;
use super::tokens::{
    CHAPTERS_OF_FIGURE, DEFINITION, NUMBER_OF_FIGURE, PAGE_OF_FIGURE, PAGE_OF_GLOSSARY,
    PAGE_OF_REFERENCES, PANEL, PROGRESS, SOLVED, fill,
};
use crate::html::{attributes, escape, forbidden_inline, path_to_root};
use crate::parse::content::Content;
use crate::problems::{Problems, name_list};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Page and number of each figure, by its anchor.
type Figures = BTreeMap<String, (String, String)>;

/// Fills in the tokens of all pages. `panels` are those of all pages, in order.
pub(crate) fn join(pages: &mut [Page], panels: &[String], problems: &Problems) {
    let figures = figures(pages);
    check_figures(pages, &figures, problems);
    let list = page_of_references(pages, problems);
    let terms = Terms::collect(pages, problems);
    let progress = progress_table(pages);
    let numbered = in_chapters(pages);
    let marks: Vec<String> = pages.iter().map(solved_mark).collect();
    let paths: Vec<String> = pages.iter().map(|page| page.path.clone()).collect();
    let mut panels = panels;
    for page in pages {
        let root = path_to_root(&page.path);
        let (own_panels, others) = panels.split_at(page.panels.len().min(panels.len()));
        panels = others;
        page.html = fill(&page.html, |kind, name| match kind {
            PAGE_OF_FIGURE => match figures.get(name) {
                Some((path, _)) if *path == page.path => format!("#{}", escape(name)),
                Some((path, _)) => format!("{root}{path}#{}", escape(name)),
                None => String::new(),
            },
            NUMBER_OF_FIGURE => figures
                .get(name)
                .map(|(_, number)| format!("Figure {number}"))
                .unwrap_or_default(),
            CHAPTERS_OF_FIGURE => links_to(numbered.get(name), &root),
            SOLVED => {
                // Chapters refer to each other's Markdown files.
                let wanted = Path::new(name).with_extension("html");
                let page = paths.iter().position(|path| Path::new(path) == wanted);
                page.map(|page| marks[page].clone()).unwrap_or_default()
            }
            PROGRESS => progress.replace("href=\"", &format!("href=\"{root}")),
            PANEL => name
                .parse()
                .ok()
                .and_then(|index: usize| own_panels.get(index))
                .map_or_else(String::new, |panel| {
                    format!("<template shadowrootmode=\"open\">{panel}</template>")
                }),
            PAGE_OF_REFERENCES => format!("{root}{list}"),
            PAGE_OF_GLOSSARY => format!("{root}{}", terms.glossary),
            DEFINITION => terms.definition(name, &root),
            _ => String::new(),
        });
    }
}

/// Reports broken links, missing files, and violations of the Content-Security-Policy.
pub(crate) fn check(pages: &[Page], content: &Content, problems: &Problems) {
    check_links(pages, problems);
    for page in pages {
        for wanted in &page.wanted_files {
            if !content.path(&wanted.path).is_file() {
                problems.report(wanted.place.clone(), &wanted.missing);
            }
        }
        if let Some(offence) = forbidden_inline(&page.html) {
            let place = content.place(&page.path.replace(".html", ".md"), 1);
            let message = format!("{offence}: pages hold no inline scripts and styles");
            problems.report(place, message);
        }
    }
}

fn figures(pages: &[Page]) -> Figures {
    let mut figures = Figures::new();
    for page in pages {
        for figure in &page.figures {
            let entry = (page.path.clone(), figure.number.clone());
            figures.insert(figure.id.clone(), entry);
        }
    }
    figures
}

/// Collects address and number of each figure in a numbered chapter, by its name.
fn in_chapters(pages: &[Page]) -> BTreeMap<String, Vec<(String, String)>> {
    let mut named: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for page in pages.iter().filter(|page| page.number.is_some()) {
        for figure in &page.figures {
            let address = format!("{}#{}", page.path, escape(&figure.id));
            let figures = named.entry(figure.name.clone()).or_default();
            figures.push((address, figure.number.clone()));
        }
    }
    named
}

/// Renders links to the occurrences of a figure in the book, by address and number.
fn links_to(places: Option<&Vec<(String, String)>>, root: &str) -> String {
    let Some(places) = places else {
        return String::new();
    };
    let links = places
        .iter()
        .map(|(address, number)| format!("<a href=\"{root}{address}\">Figure {number}</a>"));
    let links: Vec<String> = links.collect();
    format!("<p>In the book: {}.</p>\n", links.join(", "))
}

/// Reports references to figures that do not exist.
fn check_figures(pages: &[Page], figures: &Figures, problems: &Problems) {
    for (id, place) in pages.iter().flat_map(|page| &page.wanted_figures) {
        if !figures.contains_key(id) {
            let known: Vec<&String> = figures.keys().collect();
            let message = format!(
                "no figure is called \"{id}\"; figures: {}",
                name_list(&known)
            );
            problems.report(place.clone(), message);
        }
    }
}

/// Returns the page with the list of references; a missing one is reported if something is cited.
fn page_of_references(pages: &[Page], problems: &Problems) -> String {
    let list = pages.iter().find(|page| page.has_references);
    let cites = pages.iter().find_map(|page| page.cites.clone());
    if let (None, Some(place)) = (list, cites) {
        let message = "something is cited, but no chapter holds {{#references}}";
        problems.report(place, message);
    }
    list.map(|page| page.path.clone()).unwrap_or_default()
}

/// Reports links to pages or anchors that do not exist, and duplicate anchors.
fn check_links(pages: &[Page], problems: &Problems) {
    let mut anchors: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for page in pages {
        let mut ids = BTreeSet::new();
        for id in ids_of(&page.html) {
            if !ids.insert(id.clone())
                && let Some(figure) = page.figures.iter().rev().find(|figure| figure.id == id)
            {
                let message = format!("two elements are called \"{id}\": give this figure an id=…");
                problems.report(figure.place.clone(), message);
            }
        }
        anchors.insert(&page.path, ids);
    }
    for link in pages.iter().flat_map(|page| &page.links) {
        let written = &link.written;
        let Some(ids) = anchors.get(link.page.as_str()) else {
            let chapters: Vec<String> = pages
                .iter()
                .filter(|page| page.parent.is_none())
                .map(|page| page.path.replace(".html", ".md"))
                .collect();
            let known = name_list(&chapters);
            let message = format!("the link \"{written}\" leads to no chapter; chapters: {known}");
            problems.report(link.place.clone(), message);
            continue;
        };
        if let Some(fragment) = &link.fragment
            && !ids.contains(fragment)
        {
            let known: Vec<&String> = ids.iter().filter(|id| !id.starts_with("quiz-")).collect();
            let message = format!(
                "the link \"{written}\" leads to no section; anchors there: {}",
                name_list(&known)
            );
            problems.report(link.place.clone(), message);
        }
    }
}

/// Returns all `id`s of a page.
fn ids_of(html: &str) -> Vec<String> {
    let mut ids = Vec::new();
    let mut rest = html;
    while let Some(open) = rest.find('<') {
        rest = &rest[open + 1..];
        if !rest.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
            continue;
        }
        let name = rest
            .find(|c: char| !c.is_ascii_alphanumeric() && c != '-')
            .unwrap_or(rest.len());
        let (attributes, after) = attributes(&rest[name..]);
        ids.extend(
            attributes
                .into_iter()
                .filter(|(key, _)| key == "id")
                .map(|(_, id)| id),
        );
        rest = after;
    }
    ids
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids() {
        assert_eq!(
            ids_of("<p id=a><epipole-figure id=\"b\" x='>'></p> <c id=d"),
            ["a", "b", "d"]
        );
    }
}
