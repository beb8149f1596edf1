//! Terms of all pages: listed in the glossary, defined once, used anywhere.

use super::page::Page;
use crate::html::escape;
use crate::problems::{Place, Problems, name_list};
use std::collections::BTreeMap;

/// Converts a key to a name.
pub(crate) fn name_of(key: &str) -> String {
    key.replace('-', " ")
}

/// Returns the anchor of a definition on its page.
pub(crate) fn anchor_of(key: &str) -> String {
    format!("term-{key}")
}

/// Pages of the glossary and of all definitions.
pub(super) struct Terms {
    /// Path of the glossary.
    pub(super) glossary: String,
    /// Path and name of the page that defines a term, by key.
    definitions: BTreeMap<String, (String, String)>,
}

impl Terms {
    /// Reports terms that are used or defined without being listed, listed without being defined,
    /// or defined twice.
    pub(super) fn collect(pages: &[Page], problems: &Problems) -> Terms {
        let glossary = pages
            .iter()
            .find_map(|page| Some((&page.path, page.glossary.as_ref()?)));
        let mut definitions: BTreeMap<String, (String, String)> = BTreeMap::new();
        for page in pages {
            let name = match &page.number {
                Some(number) => format!("Chapter {number}"),
                None => page.title.clone(),
            };
            for (key, place) in &page.definitions {
                let entry = (page.path.clone(), name.clone());
                if let Some((_, first)) = definitions.insert(key.clone(), entry) {
                    let message = format!("\"{key}\" is defined in {first} already");
                    problems.report(place.clone(), message);
                }
            }
        }
        match glossary {
            Some((_, listed)) => check(pages, listed, &definitions, problems),
            None => {
                let marked = pages
                    .iter()
                    .find_map(|page| page.terms.iter().chain(&page.definitions).next());
                if let Some((_, place)) = marked {
                    let message = "a term is marked, but no chapter holds {{#glossary}}";
                    problems.report(place.clone(), message);
                }
            }
        }
        Terms {
            glossary: glossary.map(|(path, _)| path.clone()).unwrap_or_default(),
            definitions,
        }
    }

    /// Returns a link to the definition of a term; `root` is the path to the root of the site.
    pub(super) fn definition(&self, key: &str, root: &str) -> String {
        let Some((path, name)) = self.definitions.get(key) else {
            return String::new();
        };
        let (anchor, name) = (escape(&anchor_of(key)), escape(name));
        format!("<a class=\"ref\" href=\"{root}{path}#{anchor}\">{name}</a>")
    }
}

fn check(
    pages: &[Page],
    listed: &[(String, Place)],
    definitions: &BTreeMap<String, (String, String)>,
    problems: &Problems,
) {
    let known: Vec<&str> = listed.iter().map(|(key, _)| key.as_str()).collect();
    for page in pages {
        for (key, place) in page.terms.iter().chain(&page.definitions) {
            if !known.contains(&key.as_str()) {
                let known = name_list(&known);
                let message = format!("the glossary has no \"{key}\"; terms: {known}");
                problems.report(place.clone(), message);
            }
        }
    }
    for (key, place) in listed {
        if !definitions.contains_key(key) {
            let message = format!("no chapter defines \"{key}\": write {{{{#define {key}}}}}");
            problems.report(place.clone(), message);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marks(keys: &[&str], line: usize) -> Vec<(String, Place)> {
        let mark = |key: &&str| ((*key).to_owned(), Place::new("a.md", line));
        keys.iter().map(mark).collect()
    }

    fn page(path: &str, definitions: &[&str], terms: &[&str], glossary: Option<&[&str]>) -> Page {
        Page {
            path: path.to_owned(),
            title: "All terms".to_owned(),
            number: glossary.is_none().then(|| "4".to_owned()),
            definitions: marks(definitions, 1),
            terms: marks(terms, 2),
            glossary: glossary.map(|keys| marks(keys, 3)),
            ..Page::default()
        }
    }

    fn complaints(pages: &[Page]) -> Vec<String> {
        let problems = Problems::default();
        Terms::collect(pages, &problems);
        let problems = problems.sorted().into_iter();
        problems.map(|problem| problem.message).collect()
    }

    #[test]
    fn the_glossary_leads_to_the_definition() {
        let pages = [
            page("a.html", &["epipole"], &[], None),
            page("b.html", &[], &["epipole"], None),
            page("terms.html", &[], &[], Some(&["epipole"])),
        ];
        let problems = Problems::default();
        let terms = Terms::collect(&pages, &problems);
        assert!(problems.sorted().is_empty());
        assert_eq!(terms.glossary, "terms.html");
        assert_eq!(
            terms.definition("epipole", "../"),
            "<a class=\"ref\" href=\"../a.html#term-epipole\">Chapter 4</a>"
        );
    }

    #[test]
    fn dead_and_missing_terms_are_reported() {
        let glossary = |keys| page("terms.html", &[], &[], Some(keys));
        let unknown = [page("a.html", &[], &["epipol"], None), glossary(&[])];
        assert!(complaints(&unknown)[0].contains("the glossary has no \"epipol\""));
        let dead = [glossary(&["epipole"])];
        assert!(complaints(&dead)[0].contains("no chapter defines \"epipole\""));
        let twice = page("a.html", &["epipole", "epipole"], &[], None);
        let twice = complaints(&[twice, glossary(&["epipole"])]);
        assert_eq!(twice, ["\"epipole\" is defined in Chapter 4 already"]);
        let unlisted = complaints(&[page("a.html", &[], &["epipole"], None)]);
        assert!(unlisted[0].contains("no chapter holds {{#glossary}}"));
    }
}
