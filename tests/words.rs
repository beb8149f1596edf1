//! Rules for comments and documents that a machine can check: openings and lengths.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod comments;

use comments::{Language, Line, lines};
use epipole_tests::root;
use std::fs;
use std::path::{Path, PathBuf};

/// Folders with the extensions of the sources to read below them.
const SOURCES: &[(&str, &[&str])] = &[
    ("crates", &["rs"]),
    ("python", &["js", "py"]),
    ("tests", &["js", "mjs", "py", "rs", "ts"]),
    ("web", &["js", "mjs", "py", "ts"]),
];

/// Folders that tools fill.
const GENERATED: &[&str] = &["node_modules", "target", "dist", "static", "test-results"];

/// Words that must not begin a comment: a noun says what an item is, a verb what it does.
const OPENINGS: &[&str] = &[
    "What", "Who", "Whoever", "Whatever", "Where", "Wherever", "How", "So many", "As many", "That",
];

/// Maximum length of a comment's lines by folder, characters.
const WIDTHS: &[(&str, usize)] = &[
    ("crates", 100),
    ("python", 100),
    ("tests", 100),
    ("web", 120),
];

/// Maximum length of documents, lines.
const DOCUMENTS: &[(&str, usize)] = &[
    ("ARCHITECTURE.md", 130),
    ("CHANGELOG.md", 60),
    ("CONTRIBUTING.md", 120),
    ("README.md", 110),
    ("python/README.md", 110),
    ("web/README.md", 110),
];

/// Documents with lines of at most 110 characters.
const NARROW: &[&str] = &["ARCHITECTURE.md", "CHANGELOG.md", "docs/decisions"];
const NARROW_WIDTH: usize = 110;

#[test]
fn comments_and_documents_are_plain() {
    let mut findings = long_documents();
    findings.extend(wide_documents());
    for (folder, extensions) in SOURCES {
        let widest = WIDTHS.iter().find(|(name, _)| name == folder);
        for file in sources_below(&root().join(folder), extensions) {
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
    let mut files = Vec::new();
    for name in NARROW {
        let path = root().join(name);
        if path.is_dir() {
            files.extend(sources_below(&path, &["md"]));
        } else {
            files.push(path);
        }
    }
    let mut findings = Vec::new();
    for file in files {
        let path = file.strip_prefix(root()).unwrap().display().to_string();
        let text = fs::read_to_string(&file).unwrap();
        for (index, line) in text.lines().enumerate() {
            let width = line.chars().count();
            if width > NARROW_WIDTH {
                let number = index + 1;
                findings.push(format!(
                    "{path}:{number}: {width} characters, at most {NARROW_WIDTH}"
                ));
            }
        }
    }
    findings
}

/// Every source below `folder` with one of the extensions that no tool has made, sorted.
fn sources_below(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let (mut found, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let entry = entry.unwrap();
            let (path, name) = (entry.path(), entry.file_name());
            let name = name.to_string_lossy();
            let is_ours = !name.starts_with('.') && !GENERATED.contains(&&*name);
            if entry.file_type().unwrap().is_dir() && is_ours {
                folders.push(path);
            } else if path
                .extension()
                .is_some_and(|e| extensions.iter().any(|x| e == *x))
            {
                found.push(path);
            }
        }
    }
    assert!(!found.is_empty(), "no sources in {}", folder.display());
    found.sort();
    found
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
