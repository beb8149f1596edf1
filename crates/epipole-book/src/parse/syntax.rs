//! `{{#name words key=value | body}}`: the notation of all directives. Code is left alone, and
//! `\{{#` is a literal `{{#`.

use super::source::Source;
use pulldown_cmark::{Event, Options, Parser, Tag};
use std::ops::Range;

/// A directive in a chapter.
#[derive(Debug, Clone, PartialEq)]
pub struct Call {
    /// Name, written after `{{#`.
    pub name: String,
    /// The words before the first `key=value`.
    pub words: Vec<String>,
    /// `key=value` pairs in the order written; a value with spaces is in double quotes.
    pub settings: Vec<(String, String)>,
    /// Byte range of the text after ` | `: Markdown.
    pub body: Option<Range<usize>>,
    /// Byte range of the whole directive, from `{{` to `}}`.
    pub span: Range<usize>,
}

impl Call {
    /// Returns the value of a setting.
    pub fn setting(&self, key: &str) -> Option<&str> {
        let mut settings = self.settings.iter();
        let found = settings.find(|(known, _)| known == key);
        found.map(|(_, value)| value.as_str())
    }
}

/// A piece of a chapter: text, or a valid or malformed directive.
#[derive(Debug, Clone, PartialEq)]
pub enum Piece {
    /// Ordinary text.
    Text(Range<usize>),
    /// A directive.
    Directive(Call),
    /// A malformed directive: its byte range, and the error.
    Broken(Range<usize>, String),
}

/// Returns the Markdown extensions that chapters may use.
pub fn markdown_options() -> Options {
    Options::ENABLE_TABLES
        | Options::ENABLE_FOOTNOTES
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_HEADING_ATTRIBUTES
        | Options::ENABLE_SMART_PUNCTUATION
        | Options::ENABLE_DEFINITION_LIST
        | Options::ENABLE_GFM
        | Options::ENABLE_MATH
}

/// Splits a text into plain pieces and directives.
pub fn split(source: &Source) -> Vec<Piece> {
    let text = source.text();
    let code = code_ranges(text);
    let mut pieces = Vec::new();
    let mut plain_from = 0;
    let mut at = 0;
    while let Some(found) = text[at..].find("{{#") {
        let start = at + found;
        if let Some(range) = code.iter().find(|range| range.contains(&start)) {
            at = range.end;
            continue;
        }
        if text[..start].ends_with('\\') {
            pieces.push(Piece::Text(plain_from..start - 1));
            plain_from = start;
            at = start + 3;
            continue;
        }
        pieces.push(Piece::Text(plain_from..start));
        match closing(text, start) {
            Some(end) => {
                pieces.push(match parse(text, start..end) {
                    Ok(directive) => Piece::Directive(directive),
                    Err(message) => Piece::Broken(start..end, message),
                });
                at = end;
            }
            None => {
                let message = "`{{#` without `}}` (write `\\{{#` to show it)".to_owned();
                pieces.push(Piece::Broken(start..start + 3, message));
                at = start + 3;
            }
        }
        plain_from = at;
    }
    pieces.push(Piece::Text(plain_from..text.len()));
    pieces.retain(|piece| !matches!(piece, Piece::Text(range) if range.is_empty()));
    pieces
}

/// Returns the byte ranges of code blocks and code spans.
fn code_ranges(text: &str) -> Vec<Range<usize>> {
    let mut ranges = Vec::new();
    for (event, range) in Parser::new_ext(text, markdown_options()).into_offset_iter() {
        match event {
            Event::Start(Tag::CodeBlock(_)) | Event::Code(_) => ranges.push(range),
            _ => {}
        }
    }
    ranges
}

/// Returns the end of the directive that starts at `start`. Braces are balanced, so a body may
/// contain formulas and further directives.
fn closing(text: &str, start: usize) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut depth = 0_usize;
    let mut at = start;
    while at < bytes.len() {
        match bytes[at] {
            b'\\' => at += 1,
            b'{' => depth += 1,
            b'}' => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(at + 1);
                }
            }
            _ => {}
        }
        at += 1;
    }
    None
}

fn parse(text: &str, span: Range<usize>) -> Result<Call, String> {
    let inner = span.start + 3..span.end - 2;
    if !text[span.clone()].ends_with("}}") {
        return Err("the braces of this directive do not match".to_owned());
    }
    let written = &text[inner.clone()];
    let bar = bar_outside_quotes(written);
    let head = &written[..bar.unwrap_or(written.len())];
    let body = bar.map(|bar| {
        let body = &written[bar + 1..];
        let start = inner.start + bar + 1 + (body.len() - body.trim_start().len());
        start..start + body.trim().len()
    });
    let mut tokens = tokens(head)?.into_iter();
    let name = tokens.next().ok_or("a directive needs a name")?;
    let mut words = Vec::new();
    let mut settings = Vec::new();
    for token in tokens {
        match token.split_once('=') {
            Some((key, value)) if !key.is_empty() => {
                settings.push((key.to_owned(), value.to_owned()));
            }
            Some(_) => return Err(format!("`{token}`: a setting is written `key=value`")),
            None if settings.is_empty() => words.push(token),
            None => return Err(format!("`{token}`: a setting is written `key=value`")),
        }
    }
    Ok(Call {
        name,
        words,
        settings,
        body,
        span,
    })
}

fn bar_outside_quotes(text: &str) -> Option<usize> {
    let mut quoted = false;
    for (at, letter) in text.char_indices() {
        match letter {
            '"' => quoted = !quoted,
            '|' if !quoted => return Some(at),
            _ => {}
        }
    }
    None
}

/// Splits a text at white space; double quotes keep spaces together and are removed.
fn tokens(text: &str) -> Result<Vec<String>, String> {
    let mut tokens = Vec::new();
    let mut token = String::new();
    let mut quoted = false;
    for letter in text.chars() {
        match letter {
            '"' => quoted = !quoted,
            letter if letter.is_whitespace() && !quoted => {
                if !token.is_empty() {
                    tokens.push(std::mem::take(&mut token));
                }
            }
            letter => token.push(letter),
        }
    }
    if quoted {
        return Err("a double quote is not closed".to_owned());
    }
    if !token.is_empty() {
        tokens.push(token);
    }
    Ok(tokens)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problems::Place;

    fn split_text(text: &str) -> Vec<Piece> {
        split(&Source::new(text, Place::new("a.md", 1)))
    }

    fn only_directive(text: &str) -> Call {
        match &split_text(text)[..] {
            [Piece::Directive(directive)] => directive.clone(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn words_settings_and_body() {
        let text =
            "{{#figure epipolar-click baseline=0.3 label=\"two words\" | A $x_{1_{2}}$ *b*.}}";
        let directive = only_directive(text);
        assert_eq!(directive.name, "figure");
        assert_eq!(directive.words, ["epipolar-click"]);
        let settings = [("baseline", "0.3"), ("label", "two words")];
        assert_eq!(
            directive.settings,
            settings.map(|(k, v)| (k.to_owned(), v.to_owned()))
        );
        assert_eq!(&text[directive.body.unwrap()], "A $x_{1_{2}}$ *b*.");
    }

    #[test]
    fn a_body_may_hold_directives() {
        let text = "{{#note | {{#value a b=1}} and {{#cite c}}}}";
        assert_eq!(
            &text[only_directive(text).body.unwrap()],
            "{{#value a b=1}} and {{#cite c}}"
        );
    }

    #[test]
    fn code_and_escapes_are_text() {
        for text in ["`{{#value a}}`", "```\n{{#value a}}\n```\n"] {
            assert_eq!(split_text(text), [Piece::Text(0..text.len())]);
        }
        let text = r"a \{{#value b}}";
        assert_eq!(
            split_text(text),
            [Piece::Text(0..2), Piece::Text(3..text.len())]
        );
    }

    #[test]
    fn broken_syntax_is_reported() {
        for text in [
            "{{#value a",
            "{{#}}",
            "{{#value a=1 b}}",
            "{{#value \"a}}",
            "{{#value =1}}",
        ] {
            let broken = split_text(text)
                .iter()
                .any(|piece| matches!(piece, Piece::Broken(..)));
            assert!(broken, "{text}");
        }
    }
}
