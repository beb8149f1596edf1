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
    for (name, _) in crate::CRATES {
        let files = Files::of_crate(name);
        let found = circles(&files);
        assert!(found.is_empty(), "circles of files in {name}: {found:#?}");
    }
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
