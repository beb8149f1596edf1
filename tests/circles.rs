//! Import cycles: no file may import, directly or through others, a file that imports it.

use crate::imports::{Files, Module, sources};
use std::collections::BTreeSet;

/// The strongly connected components of the import graph: sets of files that reach each other.
fn circles(files: &Files) -> Vec<BTreeSet<&str>> {
    let mut reached = files.imports();
    let modules: Vec<&Module> = reached.keys().copied().collect();
    // Transitive closure, by iteration until nothing is added.
    let mut grows = true;
    while grows {
        grows = false;
        for &module in &modules {
            let direct = reached[module].clone();
            let further = direct.iter().flat_map(|next| reached[*next].iter());
            let all: BTreeSet<&Module> = further.chain(&direct).copied().collect();
            grows |= all.len() > direct.len();
            reached.insert(module, all);
        }
    }
    let mut circles = BTreeSet::new();
    for (module, all) in &reached {
        if all.contains(module) {
            let both = all.iter().filter(|other| reached[**other].contains(module));
            circles.insert(both.map(|other| files.path(other)).collect());
        }
    }
    circles.into_iter().collect()
}

#[test]
fn files_import_in_no_circle() {
    let mut wrong = Vec::new();
    let remaining = remaining();
    for (name, _) in crate::CRATES {
        let files = Files::of_crate(name);
        let mut allowed: Vec<_> = remaining
            .iter()
            .filter(|entry| entry.of_crate == *name)
            .collect();
        for circle in circles(&files) {
            let is_within = |entry: &&Remaining| {
                circle
                    .iter()
                    .all(|file| entry.files.iter().any(|listed| listed == file))
            };
            match allowed.iter().position(is_within) {
                Some(place) => drop(allowed.remove(place)),
                None => wrong.push(format!("{name}: {circle:?}")),
            }
        }
        for entry in allowed {
            let files = &entry.files;
            wrong.push(format!(
                "{name}: {files:?} is no circle any more: take it off the list"
            ));
        }
    }
    assert!(wrong.is_empty(), "circles of files: {wrong:#?}");
}

#[test]
fn a_circle_through_exports_of_a_parent_is_found() {
    let files = sources(&[
        ("room", "mod a;\nmod b;\npub use a::A;\npub use b::*;"),
        ("room a", "use super::B;\npub struct A;"),
        (
            "room b",
            "use crate::room;\npub struct B;\nfn f(_: room::A) {}",
        ),
        ("room c", "use super::{A, B};"),
    ]);
    assert_eq!(
        circles(&files),
        [BTreeSet::from(["room a.rs", "room b.rs"])]
    );
}

/// An import cycle that is still allowed.
struct Remaining {
    of_crate: String,
    files: Vec<String>,
}

/// The list in `circles.toml`.
fn remaining() -> Vec<Remaining> {
    let text: toml::Table = include_str!("circles.toml").parse().unwrap();
    let circles = text["circle"].as_array().unwrap().iter();
    let word = |value: &toml::Value| value.as_str().unwrap().to_owned();
    circles
        .map(|circle| {
            assert!(!word(&circle["reason"]).is_empty());
            Remaining {
                of_crate: word(&circle["crate"]),
                files: circle["files"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .map(word)
                    .collect(),
            }
        })
        .collect()
}
