//! `sw.js`: the service worker of a published book, with the list of files that it caches. A book
//! under construction gets a worker that removes the published one.

use super::bundle::bundle;
use super::files::{Assets, add_hashed};
use crate::tools::Tools;
use anyhow::{Context, Result};
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// Path of the worker. It never changes, as browsers check it for a new edition.
const WORKER: &str = "sw.js";

/// Extensions of the assets that every page needs.
const CORE: &[&str] = &["css", "js", "svg", "woff2"];

type Files = BTreeMap<String, Vec<u8>>;

/// Files of an edition, in the order in which the worker of `web/offline/edition.ts` loads them.
#[derive(Debug, Serialize)]
struct List<'a> {
    core: Vec<&'a str>,
    /// Groups of files by page; files of a group show the same in several widths and themes.
    pages: BTreeMap<&'a str, Vec<Vec<&'a str>>>,
    rest: Vec<&'a str>,
    integrity: BTreeMap<&'a str, String>,
}

impl<'a> List<'a> {
    fn new(pages: &[&'a str], files: &'a Files) -> Self {
        let core = files.keys().map(String::as_str).filter(|path| {
            let extension = Path::new(path).extension().and_then(|end| end.to_str());
            let is_code = extension.is_some_and(|end| CORE.contains(&end));
            let is_flat = path.matches('/').count() == 1;
            path.starts_with("assets/") && is_flat && is_code || path.starts_with("assets/epipole-")
        });
        let core: Vec<&str> = core.collect();
        let others = files.keys().map(String::as_str);
        let others = others.filter(|path| path.starts_with("assets/") && !core.contains(path));
        let others: Vec<&str> = others.collect();
        let pages: BTreeMap<&str, Vec<Vec<&str>>> = pages
            .iter()
            .filter_map(|page| {
                let html = std::str::from_utf8(files.get(*page)?).ok()?;
                Some((*page, groups(html, &others)))
            })
            .collect();
        // Other pictures of figures are for frames on other sites.
        let rest = others
            .iter()
            .filter(|path| !path.starts_with("assets/figures/"))
            .filter(|path| !pages.values().flatten().any(|own| own.contains(path)))
            .copied()
            .collect();
        let integrity = pages.keys().map(|page| {
            let hash = Sha256::digest(&files[*page]);
            (*page, format!("sha256-{}", BASE64_STANDARD.encode(hash)))
        });
        let integrity = integrity.collect();
        List {
            core,
            pages,
            rest,
            integrity,
        }
    }
}

/// Groups the files of a page that are in no other group: those of each `<picture>`, and each other
/// file alone.
fn groups<'a>(html: &str, files: &[&'a str]) -> Vec<Vec<&'a str>> {
    let mut left: Vec<&str> = (files.iter().copied())
        .filter(|path| html.contains(path))
        .collect();
    let mut groups: Vec<Vec<&str>> = html
        .split("<picture")
        .skip(1)
        .filter_map(|rest| rest.split_once("</picture>"))
        .map(|(picture, _)| {
            left.extract_if(.., |path| picture.contains(*path))
                .collect()
        })
        .collect();
    groups.extend(left.into_iter().map(|path| vec![path]));
    groups.retain(|group| !group.is_empty());
    groups
}

/// Adds the worker for these pages, after all other files.
///
/// # Errors
/// If esbuild is missing or fails.
pub fn add_offline(project: &Path, live: bool, pages: &[&str], files: &mut Files) -> Result<()> {
    let tools = Tools::find(project)?;
    let source = match live {
        true => "web/offline/retire.ts",
        false => "web/offline/sw.ts",
    };
    let list = serde_json::to_vec(&List::new(pages, files))?;
    let list = match live {
        true => String::new(),
        false => add_hashed(files, "offline", "json", list),
    };
    let list = format!("--define:EPIPOLE_LIST={list:?}");
    let mut made = Assets::default();
    let names = bundle(&tools, source, &["--format=iife", &list], live, &mut made)?;
    let name = names.into_values().next();
    let bytes = name.and_then(|name| made.files.remove(&name));
    files.insert(
        WORKER.to_owned(),
        bytes.context("esbuild made no service worker")?,
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_its_pictures_and_frames_have_none() {
        let html = "<picture><source srcset=\"assets/figures/dot-1.webp\"><img src=\"assets/figures/dot-2.webp\">\
                    </picture><img src=\"assets/figures/dot-3.webp\">";
        let files = [
            ("a.html", html),
            ("404.html", ""),
            ("embed/dot.html", ""),
            ("assets/page-1.js", ""),
            ("assets/vision-1/part.js", ""),
            ("assets/epipole-figures-1.wasm", ""),
            ("assets/figures/dot-1.webp", ""),
            ("assets/figures/dot-2.webp", ""),
            ("assets/figures/dot-3.webp", ""),
            ("assets/figures/dot-4.webp", ""),
            ("assets/search-1.json", ""),
        ];
        let files: Files = files
            .map(|(path, text)| (path.to_owned(), text.into()))
            .into();
        let list = List::new(&["a.html"], &files);
        assert_eq!(
            list.core,
            ["assets/epipole-figures-1.wasm", "assets/page-1.js"]
        );
        assert_eq!(
            list.pages,
            BTreeMap::from([(
                "a.html",
                vec![
                    vec!["assets/figures/dot-1.webp", "assets/figures/dot-2.webp"],
                    vec!["assets/figures/dot-3.webp"],
                ]
            )])
        );
        assert_eq!(
            list.rest,
            ["assets/search-1.json", "assets/vision-1/part.js"]
        );
        assert_eq!(list.integrity.len(), 1);
        let edition = |text: &str| {
            let mut files = files.clone();
            files.insert("a.html".to_owned(), text.into());
            serde_json::to_string(&List::new(&["a.html"], &files)).unwrap()
        };
        assert_eq!(edition(html), edition(html));
        let new = format!("{html}A new sentence.");
        assert_ne!(edition(html), edition(&new));
    }
}
