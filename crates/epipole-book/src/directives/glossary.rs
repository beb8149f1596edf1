//! `{{#glossary}}`: the terms of `content/glossary.toml`, sorted by name, each with its chapter and
//! figure.

use crate::html::escape;
use crate::parse::source::Source;
use crate::parse::text::Request;
use crate::problems::{Place, Problems};
use crate::render::directive::{Directive, ParsedText, Parser, Text};
use crate::render::insert::Insert;
use crate::render::terms::name_of;
use crate::render::tokens::{DEFINITION, NUMBER_OF_FIGURE, PAGE_OF_FIGURE, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

const FILE: &str = "glossary.toml";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// The name, if it differs from the key as text.
    term: Option<String>,
    text: String,
    /// Anchor of a figure that shows it.
    figure: Option<String>,
}

/// The list. `T` is the stage of its texts.
pub(super) struct Glossary<T>(Vec<Term<T>>);

struct Term<T> {
    key: String,
    name: String,
    text: T,
    figure: Option<String>,
    place: Place,
}

impl Directive for Glossary<ParsedText> {
    const NAME: &'static str = "glossary";
    type Resolved = Glossary<Text>;

    fn parse(_: &Request, parser: &Parser) -> Result<Self, String> {
        let source = parser.content.read(FILE);
        let source = source.ok_or_else(|| format!("there is no {FILE}"))?;
        let mut text = |written: &str, place: &Place| parser.verbatim(written, place);
        Ok(Glossary(terms(&source, &mut text, parser.problems)))
    }

    fn resolve(self, book: &Book) -> Result<Glossary<Text>, String> {
        let terms = self.0.into_iter().map(|term| Term {
            key: term.key,
            name: term.name,
            text: term.text.resolve(book),
            figure: term.figure,
            place: term.place,
        });
        Ok(Glossary(terms.collect()))
    }

    fn render(Glossary(terms): Glossary<Text>, page: &mut Writer) -> Insert {
        let mut html = String::from("<dl class=\"glossary\">\n");
        let mut listed = Vec::new();
        for term in terms {
            page.page.words.push_str(&format!(" {}: ", term.name));
            let text = term.text.inline(page);
            html.push_str(&format!(
                "<div id=\"{key}\"><dt>{name}</dt><dd>{text} <span class=\"where\">{chapter}",
                key = escape(&term.key),
                name = escape(&term.name),
                chapter = token(DEFINITION, &term.key),
            ));
            if let Some(figure) = term.figure {
                html.push_str(&format!(
                    ", <a class=\"ref\" href=\"{}\">{}</a>",
                    token(PAGE_OF_FIGURE, &figure),
                    token(NUMBER_OF_FIGURE, &figure)
                ));
                page.page.wanted_figures.push((figure, term.place.clone()));
            }
            html.push_str("</span></dd></div>\n");
            listed.push((term.key, term.place));
        }
        html.push_str("</dl>\n");
        page.page.glossary = Some(listed);
        Insert::Block { html }
    }
}

/// Reads the terms of the file, sorted. Problems are reported.
fn terms<T>(
    source: &Source,
    text: &mut dyn FnMut(&str, &Place) -> T,
    problems: &Problems,
) -> Vec<Term<T>> {
    let file = match toml::from_str::<BTreeMap<String, Spanned<Written>>>(source.text()) {
        Ok(file) => file,
        Err(error) => {
            let at = error.span().map_or(0, |span| span.start);
            problems.report(source.place(at), error.message());
            return Vec::new();
        }
    };
    let mut terms: Vec<Term<T>> = Vec::new();
    for (key, spanned) in file {
        let place = source.place(spanned.span().start);
        let written = spanned.into_inner();
        terms.push(Term {
            name: written.term.unwrap_or_else(|| name_of(&key)),
            text: text(&written.text, &place),
            figure: written.figure,
            key,
            place,
        });
    }
    terms.sort_by_key(|term| term.name.to_lowercase());
    terms
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(toml: &str) -> (Vec<Term<String>>, Problems) {
        let problems = Problems::default();
        let source = Source::new(toml, Place::new(FILE, 1));
        let mut text = |written: &str, _: &Place| written.to_owned();
        let terms = terms(&source, &mut text, &problems);
        (terms, problems)
    }

    #[test]
    fn terms_are_sorted_by_their_names() {
        let (terms, problems) = read(
            "[sift]\nterm = \"SIFT\"\ntext = \"b\"\n[epipolar-line]\ntext = \"a\"\nfigure = \"fig-x\"\n",
        );
        let names: Vec<&str> = terms.iter().map(|term| term.name.as_str()).collect();
        assert_eq!(names, ["epipolar line", "SIFT"]);
        assert_eq!(terms[0].place.line, 4);
        assert!(problems.sorted().is_empty());
    }

    #[test]
    fn a_broken_file_names_its_line() {
        let (terms, problems) = read("[sift]\ntext = \"b\"\nfigures = 1\n");
        assert!(terms.is_empty());
        assert_eq!(problems.sorted()[0].place.line, 3);
    }
}
