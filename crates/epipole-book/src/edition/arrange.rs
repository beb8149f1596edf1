//! Removal of interactive elements from pages.

use super::answers::{AnswerLinks, Answers};
use super::captions::remove_instructions;
use super::tree::Tree;
use crate::html::escape;
use crate::render::page::Page;

/// Elements that are useless without a script.
const CONTROLS: &str = ".anchor, .deck-link, button, .verdict, .listing-bar [role=tablist], [hidden], template, .progress, script:not([src])";

/// Arranges the pages, and adds one with hints, solutions and answers.
pub(super) fn arrange(pages: &mut Vec<Page>, links: AnswerLinks) {
    let mut answers = Answers::new(links);
    for page in pages.iter_mut() {
        let mut tree = Tree::parse(&page.html);
        keep_first_versions(&mut tree);
        remove_instructions(&mut tree);
        for control in tree.all(CONTROLS) {
            tree.remove(control);
        }
        answers.take(&mut tree, page);
        page.html = tree.html();
    }
    pages.extend(answers.page());
}

/// Keeps the first tab of each listing, and names the others.
fn keep_first_versions(tree: &mut Tree) {
    for listing in tree.all(".listing") {
        let names: Vec<String> = tree
            .inside(listing, "[role=tab]")
            .into_iter()
            .filter_map(|tab| tree.attr(tab, "data-label").map(escape))
            .collect();
        let note = match &names[..] {
            [] | [_] => continue,
            [_, other] => other.clone(),
            [_, others @ .., last] => format!("{} and {last}", others.join(", ")),
        };
        let parts = tree.inside(listing, ".listing-part");
        for part in parts.iter().skip(2) {
            tree.remove(*part);
        }
        if let Some(second) = parts.get(1) {
            let note = format!("<p class=\"listing-others\">On the web also in {note}.</p>");
            tree.insert_before(*second, &note);
            tree.remove(*second);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn listings_name_their_other_versions() {
        let tab = |label: &str| format!("<button role=\"tab\" data-label=\"{label}\"></button>");
        let part = |code: &str| format!("<div class=\"listing-part\">{code}</div>");
        for (labels, note) in [
            (&["NumPy"][..], ""),
            (&["NumPy", "Rust"], "On the web also in Rust."),
            (
                &["NumPy", "OpenCV", "Rust", "JavaScript"],
                "On the web also in OpenCV, Rust and JavaScript.",
            ),
        ] {
            let tabs: String = labels.iter().map(|label| tab(label)).collect();
            let parts: String = labels.iter().map(|label| part(label)).collect();
            let mut tree = Tree::parse(&format!("<div class=\"listing\">{tabs}{parts}</div>"));
            keep_first_versions(&mut tree);
            let shown = tree.all(".listing-part");
            assert_eq!(shown.len(), 1);
            assert_eq!(tree.text(shown[0]), "NumPy");
            let notes = tree.all(".listing-part + .listing-others");
            let notes: String = notes.into_iter().map(|note| tree.text(note)).collect();
            assert_eq!(notes, note);
        }
    }
}
