//! Works cited by the chapters: `content/references.toml`.

use crate::parse::source::Source;
use crate::problems::Problems;
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
    /// Journal, volume and pages, or publisher.
    #[serde(rename = "in")]
    pub venue: Option<String>,
    /// Digital object identifier, without `https://doi.org/`.
    pub doi: Option<String>,
    /// Web address, if there is no DOI.
    pub url: Option<String>,
}

/// All references by key.
#[derive(Debug, Default)]
pub struct References(BTreeMap<String, Reference>);

impl References {
    /// Reads the file; errors go to `problems`.
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

    /// Returns the keys, for messages.
    pub fn keys(&self) -> Vec<&str> {
        self.0.keys().map(String::as_str).collect()
    }

    /// Returns a label such as `Hartley & Zisserman 2004`; `None` for an unknown key.
    pub fn label(&self, key: &str) -> Option<String> {
        self.0.get(key).map(Reference::label)
    }

    /// Returns all works with their keys.
    pub fn works(&self) -> impl Iterator<Item = (&str, &Reference)> {
        self.0.iter().map(|(key, work)| (key.as_str(), work))
    }
}

impl Reference {
    /// Returns a label such as `Hartley & Zisserman 2004`.
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problems::Place;

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
