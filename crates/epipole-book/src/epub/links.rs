//! Links between the pages of the file, and to the book on the web.

use crate::edition::tree::{Tree, place};
use crate::html::path_to_root;
use crate::render::page::Page;
use std::collections::{BTreeMap, BTreeSet};

/// All targets of links.
pub(super) struct Places<'a> {
    /// Anchors by the path of their page.
    anchors: BTreeMap<&'a str, BTreeSet<String>>,
    /// Address of the published book, with a trailing slash.
    address: Option<&'a str>,
}

impl<'a> Places<'a> {
    pub(super) fn of(pages: &[(&'a Page, Tree)], address: Option<&'a str>) -> Self {
        let anchors = pages.iter().map(|(page, tree)| {
            let elements = tree.all("[id]").into_iter();
            let ids = elements.filter_map(|node| tree.attr(node, "id").map(str::to_owned));
            (page.path.as_str(), ids.collect())
        });
        Places {
            anchors: anchors.collect(),
            address,
        }
    }

    /// Points the links of a page to the file, or else to the published book. Other links become
    /// plain text.
    pub(super) fn lead(&self, tree: &mut Tree, page: &str) {
        for link in tree.all("a") {
            let href = tree.attr(link, "href").unwrap_or_default();
            let Some((path, rest)) = place(page, href) else {
                continue;
            };
            match self.target(&path, rest, page) {
                Some(target) => tree.set(link, "href", &target),
                None => tree.unwrap(link),
            }
        }
    }

    fn target(&self, path: &str, rest: &str, page: &str) -> Option<String> {
        let Some(anchors) = self.anchors.get(path) else {
            return self.address.map(|address| format!("{address}{path}{rest}"));
        };
        if let Some(anchor) = rest.strip_prefix('#')
            && !anchors.contains(anchor)
        {
            return None;
        }
        Some(match path == page {
            true if !rest.is_empty() => rest.to_owned(),
            _ => format!("{}{}{rest}", path_to_root(page), xhtml_path(path)),
        })
    }
}

/// Returns the path of a page in the file: `part/rays.html#a` becomes `part/rays.xhtml#a`.
pub(super) fn xhtml_path(path: &str) -> String {
    let (path, anchor) = path.split_at(path.find('#').unwrap_or(path.len()));
    let stem = path.strip_suffix(".html").unwrap_or(path);
    format!("{stem}.xhtml{anchor}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_somewhere() {
        let page = |path: &str| Page {
            path: path.to_owned(),
            ..Page::default()
        };
        let (one, two) = (page("one.html"), page("part/two.html"));
        let pages = [
            (&one, Tree::parse("<h1 id=\"top\">1</h1>")),
            (&two, Tree::parse("<p id=\"here\">2</p>")),
        ];
        let led = |address, href: &str| {
            let mut tree = Tree::parse(&format!("<a href=\"{href}\">w</a>"));
            Places::of(&pages, address).lead(&mut tree, "part/two.html");
            let target = tree
                .all("a")
                .first()
                .and_then(|&link| tree.attr(link, "href"));
            target.map(str::to_owned)
        };
        for (href, target) in [
            ("../one.html#top", "../one.xhtml#top"),
            ("../one.html", "../one.xhtml"),
            ("#here", "#here"),
            ("two.html", "../part/two.xhtml"),
            ("https://a.example/b.html", "https://a.example/b.html"),
        ] {
            assert_eq!(led(None, href).as_deref(), Some(target), "{href}");
        }
        for href in ["../one.html#gone", "#gone", "../lab/index.html?a=1"] {
            assert_eq!(led(None, href), None, "{href}");
        }
        let address = Some("https://b.example/");
        let lab = led(address, "../lab/index.html?a=1");
        assert_eq!(lab.as_deref(), Some("https://b.example/lab/index.html?a=1"));
    }
}
