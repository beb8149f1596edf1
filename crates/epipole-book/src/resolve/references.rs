//! The works that the chapters cite: `content/references.toml`.

use crate::html::escape;
use crate::parse::source::Source;
use crate::problems::{Place, Problems};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A published work.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// `Family, Given` of each author.
    pub authors: Vec<String>,
    /// Year of publication.
    pub year: u16,
    /// Title.
    pub title: String,
    /// Where it appeared: journal, volume and pages, or publisher.
    #[serde(rename = "in")]
    pub venue: Option<String>,
    /// Digital object identifier, without `https://doi.org/`.
    pub doi: Option<String>,
    /// Where to read it, if there is no DOI.
    pub url: Option<String>,
}

/// All references by key.
#[derive(Debug, Default)]
pub struct References(BTreeMap<String, Reference>);

impl References {
    /// Reads the file; what is wrong goes to `problems`.
    pub fn parse(source: &Source, problems: &Problems) -> References {
        match toml::from_str::<BTreeMap<String, Reference>>(source.text()) {
            Ok(works) => {
                for (key, work) in &works {
                    if work.authors.is_empty() {
                        let at = source.text().find(&format!("[{key}]")).unwrap_or(0);
                        problems.report(source.place(at), format!("{key} has no authors"));
                    }
                }
                References(works)
            }
            Err(error) => {
                let at = error.span().map_or(0, |span| span.start);
                problems.report(source.place(at), error.message());
                References::default()
            }
        }
    }

    /// The keys, for messages.
    pub fn keys(&self) -> Vec<&str> {
        self.0.keys().map(String::as_str).collect()
    }

    /// `Hartley & Zisserman 2004`, or nothing if the key is unknown.
    pub fn label(&self, key: &str) -> Option<String> {
        self.0.get(key).map(Reference::label)
    }

    /// The list of all works, in the order of their first authors and years.
    pub fn list(&self) -> String {
        let mut works: Vec<(&String, &Reference)> = self.0.iter().collect();
        works.sort_by_key(|(key, work)| (work.authors.clone(), work.year, (*key).clone()));
        let mut html = String::from("<ul class=\"references\">\n");
        for (key, work) in works {
            html.push_str(&format!(
                "<li id=\"{}\">{}</li>\n",
                escape(key),
                work.html()
            ));
        }
        html.push_str("</ul>\n");
        html
    }
}

impl Reference {
    fn label(&self) -> String {
        let family = |author: &String| author.split(',').next().unwrap_or("").trim().to_owned();
        let families: Vec<String> = self.authors.iter().map(family).collect();
        let names = match &families[..] {
            [] => "Anonymous".to_owned(),
            [one] => one.clone(),
            [one, two] => format!("{one} & {two}"),
            [one, two, three] => format!("{one}, {two} & {three}"),
            [one, ..] => format!("{one} et al."),
        };
        format!("{names} {}", self.year)
    }

    fn html(&self) -> String {
        let given_first = |author: &String| match author.split_once(',') {
            Some((family, given)) => format!("{} {}", given.trim(), family.trim()),
            None => author.clone(),
        };
        let authors: Vec<String> = self.authors.iter().map(given_first).collect();
        let authors = match &authors[..] {
            [] => "Anonymous".to_owned(),
            [one] => one.clone(),
            [first @ .., last] => format!("{} and {last}", first.join(", ")),
        };
        let mut html = format!(
            "{} ({}). <cite>{}</cite>.",
            escape(&authors),
            self.year,
            escape(&self.title)
        );
        if let Some(venue) = &self.venue {
            html.push_str(&format!(" {}.", escape(venue)));
        }
        if let Some(doi) = &self.doi {
            let doi = escape(doi);
            html.push_str(&format!(" <a href=\"https://doi.org/{doi}\">doi:{doi}</a>"));
        } else if let Some(url) = &self.url {
            let url = escape(url);
            html.push_str(&format!(" <a href=\"{url}\">{url}</a>"));
        }
        html
    }
}

/// Citations as they appear in a sentence; `key`s that are unknown go to `problems`.
/// `page` is a token for the page with the list, replaced when all pages are known.
pub fn cite(
    keys: &[String],
    locator: Option<&str>,
    references: &References,
    page: &str,
    place: &Place,
    problems: &Problems,
) -> String {
    let mut links = Vec::new();
    for key in keys {
        match references.label(key) {
            Some(label) => links.push(format!(
                "<a class=\"cite\" href=\"{page}#{}\">{}</a>",
                escape(key),
                escape(&label)
            )),
            None => {
                let known = crate::problems::name_list(&references.keys());
                let message = format!("unknown reference \"{key}\"; known references: {known}");
                problems.report(place.clone(), message);
            }
        }
    }
    let mut html = links.join("; ");
    if let Some(locator) = locator {
        html.push_str(&format!(", {}", escape(locator)));
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOML: &str = r#"
[hartley1997]
authors = ["Hartley, Richard I."]
year = 1997
title = "In Defense of the Eight-Point Algorithm"
doi = "10.1109/34.601246"

[hartley2004]
authors = ["Hartley, Richard", "Zisserman, Andrew"]
year = 2004
title = "Multiple View Geometry in Computer Vision"
"#;

    #[test]
    fn labels_links_and_list() {
        let problems = Problems::default();
        let place = Place::new("references.toml", 1);
        let references = References::parse(&Source::new(TOML, place.clone()), &problems);
        let keys = ["hartley1997".to_owned(), "hartley2004".to_owned()];
        assert_eq!(
            cite(
                &keys,
                Some("§9.2"),
                &references,
                "references.html",
                &place,
                &problems
            ),
            "<a class=\"cite\" href=\"references.html#hartley1997\">Hartley 1997</a>; \
             <a class=\"cite\" href=\"references.html#hartley2004\">Hartley &amp; Zisserman 2004</a>, §9.2"
        );
        assert!(
            references
                .list()
                .contains("<li id=\"hartley1997\">Richard I. Hartley (1997).")
        );
        assert!(problems.sorted().is_empty());
        cite(
            &["nobody".to_owned()],
            None,
            &references,
            "",
            &place,
            &problems,
        );
        let message = problems.sorted()[0].to_string();
        let expected = "references.toml:1: unknown reference \"nobody\"; \
                        known references: hartley1997, hartley2004";
        assert_eq!(message, expected);
    }

    #[test]
    fn a_broken_file_names_its_line() {
        let problems = Problems::default();
        let source = Source::new(
            "[a]\nyear = 1\npages = 2\n",
            Place::new("references.toml", 1),
        );
        References::parse(&source, &problems);
        assert_eq!(problems.sorted()[0].place.line, 3);
    }
}
