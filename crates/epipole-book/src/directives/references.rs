//! `{{#references}}`: the list of all works.

use crate::html::escape;
use crate::parse::text::Request;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use crate::resolve::references::{Reference, References};

/// The list, which takes no arguments.
pub(super) struct List;

impl Directive for List {
    const NAME: &'static str = "references";
    /// The list as HTML.
    type Resolved = String;

    fn parse(_: &Request, _: &Parser) -> Result<Self, String> {
        Ok(List)
    }

    fn resolve(self, book: &Book) -> Result<String, String> {
        Ok(html(&book.references))
    }

    fn render(html: String, page: &mut Writer) -> Insert {
        page.page.has_references = true;
        Insert::Block { html }
    }
}

/// Lists all works, sorted by first author and year.
fn html(references: &References) -> String {
    let mut works: Vec<(&str, &Reference)> = references.works().collect();
    works.sort_by_key(|(key, work)| (work.authors.clone(), work.year, (*key).to_owned()));
    let mut html = String::from("<ul class=\"references\">\n");
    for (key, work) in works {
        html.push_str(&format!(
            "<li id=\"{}\">{}</li>\n",
            escape(key),
            entry(work)
        ));
    }
    html.push_str("</ul>\n");
    html
}

fn entry(work: &Reference) -> String {
    let first_name_first = |author: &String| match author.split_once(',') {
        Some((family, first_name)) => format!("{} {}", first_name.trim(), family.trim()),
        None => author.clone(),
    };
    let authors: Vec<String> = work.authors.iter().map(first_name_first).collect();
    let authors = match &authors[..] {
        [] => "Anonymous".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    };
    let mut html = format!(
        "{} ({}). <cite>{}</cite>.",
        escape(&authors),
        work.year,
        escape(&work.title)
    );
    if let Some(venue) = &work.venue {
        html.push_str(&format!(" {}.", escape(venue)));
    }
    if let Some(doi) = &work.doi {
        let doi = escape(doi);
        html.push_str(&format!(" <a href=\"https://doi.org/{doi}\">doi:{doi}</a>"));
    } else if let Some(url) = &work.url {
        let url = escape(url);
        html.push_str(&format!(" <a href=\"{url}\">{url}</a>"));
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse::source::Source;
    use crate::problems::{Place, Problems};

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
    fn works_are_listed_with_their_anchors() {
        let problems = Problems::default();
        let source = Source::new(TOML, Place::new("references.toml", 1));
        let references = References::parse(&source, &problems);
        assert!(html(&references).contains("<li id=\"hartley1997\">Richard I. Hartley (1997)."));
        let label = references.label("hartley2004");
        assert_eq!(label.as_deref(), Some("Hartley & Zisserman 2004"));
        assert!(problems.sorted().is_empty());
    }
}
