//! Placeholders for the HTML of directives while Markdown is parsed. They consist of private-use
//! characters, which Markdown does not change, so that every event keeps its file and line.

const OPEN: char = '\u{E000}';
const CLOSE: char = '\u{E001}';

/// Returns the placeholder of the insert with this index.
pub(crate) fn of(index: usize) -> String {
    format!("{OPEN}{index}{CLOSE}")
}

/// Returns the index of a placeholder, if the text is nothing else.
pub(crate) fn index_of(words: &str) -> Option<usize> {
    let digits = words.strip_prefix(OPEN)?.strip_suffix(CLOSE)?;
    digits.parse().ok()
}

/// A part of a text with placeholders.
pub(crate) enum Part<'a> {
    Words(&'a str),
    Insert(usize),
}

/// Splits a text into words and placeholders, in order.
pub(crate) fn parts(words: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut rest = words;
    while let Some(open) = rest.find(OPEN) {
        let Some(close) = rest[open..].find(CLOSE) else {
            break;
        };
        if open > 0 {
            parts.push(Part::Words(&rest[..open]));
        }
        let digits = &rest[open + OPEN.len_utf8()..open + close];
        if let Ok(index) = digits.parse() {
            parts.push(Part::Insert(index));
        }
        rest = &rest[open + close + CLOSE.len_utf8()..];
    }
    if !rest.is_empty() {
        parts.push(Part::Words(rest));
    }
    parts
}
