//! `{{#cite hartley1997 lowe2004 | §3}}`: citations, linked to the list of references.

use crate::html::escape;
use crate::parse::text::Request;
use crate::problems::{Place, name_list};
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::tokens::{PAGE_OF_REFERENCES, token};
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// Keys of works, and a location in them.
pub(super) struct Cite {
    keys: Vec<String>,
    locator: Option<String>,
    place: Place,
}

/// Citations of known works.
pub(super) struct Cited {
    /// Keys and labels.
    works: Vec<(String, String)>,
    locator: Option<String>,
    place: Place,
}

impl Directive for Cite {
    const NAME: &'static str = "cite";
    type Resolved = Cited;

    fn parse(request: &Request, _: &Parser) -> Result<Self, String> {
        if request.call.words.is_empty() {
            return Err("write {{#cite key …}}".to_owned());
        }
        let body = request.body.as_ref();
        Ok(Cite {
            keys: request.call.words.clone(),
            locator: body.map(|body| body.text().to_owned()),
            place: request.place.clone(),
        })
    }

    fn resolve(self, book: &Book) -> Result<Cited, String> {
        let mut works = Vec::new();
        for key in self.keys {
            if let Some(label) = book.references.label(&key) {
                works.push((key, label));
            } else {
                let known = name_list(&book.references.keys());
                let message = format!("unknown reference \"{key}\"; known references: {known}");
                book.problems.report(self.place.clone(), message);
            }
        }
        Ok(Cited {
            works,
            locator: self.locator,
            place: self.place,
        })
    }

    fn render(cited: Cited, page: &mut Writer) -> Insert {
        let html = cited.html(&token(PAGE_OF_REFERENCES, ""));
        if !cited.works.is_empty() {
            page.page.cites.get_or_insert(cited.place);
        }
        let labels = cited.works.into_iter().map(|(_, label)| label);
        let text = labels.collect::<Vec<_>>().join("; ");
        Insert::Inline { html, text }
    }
}

impl Cited {
    /// Renders the citations; `list` is the page with the list of references.
    fn html(&self, list: &str) -> String {
        let link = |(key, label): &(String, String)| {
            let (key, label) = (escape(key), escape(label));
            format!("<a class=\"cite\" href=\"{list}#{key}\">{label}</a>")
        };
        let links: Vec<String> = self.works.iter().map(link).collect();
        let mut html = links.join("; ");
        if let Some(locator) = &self.locator {
            html.push_str(&format!(", {}", escape(locator)));
        }
        html
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn citations_link_to_the_list() {
        let work = |key: &str, label: &str| (key.to_owned(), label.to_owned());
        let cited = Cited {
            works: vec![
                work("hartley1997", "Hartley 1997"),
                work("hartley2004", "Hartley & Zisserman 2004"),
            ],
            locator: Some("§9.2".to_owned()),
            place: Place::new("a.md", 1),
        };
        assert_eq!(
            cited.html("references.html"),
            "<a class=\"cite\" href=\"references.html#hartley1997\">Hartley 1997</a>; \
             <a class=\"cite\" href=\"references.html#hartley2004\">Hartley &amp; Zisserman 2004</a>, §9.2"
        );
    }
}
