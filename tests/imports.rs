//! Import graph of the files of a crate, read from the sources.

use crate::{before_tests, without_strings};
use epipole_tests::{files_below, root};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// Path of a module from the root of its crate.
pub(crate) type Module = Vec<String>;

/// A source file without tests, comments and strings, as far as imports need it.
struct File {
    module: Module,
    /// Names that the file defines.
    defined: BTreeSet<String>,
    /// Imported names with the paths they come from; `*` for a whole module.
    imports: Vec<(String, Module)>,
    /// Re-exported names, likewise.
    exports: Vec<(String, Module)>,
    /// Paths in the code.
    paths: Vec<Module>,
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Splits code into words and single other characters.
fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code;
    while let Some(c) = rest.chars().next() {
        let len = match is_word(c) {
            true => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            false => c.len_utf8(),
        };
        if !c.is_whitespace() {
            tokens.push(&rest[..len]);
        }
        rest = &rest[len..];
    }
    tokens
}

/// Collects the names that a tree of imports brings, with their paths. Returns the tokens behind
/// it.
fn import_tree<'a>(
    mut tokens: &'a [&'a str],
    mut path: Module,
    found: &mut Vec<(String, Module)>,
) -> &'a [&'a str] {
    loop {
        match tokens {
            [":", ":", after @ ..] => tokens = after,
            ["{", after @ ..] => {
                tokens = after;
                while let Some(&first) = tokens.first() {
                    match first {
                        "}" => return &tokens[1..],
                        "," => tokens = &tokens[1..],
                        _ => tokens = import_tree(tokens, path.clone(), found),
                    }
                }
                return tokens;
            }
            ["*", after @ ..] => {
                found.push(("*".to_owned(), path));
                return after;
            }
            ["as", name, after @ ..] => {
                found.push(((*name).to_owned(), path));
                return after;
            }
            ["self", after @ ..] if !path.is_empty() => tokens = after,
            [word, after @ ..] if word.starts_with(is_word) => {
                path.push((*word).to_owned());
                tokens = after;
            }
            _ => {
                if let Some(name) = path.last() {
                    found.push((name.clone(), path.clone()));
                }
                return tokens;
            }
        }
    }
}

impl File {
    fn read(module: Module, text: &str) -> Self {
        let code = without_strings(&before_tests(text));
        let mut file = Self {
            module,
            defined: BTreeSet::new(),
            imports: Vec::new(),
            exports: Vec::new(),
            paths: Vec::new(),
        };
        let all = tokens(&code);
        let mut rest = &all[..];
        let mut is_public = false;
        while let Some((&first, after)) = rest.split_first() {
            rest = after;
            match first {
                "use" => {
                    let list = match is_public {
                        true => &mut file.exports,
                        false => &mut file.imports,
                    };
                    rest = import_tree(after, Module::new(), list);
                }
                "fn" | "struct" | "enum" | "trait" | "const" | "static" | "type" | "union" => {
                    file.defined
                        .extend(after.first().map(|&name| name.to_owned()));
                }
                "pub" => {
                    is_public = true;
                    if let ["(", inner @ ..] = after {
                        let end = inner.iter().position(|&token| token == ")");
                        rest = &inner[end.map_or(0, |end| end + 1)..];
                    }
                    continue;
                }
                word if word.starts_with(is_word) && matches!(after, [":", ":", ..]) => {
                    let mut path = vec![word.to_owned()];
                    while let [":", ":", next, more @ ..] = rest
                        && next.starts_with(is_word)
                    {
                        path.push((*next).to_owned());
                        rest = more;
                    }
                    file.paths.push(path);
                }
                _ => {}
            }
            is_public = false;
        }
        file
    }
}

/// Files of a crate, by module.
pub(crate) struct Files(BTreeMap<Module, (String, File)>);

impl Files {
    pub(crate) fn of_crate(name: &str) -> Self {
        let source = root().join("crates").join(name).join("src");
        let mut sources = Vec::new();
        for path in files_below(&source, &["rs"]) {
            let below = path
                .strip_prefix(&source)
                .unwrap_or(&path)
                .with_extension("");
            let mut module: Module = (below.iter())
                .map(|part| part.to_string_lossy().into_owned())
                .collect();
            if module.last().is_some_and(|last| last == "mod") || module == ["lib"] {
                module.pop();
            }
            let is_test = |part: &String| part == "tests" || part.ends_with("_tests");
            if module.iter().any(is_test) {
                continue;
            }
            let shown = path
                .strip_prefix(&source)
                .unwrap_or(&path)
                .display()
                .to_string();
            let text = fs::read_to_string(&path).unwrap_or_default();
            sources.push((module, shown, text));
        }
        Self::read(sources)
    }

    /// Parses sources, each given as module, path and text.
    pub(crate) fn read(sources: Vec<(Module, String, String)>) -> Self {
        let read = |(module, shown, text): (Module, String, String)| {
            let file = File::read(module.clone(), &text);
            (module, (shown, file))
        };
        Self(sources.into_iter().map(read).collect())
    }

    /// Path of a module's file relative to `src`.
    pub(crate) fn path(&self, module: &Module) -> &str {
        &self.0[module].0
    }

    /// All modules, each with the modules that it imports.
    pub(crate) fn imports(&self) -> BTreeMap<&Module, BTreeSet<&Module>> {
        let files = self.0.iter();
        files
            .map(|(module, (_, file))| (module, self.arrows(file)))
            .collect()
    }

    /// Resolves a path in `file` to one from the root of the crate; `None` for another crate.
    fn absolute(&self, file: &File, path: &[String]) -> Option<Module> {
        let mut at = file.module.clone();
        let mut rest = path;
        match rest.first()?.as_str() {
            "crate" => (at, rest) = (Module::new(), &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {
                while let Some(("super", after)) = rest.split_first().map(|(a, b)| (a.as_str(), b))
                {
                    at.pop();
                    rest = after;
                }
            }
            first => {
                let child = [&at[..], &[first.to_owned()]].concat();
                if !self.0.contains_key(&child) {
                    // An imported name.
                    let (_, path) = (file.imports.iter()).find(|(name, _)| name == first)?;
                    if path.first().is_some_and(|start| start == first) {
                        return None;
                    }
                    at = self.absolute(file, path)?;
                    rest = &rest[1..];
                }
            }
        }
        at.extend(rest.iter().cloned());
        Some(at)
    }

    /// The module that defines the item of an absolute path; `None` for a module as a whole.
    fn definer(&self, path: &[String], depth: usize) -> Option<&Module> {
        let known = (0..=path.len())
            .rev()
            .find(|&len| self.0.contains_key(&path[..len]))?;
        let (module, (_, file)) = self.0.get_key_value(&path[..known])?;
        let name = path.get(known)?;
        if file.defined.contains(name) || depth == 0 {
            return Some(module);
        }
        let through = |exported: &Module, name: Option<&String>| {
            let mut path = self.absolute(file, exported)?;
            path.extend(name.cloned());
            self.definer(&path, depth - 1)
        };
        let mut exports = file.exports.iter();
        if let Some((_, exported)) = exports.find(|(exported, _)| exported == name) {
            return through(exported, None);
        }
        let mut all = file.exports.iter().filter(|(exported, _)| exported == "*");
        let behind = all.find_map(|(_, exported)| {
            let target = through(exported, Some(name))?;
            self.0[target].1.defined.contains(name).then_some(target)
        });
        behind.or(Some(module))
    }

    /// The modules that a file imports from.
    fn arrows(&self, file: &File) -> BTreeSet<&Module> {
        let imported = (file.imports.iter()).map(|(name, path)| match name.as_str() {
            "*" => [&path[..], &["*".to_owned()]].concat(),
            _ => path.clone(),
        });
        let paths = imported.chain(file.paths.iter().cloned());
        paths
            .filter_map(|path| self.definer(&self.absolute(file, &path)?, 8))
            .filter(|target| **target != file.module)
            .collect()
    }
}

#[test]
fn paths_are_taken_apart() {
    let code = "use crate::{a::{b, c::d}, e}; super::f(g::h)";
    let file = File::read(Module::new(), code);
    let imports = file.imports.iter().map(|(_, path)| path.join("::"));
    let paths = file.paths.iter().map(|path| path.join("::"));
    assert_eq!(
        imports.chain(paths).collect::<Vec<_>>(),
        [
            "crate::a::b",
            "crate::a::c::d",
            "crate::e",
            "super::f",
            "g::h"
        ]
    );
    let files = sources(&[("", ""), ("a", ""), ("a b", "")]);
    let from = |path: &str| {
        let (_, file) = &files.0[&module(path)];
        files.absolute(file, &module("super f"))
    };
    assert_eq!(from("a b"), Some(module("a f")));
    assert_eq!(from("a"), Some(module("f")));
}

#[test]
fn exports_of_a_parent_are_looked_through() {
    let files = sources(&[
        ("", "mod room;"),
        (
            "room",
            "mod a;\nmod b;\npub use a::{A, helper};\npub use b::*;",
        ),
        ("room a", "use super::B;\npub struct A;\npub fn helper() {}"),
        (
            "room b",
            "use crate::room::{self, C};\npub struct B;\npub struct C;\nfn f() { room::helper() }",
        ),
        (
            "room c",
            "use super::{A, B};\nfn g(_: crate::room::a::A) {}",
        ),
    ]);
    let imports = files.imports();
    let of = |path: &str| {
        imports[&module(path)]
            .iter()
            .map(|m| m.join(" "))
            .collect::<Vec<_>>()
    };
    assert_eq!(of("room a"), ["room b"]);
    assert_eq!(of("room b"), ["room a"]);
    assert_eq!(of("room c"), ["room a", "room b"]);
    assert!(of("room").is_empty());
}

#[test]
fn only_the_declaration_of_tests_is_left_out() {
    let files = sources(&[
        ("a", "#[cfg(test)]\nmod tests;\nuse crate::b::B;"),
        (
            "b",
            "struct B;\n#[cfg(test)]\nmod tests { use crate::a::A; }",
        ),
    ]);
    let imports = files.imports();
    assert_eq!(imports[&module("a")], BTreeSet::from([&module("b")]));
    assert!(imports[&module("b")].is_empty());
}

/// Parses a module path, separated by spaces.
fn module(path: &str) -> Module {
    path.split_whitespace().map(str::to_owned).collect()
}

/// The files of a made-up crate, from module paths and texts.
pub(crate) fn sources(list: &[(&str, &str)]) -> Files {
    let source =
        |&(path, text): &(&str, &str)| (module(path), format!("{path}.rs"), text.to_owned());
    Files::read(list.iter().map(source).collect())
}
