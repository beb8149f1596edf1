//! Reads the comments of a source file, line by line.

use std::ops::Range;
use std::path::Path;

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Language {
    Rust,
    /// JavaScript and TypeScript.
    Script,
    Python,
}

impl Language {
    /// Language by file extension.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "rs" => Some(Self::Rust),
            "js" | "mjs" | "ts" => Some(Self::Script),
            "py" => Some(Self::Python),
            _ => None,
        }
    }
}

/// One line of a comment.
pub(crate) struct Line<'a> {
    /// Line number in the file, from 1.
    pub(crate) number: usize,
    /// Comment marker, such as `///`.
    marker: &'a str,
    /// Text without marker.
    pub(crate) text: &'a str,
    /// Whether the line begins a block or follows an empty line in it.
    pub(crate) begins: bool,
    /// Length of the source line in characters; `None` for a comment behind code.
    pub(crate) width: Option<usize>,
}

/// All lines of comments in a source text.
pub(crate) fn lines(code: &str, language: Language) -> Vec<Line<'_>> {
    let mut lines: Vec<Line<'_>> = Vec::new();
    let (mut number, mut counted) = (1, 0);
    for span in spans(code, language) {
        number += code[counted..span.start].matches('\n').count();
        counted = span.start;
        let before = code[..span.start].rsplit('\n').next().unwrap_or("");
        for (index, part) in code[span].split('\n').enumerate() {
            let (marker, text) = split_marker(part.trim());
            let is_alone = index > 0 || before.trim().is_empty();
            let margin = if index > 0 { "" } else { before };
            let mut line = Line {
                number: number + index,
                marker,
                text,
                begins: true,
                width: is_alone.then(|| margin.chars().count() + part.chars().count()),
            };
            let last = lines
                .last()
                .filter(|last| index > 0 || follows(&line, last));
            line.begins = last.is_none_or(|last| last.text.is_empty());
            lines.push(line);
        }
    }
    lines
}

/// Whether two line comments belong to one block: each alone in its line, with the same marker.
fn follows(line: &Line<'_>, last: &Line<'_>) -> bool {
    line.number == last.number + 1
        && line.marker == last.marker
        && !line.marker.starts_with("/*")
        && line.width.is_some()
        && last.width.is_some()
}

fn split_marker(line: &str) -> (&str, &str) {
    let text = line.trim_start_matches(['/', '*', '!', '#']);
    let marker = &line[..line.len() - text.len()];
    (marker, text.trim_end_matches("*/").trim())
}

/// Byte ranges of the comments; those of line comments end before the line break.
fn spans(code: &str, language: Language) -> Vec<Range<usize>> {
    let (mut spans, mut at) = (Vec::new(), 0);
    while let Some(c) = code[at..].chars().next() {
        let comment = comment_len(&code[at..], language);
        spans.extend(comment.map(|len| at..at + len));
        at += comment
            .or_else(|| literal_len(code, at, language))
            .unwrap_or(c.len_utf8());
    }
    spans
}

/// Length of the comment at the start of `rest`, bytes.
fn comment_len(rest: &str, language: Language) -> Option<usize> {
    let is_python = language == Language::Python;
    if rest.starts_with(if is_python { "#" } else { "//" }) {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    let is_block = !is_python && rest.starts_with("/*");
    is_block.then(|| block_len(rest, language == Language::Rust))
}

fn block_len(rest: &str, nests: bool) -> usize {
    let (mut depth, mut at) = (1, 2);
    while depth > 0 {
        let Some(next) = rest[at..].find(['/', '*']) else {
            return rest.len();
        };
        at += next;
        at += match rest.get(at..at + 2) {
            Some("*/") => {
                depth -= 1;
                2
            }
            Some("/*") if nests => {
                depth += 1;
                2
            }
            _ => 1,
        };
    }
    at
}

/// Length of the literal at `at`, bytes: strings and the like, in which nothing is a comment.
fn literal_len(code: &str, at: usize, language: Language) -> Option<usize> {
    let rest = &code[at..];
    match (language, rest.chars().next()?) {
        (Language::Rust, '"') => Some(quoted_len(rest, &['"'])),
        (Language::Rust, '\'') => Some(char_len(rest)),
        (Language::Rust, 'r') => raw_len(rest),
        (Language::Script, '`') => Some(template_len(rest)),
        (Language::Script, '/') if expects_operand(&code[..at]) => regex_len(rest),
        (Language::Python, '"' | '\'') if is_triple(rest) => Some(triple_len(rest)),
        (Language::Script | Language::Python, quote @ ('"' | '\'')) => {
            Some(quoted_len(rest, &[quote, '\n']))
        }
        _ => None,
    }
}

/// Length of a string up to and including the first of `ends` that is not escaped.
fn quoted_len(rest: &str, ends: &[char]) -> usize {
    let mut is_escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            c if ends.contains(&c) => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

/// Length of a character literal, or of the quote of a lifetime.
fn char_len(rest: &str) -> usize {
    let mut chars = rest.chars().skip(1);
    match (chars.next(), chars.next()) {
        (Some('\\'), _) => quoted_len(rest, &['\'']),
        (Some(c), Some('\'')) => c.len_utf8() + 2,
        _ => 1,
    }
}

/// Length of a raw string of Rust; `None` for a name that begins with `r`.
fn raw_len(rest: &str) -> Option<usize> {
    let marks = rest[1..].trim_start_matches('#');
    let hashes = rest.len() - 1 - marks.len();
    let body = marks.strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let found = body.find(&end)?;
    Some(rest.len() - body.len() + found + end.len())
}

fn is_triple(rest: &str) -> bool {
    rest.starts_with("\"\"\"") || rest.starts_with("'''")
}

fn triple_len(rest: &str) -> usize {
    let (quotes, body) = rest.split_at(3);
    body.find(quotes).map_or(rest.len(), |found| found + 6)
}

fn template_len(rest: &str) -> usize {
    let mut at = 1;
    while let Some(c) = rest[at..].chars().next() {
        at += match c {
            '`' => return at + 1,
            '\\' => 1 + rest[at + 1..].chars().next().map_or(0, char::len_utf8),
            '$' if rest[at..].starts_with("${") => 2 + expression_len(&rest[at + 2..]),
            c => c.len_utf8(),
        };
    }
    rest.len()
}

/// Length of an expression in a template, with its closing brace.
fn expression_len(code: &str) -> usize {
    let (mut depth, mut at) = (0, 0);
    while let Some(c) = code[at..].chars().next() {
        match c {
            '}' if depth == 0 => return at + 1,
            '}' => depth -= 1,
            '{' => depth += 1,
            _ => {}
        }
        at += literal_len(code, at, Language::Script).unwrap_or(c.len_utf8());
    }
    code.len()
}

/// Whether a slash after this code begins a regular expression rather than divides.
fn expects_operand(before: &str) -> bool {
    let before = before.trim_end();
    let word = before
        .rsplit(|c: char| !c.is_alphanumeric())
        .next()
        .unwrap_or("");
    before
        .chars()
        .next_back()
        .is_none_or(|c| "(,=:[!&|?{};+-*%~^<>".contains(c))
        || ["return", "typeof", "case", "of"].contains(&word)
}

/// Length of a regular expression without flags; `None` if the line ends before.
fn regex_len(rest: &str) -> Option<usize> {
    let (mut is_escaped, mut in_class) = (false, false);
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            '\n' => return None,
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            '[' => in_class = true,
            ']' => in_class = false,
            '/' if !in_class => return Some(at + 1),
            _ => {}
        }
    }
    None
}

/// The lines that begin a block, as `number: text`.
fn begun(code: &str, language: Language) -> Vec<String> {
    let begun = lines(code, language).into_iter().filter(|line| line.begins);
    begun
        .map(|line| format!("{}: {}", line.number, line.text))
        .collect()
}

#[test]
fn blocks_begin_after_code_and_after_empty_lines() {
    let code = "\
//! One module
//! Where it goes on
//!
//! Two paragraphs
/// Three, of another kind
fn a() {} // Four, behind code
// Five
// How it goes on
/* Six */ /* seven */
/**
 * Eight
 * What goes on
 *
 * Nine
 */
";
    let expected = [
        "1: One module",
        "4: Two paragraphs",
        "5: Three, of another kind",
        "6: Four, behind code",
        "7: Five",
        "9: Six",
        "9: seven",
        "10: ",
        "11: Eight",
        "14: Nine",
    ];
    assert_eq!(begun(code, Language::Script), expected);
    assert_eq!(begun(code, Language::Rust), expected);
}

#[test]
fn literals_hold_no_comments_in_rust() {
    let code = r##"
const A: &str = "// What"; // one
const B: &str = r#"/* "What" */"#; // two
const C: [char; 3] = ['"', '\'', '/']; // three
fn d<'a>(_: &'a str) -> &'a str { "https://example.org \" // Who" } // four
/* five /* nested */ // still five */
"##;
    let expected = [
        "2: one",
        "3: two",
        "4: three",
        "5: four",
        "6: five /* nested */ // still five",
    ];
    assert_eq!(begun(code, Language::Rust), expected);
}

#[test]
fn literals_hold_no_comments_in_scripts() {
    let code = r#"
const a = "https://example.org"; // one
const b = `${c ? `// What ${"}"}` : ""} // Who`; // two
const d = /["'`]\/\/[/*]/g.test(e) / 2; // three
const f = 6 / 2 / 3; // four
"#;
    let expected = ["2: one", "3: two", "4: three", "5: four"];
    assert_eq!(begun(code, Language::Script), expected);
}

#[test]
fn literals_hold_no_comments_in_python() {
    let code = r##"
a = "# What" + '# Who'  # one
"""Where
# How
"""
# two
# That
"##;
    assert_eq!(begun(code, Language::Python), ["2: one", "6: two"]);
}

#[test]
fn widths_are_those_of_lines_that_hold_nothing_else() {
    let code = "let α = 1; // one\n    // é\n/**\n * two\n */\n";
    let widths: Vec<_> = lines(code, Language::Script)
        .iter()
        .map(|line| line.width)
        .collect();
    assert_eq!(widths, [None, Some(8), Some(3), Some(6), Some(3)]);
}
