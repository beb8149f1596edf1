//! Rules for comments and documents that a machine can check: openings and lengths.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod comments;

use comments::{Language, Line, lines};
use epipole_tests::{files_below, root};
use std::fs;

/// Folders with the extensions of the sources to read below them.
const SOURCES: &[(&str, &[&str])] = &[
    ("crates", &["js", "py", "rs"]),
    ("tests", &["js", "mjs", "py", "rs", "ts"]),
    ("web", &["js", "mjs", "py", "ts"]),
];

/// Words that must not begin a comment: a noun says what an item is, a verb what it does.
const OPENINGS: &[&str] = &[
    "What", "Who", "Whoever", "Whatever", "Where", "Wherever", "How", "So many", "As many", "That",
];

/// Names that tell nothing to someone who knows the field: no type or module has one.
const NAMES: &[&str] = &[
    "Arrival",
    "Asked",
    "Brought",
    "Crew",
    "Errand",
    "Fate",
    "Given",
    "Kept",
    "Life",
    "Teller",
    "Told",
    "Wares",
    "What",
    "Wish",
    "finale",
    "gathered",
    "likeness",
    "rhythm",
    "stand_ins",
];

/// Words before a declared name.
const DECLARING: &[&str] = &[
    "struct",
    "enum",
    "trait",
    "type",
    "mod",
    "class",
    "interface",
];

/// Maximum length of a comment's lines by folder, characters.
const WIDTHS: &[(&str, usize)] = &[("crates", 100), ("tests", 100), ("web", 120)];

/// Maximum length of documents, lines.
const DOCUMENTS: &[(&str, usize)] = &[
    ("ARCHITECTURE.md", 130),
    ("CHANGELOG.md", 60),
    ("CONTRIBUTING.md", 120),
    ("README.md", 110),
    ("crates/epipole/README.md", 110),
    ("crates/epipole-cli/README.md", 110),
    ("crates/epipole-io/README.md", 110),
    ("crates/epipole-python/README.md", 110),
    ("web/README.md", 110),
    ("web/vision/README.md", 110),
];

/// Documents with narrow lines, beside the decisions.
const NARROW: &[&str] = &["ARCHITECTURE.md", "CHANGELOG.md"];
/// Maximum length of their lines, characters.
const NARROW_WIDTH: usize = 110;

#[test]
fn comments_and_documents_are_plain() {
    let mut findings = long_documents();
    findings.extend(wide_documents());
    for (folder, extensions) in SOURCES {
        let widest = WIDTHS.iter().find(|(name, _)| name == folder);
        for file in files_below(&root().join(folder), extensions) {
            let path = file.strip_prefix(root()).unwrap().display().to_string();
            let code = fs::read_to_string(&file).unwrap();
            let language = Language::of(&file).unwrap();
            let mut is_code = false;
            for line in lines(&code, language) {
                is_code ^= line.text.starts_with("```");
                // Code of examples and rows of tables cannot be wrapped.
                let is_prose = !is_code && !line.text.starts_with('|');
                let widest = widest.filter(|_| is_prose).map(|(_, width)| *width);
                let broken = broken_rules(&line, widest);
                let found = |rule: String| format!("{path}:{}: {rule}: {}", line.number, line.text);
                findings.extend(broken.into_iter().map(found));
            }
        }
    }
    let count = findings.len();
    let list = findings.join("\n");
    assert!(findings.is_empty(), "{list}\n{count} lines to reword");
}

#[test]
fn types_and_modules_have_telling_names() {
    let mut findings = Vec::new();
    for (folder, extensions) in SOURCES {
        for file in files_below(&root().join(folder), extensions) {
            let path = file.strip_prefix(root()).unwrap().display().to_string();
            let code = fs::read_to_string(&file).unwrap();
            for (index, line) in code.lines().enumerate() {
                let found = declared(line).filter(|name| NAMES.contains(name));
                findings.extend(found.map(|name| format!("{path}:{}: {name}", index + 1)));
            }
        }
    }
    assert!(findings.is_empty(), "{}", findings.join("\n"));
}

/// Name of the type or module that a line declares, as far as its words tell.
fn declared(line: &str) -> Option<&str> {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let mut words = line
        .split(|c| !is_letter(c))
        .filter(|word| !word.is_empty());
    words.find(|word| DECLARING.contains(word))?;
    words.next()
}

#[test]
fn declarations_are_found() {
    assert_eq!(declared("pub(crate) struct Camera {"), Some("Camera"));
    let union = "export type Order = { work: number } & (";
    assert_eq!(declared(union), Some("Order"));
    assert_eq!(declared("    pub mod stereo;"), Some("stereo"));
    assert_eq!(declared("let camera = Camera::default();"), None);
}

/// The rules that a line breaks, in words.
fn broken_rules(line: &Line<'_>, widest: Option<usize>) -> Vec<String> {
    let opening = opening(line.text).filter(|_| line.begins);
    let width = line.width.zip(widest).filter(|(width, most)| width > most);
    let opening = opening.map(|words| format!("begins with \"{words}\""));
    let width = width.map(|(width, most)| format!("{width} characters, at most {most}"));
    opening.into_iter().chain(width).collect()
}

fn opening(text: &str) -> Option<&'static str> {
    let begins = |words: &&&str| {
        let rest = text.strip_prefix(**words);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    OPENINGS.iter().find(begins).copied()
}

fn long_documents() -> Vec<String> {
    let measure = |&(path, most): &(&str, usize)| {
        let text = fs::read_to_string(root().join(path)).unwrap();
        let count = text.lines().count();
        (count > most).then(|| format!("{path}:{count}: {count} lines, at most {most}"))
    };
    DOCUMENTS.iter().filter_map(measure).collect()
}

fn wide_documents() -> Vec<String> {
    let mut findings = Vec::new();
    let decisions = files_below(&root().join("docs/decisions"), &["md"]);
    let named = NARROW.iter().map(|name| root().join(name));
    for file in decisions.into_iter().chain(named) {
        let path = file.strip_prefix(root()).unwrap().display().to_string();
        for (index, line) in fs::read_to_string(&file).unwrap().lines().enumerate() {
            let (number, width) = (index + 1, line.chars().count());
            if width > NARROW_WIDTH {
                findings.push(format!(
                    "{path}:{number}: {width} characters, at most {NARROW_WIDTH}"
                ));
            }
        }
    }
    findings
}

#[test]
fn openings_are_whole_words_in_upper_case() {
    assert_eq!(opening("What it is"), Some("What"));
    assert_eq!(opening("Whatever it is"), Some("Whatever"));
    assert_eq!(opening("So many of them"), Some("So many"));
    assert_eq!(opening("How's that"), Some("How"));
    assert_eq!(opening("However it is"), None);
    assert_eq!(opening("where it is"), None);
    assert_eq!(opening("So it is"), None);
}
