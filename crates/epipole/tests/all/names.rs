//! `docs/names.md` and the book's formulas name functions and types of the library that are there.

use std::path::Path;

/// The modules that export names.
pub(super) fn rooms() -> Vec<String> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let text = std::fs::read_to_string(source.join("lib.rs")).expect("the library's source");
    let declared = text
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    let exports = declared.filter(|room| source.join(room).join("mod.rs").exists());
    exports.map(str::to_owned).collect()
}

/// The public names of a module: those of its `pub use` declarations.
pub(super) fn public_names(room: &str) -> Vec<String> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("src")
        .join(room)
        .join("mod.rs");
    let text = std::fs::read_to_string(&file)
        .unwrap_or_else(|error| panic!("there is no room {room}: {error}"));
    let mut names = Vec::new();
    for declaration in text.split("pub use ").skip(1) {
        let list = declaration.split(';').next().unwrap_or_default();
        // The part before the last `::` is the path.
        let list = list.rsplit("::").next().unwrap_or_default();
        let words = list.split(|c: char| !c.is_alphanumeric() && c != '_');
        names.extend(words.filter(|word| !word.is_empty()).map(str::to_owned));
    }
    names
}

/// The names in backticks of the last column of each table, and of the text.
fn named(page: &str) -> Vec<(String, String)> {
    let mut names = Vec::new();
    for line in page.lines() {
        let ours = match line.strip_suffix(" |") {
            Some(row) => row.rsplit(" | ").next().unwrap_or_default(),
            None => line,
        };
        for code in ours.split('`').skip(1).step_by(2) {
            if let Some((room, name)) = code.split_once("::") {
                names.push((room.to_owned(), name.to_owned()));
            }
        }
    }
    names
}

#[test]
fn every_name_of_the_guide_exists() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/names.md");
    let Ok(page) = std::fs::read_to_string(page) else {
        // The published crate comes without the repository's docs.
        return;
    };
    let names = named(&page);
    assert!(names.len() > 60, "only {} names were found", names.len());
    for (room, name) in names {
        assert!(
            public_names(&room).contains(&name),
            "docs/names.md names {room}::{name}, which is not there"
        );
    }
}

/// Rust paths of the book's formulas, and their names in JavaScript where they have one.
fn of_formulas(file: &str) -> Vec<(String, Option<String>)> {
    let value = |table: &str, key: &str| {
        let prefix = format!("{key} = \"");
        let mut lines = table.lines();
        let found = lines.find_map(|line| line.strip_prefix(&prefix)?.strip_suffix('"'));
        found.map(str::to_owned)
    };
    let mut names = Vec::new();
    for table in file.split("\n[[").skip(1) {
        let Some(path) = value(table, "function") else {
            continue;
        };
        let name = path.rsplit("::").next().unwrap_or_default();
        let javascript = value(table, "javascript").unwrap_or_else(|| camel_case(name));
        names.push((path, (!javascript.is_empty()).then_some(javascript)));
    }
    names
}

pub(super) fn camel_case(name: &str) -> String {
    let mut upper = false;
    let mut letters = String::new();
    for c in name.chars() {
        match c {
            '_' => upper = true,
            c if std::mem::take(&mut upper) => letters.extend(c.to_uppercase()),
            c => letters.push(c),
        }
    }
    letters
}

#[test]
fn every_function_of_the_formulas_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let read = |path: &str| std::fs::read_to_string(root.join(path));
    let Ok(file) = read("content/formulas.toml") else {
        // The published crate comes without the book.
        return;
    };
    let functions = read("web/vision/src/api.ts").expect("the npm package's functions");
    let page = read("content/formulas.md").expect("the page of formulas");
    for key in file
        .split("\n[[")
        .skip(1)
        .filter_map(|table| table.split("]]").next())
    {
        assert!(
            page.contains(&format!("{{{{#formulas {key}}}}}")),
            "content/formulas.md shows no formulas of {key}"
        );
    }
    let names = of_formulas(&file);
    assert!(
        names.len() > 35,
        "only {} functions were found",
        names.len()
    );
    for (path, javascript) in names {
        let (room, name) = path.split_once("::").expect("a path of two parts");
        assert!(
            public_names(room).contains(&name.to_owned()),
            "content/formulas.toml names {path}, which is not there"
        );
        if let Some(name) = javascript {
            assert!(
                functions.contains(&format!("\n  {name}: [")),
                "content/formulas.toml names {name} in JavaScript, which is not there"
            );
        }
    }
}

#[test]
fn the_test_would_notice_a_name_that_is_not_there() {
    assert_eq!(
        named("| `a::b` | `robust::ransac`, `x::y` |"),
        [
            ("robust".to_owned(), "ransac".to_owned()),
            ("x".to_owned(), "y".to_owned())
        ]
    );
    assert!(public_names("robust").contains(&"least_median".to_owned()));
    assert!(!public_names("robust").contains(&"run".to_owned()));
}
