//! Placeholders for the HTML of directives while Markdown is parsed, of private-use characters: so
//! Markdown cannot mangle it, and every event still knows its file and line.

const OPEN: char = '\u{E000}';
const CLOSE: char = '\u{E001}';

/// The placeholder of the insert with this index.
pub(crate) fn of(index: usize) -> String {
    format!("{OPEN}{index}{CLOSE}")
}

/// The index that a text stands in for, if it is one placeholder and nothing else.
pub(crate) fn index_of(words: &str) -> Option<usize> {
    let digits = words.strip_prefix(OPEN)?.strip_suffix(CLOSE)?;
    digits.parse().ok()
}

/// A piece of a text with placeholders.
pub(crate) enum Part<'a> {
    Words(&'a str),
    Insert(usize),
}

/// The words and placeholders of a text, in their order.
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
