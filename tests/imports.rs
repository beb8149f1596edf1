//! Which file of a crate imports which, read from the sources.

use crate::{before_tests, without_strings};
use epipole_tests::files_below;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Files of a crate as modules, such as `render::page`, each with the modules that it names.
pub(crate) fn imports(source: &Path) -> BTreeMap<String, BTreeSet<String>> {
    let module = |file: &Path| {
        let path = file.strip_prefix(source).unwrap().with_extension("");
        let parts = path.iter().map(|part| part.to_string_lossy().into_owned());
        let parts: Vec<String> = parts.filter(|part| part != "mod").collect();
        parts.join("::")
    };
    let files = files_below(source, &["rs"]).into_iter();
    let files: Vec<_> = files.map(|file| (module(&file), file)).collect();
    let known: BTreeSet<&String> = files.iter().map(|(module, _)| module).collect();
    let imports = files.iter().map(|(module, file)| {
        let code = without_strings(&before_tests(&fs::read_to_string(file).unwrap()));
        let named = paths(&code)
            .iter()
            .filter_map(|path| longest_known(&absolute(path, module), &known))
            .filter(|other| other != module)
            .collect();
        (module.clone(), named)
    });
    imports.collect()
}

/// All paths of a file's code, lists in braces taken apart.
fn paths(code: &str) -> Vec<String> {
    let mut paths = Vec::new();
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut at = 0;
    while at < code.len() {
        let rest = &code[at..];
        let length = rest.find(|c| !is_word(c) && c != ':').unwrap_or(rest.len());
        let path = rest[..length].to_owned();
        if path.ends_with("::") && rest[length..].starts_with('{') {
            let inside = braced(&rest[length..]);
            let more = self::paths(inside).into_iter();
            paths.extend(more.map(|more| format!("{path}{more}")));
            at += length + inside.len() + 2;
        } else {
            let step = rest[length..].chars().next().map_or(0, char::len_utf8);
            at += length + step;
            // `name: Type` has a colon that belongs to no path.
            let path = path.trim_matches(':');
            if !path.is_empty() {
                paths.push(path.to_owned());
            }
        }
    }
    paths
}

/// What stands between the brace at the start of a text and its partner.
fn braced(text: &str) -> &str {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth == 0 {
            return &text[1..at];
        }
    }
    &text[1..]
}

/// A path as seen from the root of the crate.
fn absolute(path: &str, module: &str) -> String {
    if let Some(path) = path.strip_prefix("crate::") {
        return path.to_owned();
    }
    let (mut path, mut base) = (path, module);
    if !path.starts_with("super::") {
        return format!("{base}::{}", path.trim_start_matches("self::"));
    }
    while let Some(rest) = path.strip_prefix("super::") {
        base = base.rsplit_once("::").map_or("", |(parent, _)| parent);
        path = rest;
    }
    format!("{base}::{path}").trim_start_matches(':').to_owned()
}

/// The longest beginning of a path that is a file.
fn longest_known(path: &str, known: &BTreeSet<&String>) -> Option<String> {
    let mut path = path.to_owned();
    loop {
        if known.contains(&path) {
            return Some(path);
        }
        path.truncate(path.rfind("::")?);
    }
}

#[test]
fn paths_are_taken_apart() {
    let code = "use crate::{a::{b, c::d}, e}; super::f(g::h)";
    let found = paths(code);
    for path in [
        "crate::a::b",
        "crate::a::c::d",
        "crate::e",
        "super::f",
        "g::h",
    ] {
        assert!(found.iter().any(|found| found == path), "{path}: {found:?}");
    }
    assert_eq!(absolute("super::f", "a::b"), "a::f");
    assert_eq!(absolute("super::f", "a"), "f");
}
