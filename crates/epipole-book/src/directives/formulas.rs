//! `{{#formulas rays}}`: the formulas of a chapter in `content/formulas.toml`, each with its
//! functions in Rust, Python, JavaScript and OpenCV.

use crate::html::escape;
use crate::parse::source::Source;
use crate::parse::text::Request;
use crate::problems::Problems;
use crate::render::directive::{Directive, ParsedText, Parser, Text};
use crate::render::insert::Insert;
use crate::render::writer::Writer;
use crate::resolve::book::Book;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

const FILE: &str = "formulas.toml";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    name: String,
    /// LaTeX.
    formula: String,
    /// Module and name in Rust, `epipolar::sampson_px`.
    function: Option<String>,
    /// Name in the npm package, if it differs from Rust's name in camel case; empty for none.
    javascript: Option<String>,
    opencv: Option<String>,
}

/// The list. `T` is the stage of its formulas.
pub(super) struct Formulas<T>(Vec<Formula<T>>);

struct Formula<T> {
    name: String,
    formula: T,
    /// Languages, with the name of the function in each.
    functions: Vec<(&'static str, String)>,
}

impl Directive for Formulas<ParsedText> {
    const NAME: &'static str = "formulas";
    type Resolved = Formulas<Text>;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let chapter = request.one_word("chapter")?;
        let source = parser.content.read(FILE);
        let source = source.ok_or_else(|| format!("there is no {FILE}"))?;
        let mut chapters = read(&source, parser.problems);
        let known: Vec<String> = chapters.keys().cloned().collect();
        let formulas = (chapters.remove(chapter)).ok_or_else(|| {
            format!(
                "{FILE} has no \"{chapter}\"; chapters: {}",
                known.join(", ")
            )
        })?;
        let formulas = formulas.into_iter().map(|spanned| {
            let place = source.place(spanned.span().start);
            let written = spanned.into_inner();
            Formula {
                functions: functions(&written),
                formula: parser.verbatim(&format!("$${}$$", written.formula), &place),
                name: written.name,
            }
        });
        Ok(Formulas(formulas.collect()))
    }

    fn resolve(self, book: &Book) -> Result<Formulas<Text>, String> {
        let formulas = self.0.into_iter().map(|formula| Formula {
            name: formula.name,
            formula: formula.formula.resolve(book),
            functions: formula.functions,
        });
        Ok(Formulas(formulas.collect()))
    }

    fn render(Formulas(formulas): Formulas<Text>, page: &mut Writer) -> Insert {
        let mut html = String::from("<dl class=\"formulas\">\n");
        for Formula {
            name,
            formula,
            functions,
        } in formulas
        {
            page.page.words.push_str(&format!(" {name}: "));
            html.push_str(&format!(
                "<div><dt>{}</dt><dd class=\"math\">{}</dd>",
                escape(&name),
                formula.block(page)
            ));
            if !functions.is_empty() {
                html.push_str("<dd><ul>");
                for (language, code) in functions {
                    let code = escape(&code);
                    html.push_str(&format!(
                        "<li><span>{language}</span> <code>{code}</code></li>"
                    ));
                }
                html.push_str("</ul></dd>");
            }
            html.push_str("</div>\n");
        }
        html.push_str("</dl>\n");
        Insert::Block { html }
    }
}

/// Reads the formulas of all chapters. Problems are reported.
fn read(source: &Source, problems: &Problems) -> BTreeMap<String, Vec<Spanned<Written>>> {
    toml::from_str(source.text()).unwrap_or_else(|error| {
        let at = error.span().map_or(0, |span| span.start);
        problems.report(source.place(at), error.message());
        BTreeMap::new()
    })
}

fn functions(written: &Written) -> Vec<(&'static str, String)> {
    let mut functions = Vec::new();
    if let Some(path) = &written.function {
        functions.push(("Rust", path.clone()));
        functions.push(("Python", path.replace("::", ".")));
        let name = path.rsplit("::").next().unwrap_or_default();
        let javascript = (written.javascript.clone()).unwrap_or_else(|| camel_case(name));
        if !javascript.is_empty() {
            functions.push(("JavaScript", javascript));
        }
    }
    functions.extend(written.opencv.clone().map(|name| ("OpenCV", name)));
    functions
}

fn camel_case(name: &str) -> String {
    let mut words = name.split('_');
    let first = words.next().unwrap_or_default().to_owned();
    words.fold(first, |all, word| {
        let (initial, rest) = word.split_at(word.len().min(1));
        all + &initial.to_uppercase() + rest
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problems::Place;

    fn of(toml: &str) -> (BTreeMap<String, Vec<Spanned<Written>>>, Problems) {
        let problems = Problems::default();
        let source = Source::new(toml, Place::new(FILE, 1));
        (read(&source, &problems), problems)
    }

    #[test]
    fn names_follow_the_language() {
        let (mut chapters, problems) = of("[[a]]\nname = \"n\"\nformula = \"x\"\n\
             function = \"epipolar::sampson_px\"\nopencv = \"sampsonDistance\"\n\
             [[a]]\nname = \"m\"\nformula = \"y\"\nfunction = \"camera::Camera\"\njavascript = \"\"\n");
        assert!(problems.sorted().is_empty());
        let all = chapters.remove("a").unwrap();
        let names = |at: usize| {
            let names = functions(all[at].get_ref()).into_iter();
            names.map(|(_, name)| name).collect::<Vec<_>>()
        };
        assert_eq!(
            names(0),
            [
                "epipolar::sampson_px",
                "epipolar.sampson_px",
                "sampsonPx",
                "sampsonDistance"
            ]
        );
        assert_eq!(names(1), ["camera::Camera", "camera.Camera"]);
        assert_eq!(camel_case("fundamental_8point"), "fundamental8point");
    }

    #[test]
    fn a_broken_file_names_its_line() {
        let (chapters, problems) = of("[[a]]\nname = \"n\"\nformel = \"x\"\n");
        assert!(chapters.is_empty());
        assert_eq!(problems.sorted()[0].place.line, 3);
    }
}
