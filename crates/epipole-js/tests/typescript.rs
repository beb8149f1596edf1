//! Type declarations of the npm package, `web/vision/src/api.ts` and `parts.ts`.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use epipole_js::types::{Types, comment};
use epipole_js::value::{camel, is_name};
use epipole_js::{GROUPS, PARTS, signatures};
use std::fs;
use std::path::{Path, PathBuf};

const SOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../web/vision/src");
const CORE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../epipole/src");

#[test]
fn declarations_of_the_package_are_those_of_the_functions() {
    for (name, text) in [("api.ts", api()), ("parts.ts", parts())] {
        let path = Path::new(SOURCES).join(name);
        if std::env::var_os("EPIPOLE_BLESS").is_some() {
            fs::write(path, text).unwrap();
            continue;
        }
        let written = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            written == text,
            "{name} is out of date: run `make bless-vision`"
        );
    }
}

fn api() -> String {
    let mut types = Types::default();
    let groups = signatures(&mut types);
    let core = core_sources();
    types.document(|name, field| docs(&core, name, field));
    let (mut table, mut methods) = (String::new(), String::new());
    for (group, signatures) in GROUPS.iter().zip(groups) {
        for signature in signatures {
            let names = signature.parameters.iter().map(|(name, ..)| name);
            let words: Vec<String> = [camel(group.part)]
                .iter()
                .chain(names)
                .map(|word| format!("{word:?}"))
                .collect();
            table += &format!("  {}: [{}],\n", signature.name, words.join(", "));
            let lines: Vec<&str> = signature.docs.iter().map(|line| line.trim()).collect();
            methods += &comment("  ", &lines.join(" "));
            let parameters: Vec<String> = signature
                .parameters
                .iter()
                .map(|(name, of, is_optional)| {
                    let is_extended = name == "options" && of != "Control";
                    let more = if is_extended { " & Control" } else { "" };
                    let mark = if *is_optional { "?" } else { "" };
                    format!("{name}{mark}: {of}{more}")
                })
                .collect();
            let (parameters, result) = (parameters.join(", "), signature.result);
            methods += &format!("  {}({parameters}): Promise<{result}>;\n", signature.name);
        }
    }
    let parts = part_names();
    let union: Vec<String> = parts.iter().map(|name| format!("{name:?}")).collect();
    let names: Vec<&str> = PARTS.iter().map(|(name, _)| *name).collect();
    let larger = PARTS.iter();
    let larger = larger.map(|(name, larger)| format!("  {}: {},\n", camel(name), quoted(larger)));
    let larger: String = larger.collect();
    format!(
        "/** Functions, options and results. Written by `make bless-vision` from `epipole-js`. */\n\n\
         import type {{ Control }} from \"./control.js\";\n\
         import type {{ Picture }} from \"./pictures.js\";\n\n\
         /** A part of the library, a module. */\nexport type Part = {};\n\n\
         /** Parts of the library. @hidden */\n\
         export const PART_NAMES: readonly Part[] = {};\n\n\
         /** Larger parts that contain each part, smallest first. @hidden */\n\
         export const LARGER: Readonly<Record<Part, readonly Part[]>> = {{\n{larger}}};\n\n\
         /** Smallest part and parameters of each function. @hidden */\n\
         export const FUNCTIONS: Readonly<Record<string, readonly [Part, ...string[]]>> = {{\n{table}}};\n\n\
         {}\n/** Functions by part. @hidden */\nexport interface Functions {{\n{methods}}}\n",
        union.join(" | "),
        quoted(&names),
        types.text()
    )
}

fn part_names() -> Vec<String> {
    PARTS.iter().map(|(name, _)| camel(name)).collect()
}

/// A list of strings.
fn quoted(names: &[&str]) -> String {
    let names: Vec<String> = names
        .iter()
        .map(|name| format!("{:?}", camel(name)))
        .collect();
    format!("[{}]", names.join(", "))
}

/// Imports are static: bundlers make workers of one script, which cannot load others.
fn parts() -> String {
    let names = part_names();
    let imports = names
        .iter()
        .map(|name| format!("import * as {name} from \"./parts/{name}.part.js\";\n"));
    let lines = names.iter().map(|name| {
        format!(
            "  {name}: {{ script: {name}, wasm: () => \
             new URL(\"./parts/{name}.wasm\", import.meta.url) }},\n"
        )
    });
    format!(
        "/** Parts, each a module. Written by `make bless-vision` from `epipole-js`. */\n\n\
         import type {{ Part }} from \"./api.js\";\n\
         {}import type {{ Source }} from \"./source.js\";\n\n\
         /** Script and module of each part: literal addresses, which bundlers find. */\n\
         export const PARTS: Readonly<Record<Part, Source>> = {{\n{}}};\n",
        imports.collect::<String>(),
        lines.collect::<String>()
    )
}

/// All sources of the core.
fn core_sources() -> Vec<String> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => walk(&path, found),
                false => found.push(path),
            }
        }
    }
    let mut paths = Vec::new();
    walk(Path::new(CORE), &mut paths);
    paths.sort();
    let texts = paths.iter().map(|path| fs::read_to_string(path).unwrap());
    texts.collect()
}

/// First paragraph of the documentation of a struct of the core, or of one of its fields.
fn docs(core: &[String], name: &str, field: Option<&str>) -> Option<String> {
    let head = format!("pub struct {name} {{\n");
    let (before, after) = core.iter().find_map(|text| text.split_once(&head))?;
    let lines: Vec<&str> = match field {
        None => before.lines().collect(),
        Some(field) => {
            let body = after.split("\n}\n").next()?;
            let is_field = |line: &&str| {
                let rest = line.trim().strip_prefix("pub ");
                rest.and_then(|rest| rest.split_once(':'))
                    .is_some_and(|(found, _)| camel(found) == field)
            };
            body.lines().take_while(|line| !is_field(line)).collect()
        }
    };
    let mut block: Vec<&str> = lines
        .iter()
        .rev()
        .map(|line| line.trim())
        .skip_while(|line| !line.starts_with("///"))
        .take_while(|line| line.starts_with("///"))
        .map(|line| line.trim_start_matches("///").trim())
        .collect();
    block.reverse();
    let paragraph: Vec<&str> = block
        .into_iter()
        .take_while(|line| !line.is_empty())
        .collect();
    Some(without_links(&paragraph.join(" ")))
}

/// Text without the links of rustdoc, and with names in camel case.
fn without_links(text: &str) -> String {
    let mut out = String::new();
    for (index, part) in text.split('`').enumerate() {
        if index % 2 == 1 {
            let name = part.rsplit("::").next().unwrap_or(part);
            out += "`";
            out += &if is_name(name) {
                camel(name)
            } else {
                part.to_owned()
            };
            out += "`";
            continue;
        }
        // Between names: the end of one link, and the beginning of another.
        let part = match part.strip_prefix(']') {
            Some(rest) if rest.starts_with('(') => rest.split_once(')').map_or(rest, |x| x.1),
            Some(rest) => rest,
            None => part,
        };
        out += part.strip_suffix('[').unwrap_or(part);
    }
    out
}
