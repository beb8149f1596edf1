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

/// Circles that are not listed, and listed sets that are not exactly a circle.
fn differences(found: &[BTreeSet<&str>], listed: &[BTreeSet<&str>]) -> Vec<String> {
    let unlisted = found.iter().filter(|circle| !listed.contains(circle));
    let stale = listed.iter().filter(|files| !found.contains(files));
    unlisted
        .map(|circle| format!("{circle:?} is a circle that is not listed"))
        .chain(stale.map(|files| format!("{files:?} is listed, but is not exactly a circle")))
        .collect()
}

#[test]
fn files_import_in_no_circle() {
    let mut wrong = Vec::new();
    let remaining = remaining();
    for (name, _) in crate::CRATES {
        let files = Files::of_crate(name);
        let of_crate = remaining.iter().filter(|entry| entry.of_crate == *name);
        let listed: Vec<BTreeSet<&str>> = of_crate
            .map(|entry| entry.files.iter().map(String::as_str).collect())
            .collect();
        let differences = differences(&circles(&files), &listed);
        wrong.extend(differences.iter().map(|text| format!("{name}: {text}")));
    }
    assert!(wrong.is_empty(), "circles of files: {wrong:#?}");
}

#[test]
fn a_listed_circle_is_exactly_one_that_is_found() {
    let found = [BTreeSet::from(["a.rs", "b.rs"])];
    assert!(differences(&found, &found).is_empty());
    let larger = [BTreeSet::from(["a.rs", "b.rs", "c.rs"])];
    assert_eq!(differences(&found, &larger).len(), 2);
    assert_eq!(differences(&[], &found).len(), 1);
    assert_eq!(differences(&found, &[]).len(), 1);
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
