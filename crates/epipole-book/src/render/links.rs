//! Links and pictures: relative, and checked.

use crate::html::escape;
use crate::problems::{Place, Problems, name_list};
use crate::render::markdown::Renderer;
use crate::render::page::{Link, Page};
use crate::write::assets::LAB_FOLDER;
use std::collections::{BTreeMap, BTreeSet};

/// A link as it goes into the page. Links between chapters name the Markdown file, and the
/// anchor of a section or a figure.
pub(crate) fn rewrite(renderer: &mut Renderer, written: &str, place: Place) -> String {
    if is_external(written) {
        return written.to_owned();
    }
    if written.starts_with('/') {
        let message =
            format!("the link \"{written}\" starts with /: write it relative to this file");
        renderer.report(place, message);
        return written.to_owned();
    }
    let (path, fragment) = match written.split_once('#') {
        Some((path, fragment)) => (path, Some(fragment.to_owned())),
        None => (written, None),
    };
    let own = renderer.page.path.clone();
    if path.is_empty() {
        let written = written.to_owned();
        renderer.page.links.push(Link {
            page: own,
            fragment,
            written,
            place,
        });
        return renderer
            .page
            .links
            .last()
            .map(|link| link.written.clone())
            .unwrap_or_default();
    }
    if let Some(link) = to_the_lab(&own, path) {
        return link;
    }
    let target = resolve_path(&own, path);
    if let Some(stem) = target.strip_suffix(".md") {
        let page = format!("{stem}.html");
        let shown = path.trim_end_matches(".md");
        let href = match &fragment {
            Some(fragment) => format!("{shown}.html#{fragment}"),
            None => format!("{shown}.html"),
        };
        let written = written.to_owned();
        renderer.page.links.push(Link {
            page,
            fragment,
            written,
            place,
        });
        return href;
    }
    if !renderer.shared.copy_file(&target) {
        renderer.report(
            place,
            format!("the link \"{written}\" leads nowhere: there is no {target}"),
        );
    }
    written.to_owned()
}

/// A picture of the content folder as HTML.
pub(crate) fn image(
    renderer: &mut Renderer,
    written: &str,
    title: &str,
    alternative: &str,
    place: Place,
) -> String {
    if is_external(written) || written.starts_with('/') {
        let message = format!("the picture \"{written}\" must be a file of the content folder");
        renderer.report(place, message);
        return String::new();
    }
    if alternative.is_empty() {
        let message = format!("the picture \"{written}\" needs words for those who cannot see it");
        renderer.report(place.clone(), message);
    }
    let target = resolve_path(&renderer.page.path, written);
    if !renderer.shared.copy_file(&target) {
        renderer.report(place, format!("there is no picture {target}"));
    }
    let title = if title.is_empty() {
        String::new()
    } else {
        format!(" title=\"{}\"", escape(title))
    };
    format!(
        "<img src=\"{}\" alt=\"{}\"{title} loading=\"lazy\" decoding=\"async\">",
        escape(written),
        escape(alternative)
    )
}

/// A link to the Lab, `lab/` with parameters or without: it is beside the book or, until it is built, a page that
/// says so. Written out, so that no server needs to look for the page of a folder.
fn to_the_lab(own: &str, written: &str) -> Option<String> {
    let (path, parameters) = match written.find('?') {
        Some(at) => written.split_at(at),
        None => (written, ""),
    };
    let is_the_lab = resolve_path(own, path) == LAB_FOLDER && path.ends_with('/');
    is_the_lab.then(|| format!("{path}index.html{parameters}"))
}

/// `https:`, `mailto:` and the like.
fn is_external(written: &str) -> bool {
    let scheme = written.split(['/', '#', '?']).next().unwrap_or("");
    scheme.contains(':') || written.starts_with("//")
}

/// The path that `written` means on the page at `own`.
fn resolve_path(own: &str, written: &str) -> String {
    let mut parts: Vec<&str> = own.split('/').collect();
    parts.pop();
    for part in written.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Reports links to pages or anchors that do not exist, and anchors that exist twice.
pub(crate) fn check(pages: &[Page], drafts: &BTreeSet<String>, problems: &Problems) {
    let mut anchors: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for page in pages {
        let mut ids = BTreeSet::new();
        for id in ids_of(&page.html) {
            if !ids.insert(id.clone())
                && let Some(figure) = page.figures.iter().rev().find(|figure| figure.id == id)
            {
                let message = format!("two elements are called \"{id}\": give this figure an id=…");
                problems.report(figure.place.clone(), message);
            }
        }
        anchors.insert(&page.path, ids);
    }
    for link in pages.iter().flat_map(|page| &page.links) {
        let written = &link.written;
        let Some(ids) = anchors.get(link.page.as_str()) else {
            let chapters: Vec<String> = pages
                .iter()
                .map(|page| page.path.replace(".html", ".md"))
                .collect();
            let message = if drafts.contains(&link.page) {
                format!("the link \"{written}\" leads to a draft")
            } else {
                let known = name_list(&chapters);
                format!("the link \"{written}\" leads to no chapter; chapters: {known}")
            };
            problems.report(link.place.clone(), message);
            continue;
        };
        if let Some(fragment) = &link.fragment
            && !ids.contains(fragment)
        {
            let known: Vec<&String> = ids.iter().filter(|id| !id.starts_with("quiz-")).collect();
            let message = format!(
                "the link \"{written}\" leads to no section; anchors there: {}",
                name_list(&known)
            );
            problems.report(link.place.clone(), message);
        }
    }
}

/// All `id`s of a page.
pub(crate) fn ids_of(html: &str) -> Vec<String> {
    let mut ids = Vec::new();
    let mut rest = html;
    while let Some(open) = rest.find('<') {
        rest = &rest[open + 1..];
        if !rest.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
            continue;
        }
        let name = rest
            .find(|c: char| !c.is_ascii_alphanumeric() && c != '-')
            .unwrap_or(rest.len());
        let (attributes, after) = crate::html::attributes(&rest[name..]);
        ids.extend(
            attributes
                .into_iter()
                .filter(|(key, _)| key == "id")
                .map(|(_, id)| id),
        );
        rest = after;
    }
    ids
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_resolved() {
        assert_eq!(resolve_path("a.html", "b.md"), "b.md");
        assert_eq!(resolve_path("part/a.html", "../b.md"), "b.md");
        assert_eq!(resolve_path("part/a.html", "./c/d.md"), "part/c/d.md");
    }

    #[test]
    fn links_to_the_lab_name_its_page() {
        let link = |own, written| to_the_lab(own, written);
        assert_eq!(link("a.html", "lab/"), Some("lab/index.html".to_owned()));
        assert_eq!(
            link("part/a.html", "../lab/?step=matches&ratio=0.8"),
            Some("../lab/index.html?step=matches&ratio=0.8".to_owned())
        );
        for other in [
            "lab",
            "lab.md",
            "lab/picture.png",
            "part/lab/",
            "?step=lab/",
        ] {
            assert_eq!(link("a.html", other), None, "{other}");
        }
    }

    #[test]
    fn external_links() {
        for (link, external) in [
            ("https://a.b/c", true),
            ("mailto:a@b", true),
            ("//a.b", true),
            ("a.md#b:c", false),
            ("#x", false),
        ] {
            assert_eq!(is_external(link), external, "{link}");
        }
    }

    #[test]
    fn ids() {
        assert_eq!(
            ids_of("<p id=a><epipole-figure id=\"b\" x='>'></p> <c id=d"),
            ["a", "b", "d"]
        );
    }
}
