//! Allowed dependencies between crates and modules: the arrows of `ARCHITECTURE.md`, checked
//! against the sources.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod circles;
mod imports;

use epipole_tests::{files_below, root};
use imports::{Files, Module};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Each crate, with the crates of the workspace that it may depend on.
const CRATES: &[(&str, &[&str])] = &[
    ("epipole", &[]),
    ("epipole-scenes", &["epipole"]),
    ("epipole-io", &["epipole"]),
    ("epipole-canvas", &[]),
    (
        "epipole-widgets",
        &["epipole", "epipole-io", "epipole-scenes", "epipole-canvas"],
    ),
    ("epipole-web", &["epipole", "epipole-widgets"]),
    (
        "epipole-book",
        &["epipole", "epipole-canvas", "epipole-widgets"],
    ),
    ("epipole-cli", &["epipole", "epipole-io", "epipole-widgets"]),
    (
        "epipole-lab",
        &["epipole", "epipole-io", "epipole-scenes", "epipole-canvas"],
    ),
    ("epipole-schema", &[]),
    (
        "epipole-python",
        &["epipole", "epipole-io", "epipole-schema"],
    ),
    ("epipole-js", &["epipole", "epipole-schema"]),
];

/// Dependencies that only the given crates may have, to keep their use in one place.
const RESERVED: &[(&str, &[&str])] = &[
    ("tiny-skia", &["epipole-canvas"]),
    ("ttf-parser", &["epipole-canvas"]),
    (
        "wasm-bindgen",
        &["epipole-web", "epipole-lab", "epipole-js"],
    ),
    ("js-sys", &["epipole-js"]),
    ("wasm-bindgen-futures", &["epipole-lab"]),
    ("egui", &["epipole-lab"]),
    ("eframe", &["epipole-lab"]),
];

/// The modules of the core: each may use those before it.
const MODULES: &[&str] = &[
    "progress",
    "math",
    "optim",
    "imaging",
    "camera",
    "robust",
    "feature",
    "epipolar",
    "homography",
    "absolute_pose",
    "triangulation",
    "two_view",
    "stereo",
    "calibration",
    "sfm",
    "mvs",
    "stitch",
    "synthetic",
];

/// The modules of the scenes, likewise.
const MODULES_OF_SCENES: &[&str] = &[
    "gradual",
    "detail",
    "shape",
    "paint",
    "objects",
    "light",
    "scene",
    "sets",
    "rendering",
];

/// The modules of the readers and writers, likewise.
const MODULES_OF_IO: &[&str] = &[
    "error",
    "bytes",
    "text",
    "table",
    "matches",
    "tree",
    "tokens",
    "rotation",
    "photo",
    "disparity",
    "depth_map",
    "bundle",
    "pose_graph",
    "colmap",
    "camera",
    "trajectory",
    "cloud",
    "model",
    "fuzz",
];

fn manifest(name: &str) -> toml::Table {
    let path = root().join("crates").join(name).join("Cargo.toml");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    text.parse()
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Names in all tables of dependencies that end up in the crate itself.
fn dependencies(manifest: &toml::Table) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut take = |table: Option<&toml::Value>| {
        names.extend(
            table
                .and_then(toml::Value::as_table)
                .into_iter()
                .flat_map(|t| t.keys().cloned()),
        );
    };
    take(manifest.get("dependencies"));
    take(manifest.get("build-dependencies"));
    let targets = manifest.get("target").and_then(toml::Value::as_table);
    for target in targets.into_iter().flat_map(toml::Table::values) {
        take(target.get("dependencies"));
    }
    names
}

#[test]
fn every_crate_is_on_the_map() {
    let mut found: Vec<String> = fs::read_dir(root().join("crates"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    found.sort();
    let mut known: Vec<&str> = CRATES.iter().map(|(name, _)| *name).collect();
    known.sort_unstable();
    assert_eq!(found, known);
}

#[test]
fn crates_name_only_the_crates_below_them() {
    for (name, allowed) in CRATES {
        let named = dependencies(&manifest(name));
        let house = named
            .iter()
            .filter(|dependency| dependency.starts_with("epipole"));
        let wrong: Vec<&String> = house.filter(|d| !allowed.contains(&d.as_str())).collect();
        assert!(wrong.is_empty(), "{name} must not depend on {wrong:?}");
    }
}

#[test]
fn reserved_dependencies_stay_in_their_crate() {
    for (name, _) in CRATES {
        let named = dependencies(&manifest(name));
        for (dependency, owners) in RESERVED {
            assert!(
                owners.contains(name) || !named.contains(*dependency),
                "{name} must not depend on {dependency}: only {owners:?} may"
            );
        }
    }
}

/// The modules of the core that a source file names.
fn modules_named(text: &str) -> BTreeSet<&str> {
    let mut named = BTreeSet::new();
    for (place, _) in text.match_indices("crate::") {
        let rest = &text[place + "crate::".len()..];
        let end = rest
            .find(|c: char| !c.is_alphanumeric() && c != '_')
            .unwrap_or(rest.len());
        named.insert(&rest[..end]);
        // `use crate::{a::x, b::y};`
        if let Some(list) = rest.strip_prefix('{') {
            let mut depth = 0;
            let mut start = true;
            for (at, c) in list.char_indices() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => start = true,
                    c if start && !c.is_whitespace() => {
                        let word = &list[at..];
                        let end = word
                            .find(|c: char| !c.is_alphanumeric() && c != '_')
                            .unwrap_or(word.len());
                        named.insert(&word[..end]);
                        start = false;
                    }
                    _ => {}
                }
            }
        }
    }
    named
}

/// The part of a file before its tests, which may use any module for their data. Without comments.
fn before_tests(text: &str) -> String {
    let text = text.replace("#[cfg(test)]\nmod tests;", "");
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or("");
    let comment = |line: &&str| !line.trim_start().starts_with("//");
    code.lines().filter(comment).collect::<Vec<_>>().join("\n")
}

/// The files of a module: those of its folder, or its single file.
fn files_of(source: &Path, module: &str) -> Vec<PathBuf> {
    let folder = source.join(module);
    match folder.is_dir() {
        true => files_below(&folder, &["rs"]),
        false => vec![source.join(module).with_extension("rs")],
    }
}

/// Asserts that no module names a later one, and that the list of modules is complete.
fn check_modules(name: &str, modules: &[&str]) {
    let source = root().join("crates").join(name).join("src");
    let mut wrong = Vec::new();
    for (rank, module) in modules.iter().enumerate() {
        for file in files_of(&source, module) {
            let text = before_tests(&fs::read_to_string(&file).unwrap());
            for named in modules_named(&text) {
                let later = modules.iter().position(|other| *other == named);
                if later.is_some_and(|other| other > rank) {
                    let file = file.strip_prefix(&source).unwrap_or(&file);
                    wrong.push(format!("{} names {named}", file.display()));
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "modules of {name} that import a later one: {wrong:#?}"
    );
    for entry in fs::read_dir(source).unwrap() {
        let entry = entry.unwrap();
        if entry.path().is_dir() && !files_below(&entry.path(), &["rs"]).is_empty() {
            let module = entry.file_name().into_string().unwrap();
            assert!(
                modules.contains(&&*module),
                "the module {module} of {name} is not on the map"
            );
        }
    }
}

#[test]
fn modules_use_only_the_modules_before_them() {
    check_modules("epipole", MODULES);
    check_modules("epipole-scenes", MODULES_OF_SCENES);
    check_modules("epipole-io", MODULES_OF_IO);
}

/// The code without string literals, whose words are not imports.
fn without_strings(code: &str) -> String {
    let (mut kept, mut inside, mut escaped) = (String::new(), false, false);
    for c in code.chars() {
        match c {
            _ if escaped => escaped = false,
            '\\' if inside => escaped = true,
            '"' => inside = !inside,
            _ if inside => {}
            c => kept.push(c),
        }
    }
    kept
}

#[test]
fn words_in_quotes_are_left_out() {
    assert_eq!(
        without_strings(r#"a("the \"view\" here", view)"#),
        "a(, view)"
    );
}

/// Whether a file draws: a figure's `view.rs`, or a file in a folder `view`.
fn draws(file: &Path) -> bool {
    let is_view = |part: std::path::Component<'_>| part.as_os_str() == "view";
    file.file_name().is_some_and(|name| name == "view.rs") || file.components().any(is_view)
}

/// The words of a file's code, with paths split up.
fn words_of(file: &Path) -> BTreeSet<String> {
    let text = without_strings(&before_tests(&fs::read_to_string(file).unwrap()));
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .map(str::to_owned)
        .collect()
}

/// Only views draw, and nothing in a figure reads the clock. A model does not use its texts either.
#[test]
fn only_views_draw_and_nothing_knows_the_time() {
    let gallery = root().join("crates/epipole-widgets/src/gallery");
    let files = files_below(&gallery, &["rs"]);
    assert!(files.iter().any(|file| draws(file)));
    for file in &files {
        let words = words_of(file);
        let clock = ["Instant", "SystemTime", "epipole_canvas"];
        let drawing = ["canvas", "theme", "view"];
        let name = file.file_name().unwrap_or_default();
        let mut forbidden = clock.to_vec();
        // `mod.rs` only declares the modules of its figure.
        if !draws(file) && name != "mod.rs" {
            forbidden.extend(drawing);
        }
        if name == "model.rs" {
            forbidden.push("words");
        }
        for word in forbidden {
            assert!(!words.contains(word), "{} names {word}", file.display());
        }
    }
}

/// Dependencies of the Lab's modules: its state uses no screen and no clock, only `web/` the
/// browser.
#[test]
fn the_modules_of_the_lab_keep_apart() {
    let source = root().join("crates/epipole-lab/src");
    let rules: &[(&str, &[&str])] = &[
        ("egui", &["panels", "app", "native", "web"]),
        ("eframe", &["native", "web", "main.rs"]),
        ("wasm_bindgen", &["web"]),
        ("Instant", &[]),
        ("SystemTime", &[]),
    ];
    let files = files_below(&source, &["rs"]);
    assert!(files.len() > 20);
    for file in &files {
        let words = words_of(file);
        let module = file.strip_prefix(&source).unwrap().components().next();
        let module = module.unwrap().as_os_str().to_string_lossy();
        for (word, modules) in rules {
            assert!(
                !words.contains(*word) || modules.contains(&&*module),
                "{} names {word}",
                file.display()
            );
        }
    }
}

/// Modules of the Lab: each may use those before it.
const MODULES_OF_LAB: &[&str] = &["project", "tasks", "session", "panels", "app", "web"];

#[test]
fn modules_of_the_lab_run_one_way() {
    let files = Files::of_crate("epipole-lab");
    let imports = files.imports();
    let rank = |module: &Module| {
        let first = module.first()?;
        MODULES_OF_LAB.iter().position(|other| other == first)
    };
    for (module, named) in &imports {
        let later = named.iter().find(|other| rank(other) > rank(module));
        assert!(
            later.is_none() || rank(module).is_none(),
            "{module:?} names {later:?}"
        );
    }
    let is_there = |module: &&str| imports.contains_key(&vec![(*module).to_owned()]);
    assert!(MODULES_OF_LAB.iter().all(is_there));
}

/// Stages of the book's builder: each may use those before it. The modules that run them are none.
const STAGES: &[&str] = &["parse", "resolve", "render", "directives", "write"];

/// Modules that run the stages.
const RUNNERS: &[&str] = &[
    "reading", "edition", "slides", "site", "print", "epub", "serve",
];

#[test]
fn stages_of_the_builder_run_one_way() {
    let files = Files::of_crate("epipole-book");
    let imports = files.imports();
    let stage = |module: &Module| module.first().cloned().unwrap_or_default();
    let rank = |module: &Module| STAGES.iter().position(|other| *other == stage(module));
    for (module, named) in &imports {
        for other in named {
            if let Some(own) = rank(module) {
                let runner = RUNNERS.contains(&&*stage(other));
                let later = rank(other) > Some(own) || runner;
                // Pages are written without knowledge of the directives.
                let sideways = stage(module) == "write" && stage(other) == "directives";
                assert!(!later && !sideways, "{module:?} names {other:?}");
            }
        }
    }
    let is_there = |stage: &&str| imports.contains_key(&vec![(*stage).to_owned()]);
    assert!(STAGES.iter().all(is_there));
}

#[test]
fn only_the_canvas_names_the_rasterizer() {
    let source = root().join("crates/epipole-canvas/src");
    for file in files_below(&source, &["rs"]) {
        let text = before_tests(&fs::read_to_string(&file).unwrap());
        let is_canvas = file == source.join("canvas.rs") || file.starts_with(source.join("canvas"));
        assert!(
            is_canvas || !text.contains("tiny_skia"),
            "{} names tiny_skia",
            file.display()
        );
    }
}

/// No source names a path of the machine that it was written on.
#[test]
fn no_path_of_a_machine() {
    let top = root();
    let mut files = files_below(
        &top.join("crates"),
        &["rs", "toml", "md", "css", "ts", "hbs"],
    );
    files.extend(files_below(&top.join("content"), &["md", "toml"]));
    let bad = [
        concat!("/ho", "me/"),
        concat!("/ro", "ot/"),
        concat!("/wo", "rk/"),
    ];
    for file in files {
        let text = fs::read_to_string(&file).unwrap_or_default();
        for path in bad {
            assert!(!text.contains(path), "{} names {path}", file.display());
        }
    }
    assert!(Path::new(&top).join("README.md").exists());
}
