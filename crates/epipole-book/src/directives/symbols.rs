//! `{{#symbols P p p' ℓ' e'}}`: a list of symbols that the chapter's figures also draw.

use crate::html::escape;
use crate::parse::text::Request;
use crate::problems::name_list;
use crate::render::directive::{Directive, Parser};
use crate::render::insert::Insert;
use crate::render::math::{Layout, mathml};
use crate::render::symbols::{SYMBOLS, find};
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// The list, as HTML.
pub(super) struct Symbols(String);

impl Directive for Symbols {
    const NAME: &'static str = "symbols";
    type Resolved = Self;

    fn parse(request: &Request, _: &Parser) -> Result<Self, String> {
        list(&request.call.words).map(Symbols)
    }

    fn resolve(self, _: &Book) -> Result<Self, String> {
        Ok(self)
    }

    fn render(list: Self, _: &mut Writer) -> Insert {
        Insert::Block { html: list.0 }
    }
}

/// Renders the list of symbols.
///
/// # Errors
/// A message for an unknown symbol, with the known ones.
fn list(names: &[String]) -> Result<String, String> {
    let mut rows = String::new();
    for name in names {
        let Some(symbol) = find(name) else {
            let known = SYMBOLS.iter().map(|symbol| symbol.name);
            let known: Vec<&str> = known.collect();
            return Err(format!(
                "unknown symbol \"{name}\"; known: {}",
                name_list(&known)
            ));
        };
        rows.push_str(&format!(
            "<li><span data-symbol=\"{drawn}\" data-letter=\"{name}\" data-role=\"{role}\"><svg viewBox=\"0 0 16 16\" aria-hidden=\"true\">{mark}</svg>{math}</span> <span class=\"meaning\">{meaning}</span></li>\n",
            drawn = escape(symbol.drawn),
            name = escape(symbol.name),
            role = symbol.role,
            mark = symbol.mark,
            math = mathml(symbol.latex, Layout::Inline)?,
            meaning = symbol.meaning,
        ));
    }
    Ok(format!(
        "<div class=\"symbols\" role=\"group\" aria-label=\"Letters of this chapter\">\n\
         <p>Letters of this chapter, in text and pictures</p>\n<ul>\n{rows}</ul>\n</div>\n"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_names_each_letter() {
        let html = list(&["P".to_owned(), "ℓ'".to_owned()]).unwrap();
        assert!(html.contains("a point in the world") && html.contains("data-role=\"line\""));
        let pixel = list(&["x".to_owned()]).unwrap();
        assert!(
            pixel.contains("data-symbol=\"p\" data-letter=\"x\""),
            "{pixel}"
        );
        let message = list(&["Q".to_owned()]).unwrap_err();
        assert!(
            message.contains("unknown symbol \"Q\"; known: P, X"),
            "{message}"
        );
    }
}
