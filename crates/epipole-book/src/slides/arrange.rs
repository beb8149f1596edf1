//! Conversion of a chapter to slides: each section is a stack, with the first sentence, formulas,
//! tables, lists and figures on slides, and the remaining text in the notes.

use super::questions;
use super::slide::{Kind, Slide, Stack};
use crate::edition::sentence;
use crate::edition::tree::{Tree, place};
use ego_tree::NodeId;

/// Ids of sections to omit, as they are work for the reader.
const LEFT_OUT: [&str; 3] = ["in-code", "exercises", "sources"];
/// Elements that are useless on a slide.
const PARTS: &str =
    "template, .anchor, .reading-time, .notebook, .deck-link, .listing, script:not([src])";
/// Attributes of links and pictures.
const ADDRESSES: [&str; 3] = ["href", "src", "srcset"];
/// Maximum number of formulas per slide.
const MAX_FORMULAS: usize = 2;

/// Returns the stacks of a chapter; the first one is the content before all sections.
///
/// * `page`: path of the chapter, from the root of the site; decks are one folder below it
pub(super) fn stacks(html: &str, page: &str) -> Vec<Stack> {
    let mut tree = Tree::parse(html);
    for part in tree.all(PARTS) {
        tree.remove(part);
    }
    for figure in tree.all("epipole-figure") {
        tree.set(figure, "compact", "");
    }
    rebase(&mut tree, page);
    let mut beginning = Stack::default();
    let mut stacks = Vec::new();
    for node in tree.children(tree.root()) {
        match tree.name(node) {
            "h1" => beginning.begin(&tree.inner(node)),
            "section" => stacks.extend(section(&mut tree, node)),
            _ => beginning.add(&tree, node),
        }
    }
    stacks.insert(0, beginning);
    stacks
}

fn section(tree: &mut Tree, section: NodeId) -> Option<Stack> {
    let heading = *tree.inside(section, "h2").first()?;
    if LEFT_OUT.contains(&tree.attr(heading, "id")?) {
        return None;
    }
    let title = tree.inner(heading).trim().to_owned();
    let mut stack = Stack::default();
    let questions = tree.inside(section, ".question");
    if !questions.is_empty() {
        let slides = questions.into_iter();
        stack.slides = slides
            .map(|question| questions::slide(tree, question, &title))
            .collect();
        return Some(stack);
    }
    stack.begin(&title);
    for node in tree.children(section) {
        match tree.name(node) {
            "h2" => {}
            "h3" => stack.begin(&tree.inner(node)),
            _ => stack.add(tree, node),
        }
    }
    Some(stack)
}

impl Stack {
    fn begin(&mut self, heading: &str) {
        self.push(Kind::Words, heading, String::new());
    }

    /// Adds a slide, replacing one that contains only its heading.
    fn push(&mut self, kind: Kind, heading: &str, body: String) {
        let is_empty = |last: &mut Slide| last.body.is_empty() && last.notes.is_empty();
        self.slides.pop_if(is_empty);
        self.slides.push(Slide {
            kind,
            heading: heading.trim().to_owned(),
            body,
            actions: String::new(),
            notes: String::new(),
        });
    }

    /// Adds a block to its own slide, to the current one, or to its notes.
    fn add(&mut self, tree: &Tree, node: NodeId) {
        let Some(last) = self.slides.last_mut() else {
            return;
        };
        let heading = last.heading.clone();
        match kind(tree, node) {
            None => {}
            Some(Kind::Words) => {
                let is_first = last.kind == Kind::Words && last.body.is_empty();
                if is_first && tree.name(node) == "p" {
                    let inner = tree.inner(node);
                    last.body = format!("<p class=\"lead\">{}</p>", sentence::first(&inner));
                }
                if last.kind == Kind::Figure {
                    last.actions.push_str(&actions(tree, node));
                }
                last.notes.push_str(&tree.outer(node));
            }
            Some(Kind::Formula) => {
                let has_room = last.body.matches("class=\"formula\"").count() < MAX_FORMULAS;
                if matches!(last.kind, Kind::Words | Kind::Formula) && has_room {
                    last.kind = Kind::Formula;
                    last.body.push_str(&tree.outer(node));
                } else {
                    self.push(Kind::Formula, &heading, tree.outer(node));
                }
            }
            Some(Kind::Figure) => {
                let element = tree.inside(node, "epipole-figure").first().copied();
                let id = tree.attr(node, "id").unwrap_or_default();
                let body = element.map_or_else(String::new, |figure| {
                    format!(
                        "<div class=\"shown\" id=\"{id}\">{}</div>",
                        tree.outer(figure)
                    )
                });
                let captions = tree.inside(node, "figcaption").into_iter();
                let caption: String = captions.map(|caption| tree.inner(caption)).collect();
                self.push(Kind::Figure, &heading, body);
                if let Some(last) = self.slides.last_mut() {
                    last.notes = format!("<p>{caption}</p>");
                }
            }
            Some(Kind::List) => self.push(Kind::List, &heading, list(tree, node)),
            Some(kind) => self.push(kind, &heading, tree.outer(node)),
        }
        if let (Some(last), "ul" | "ol") = (self.slides.last_mut(), tree.name(node)) {
            last.notes.push_str(&tree.outer(node));
        }
    }
}

/// Returns the main content of a block; `None` for white space between blocks.
fn kind(tree: &Tree, node: NodeId) -> Option<Kind> {
    let has = |selector| !tree.inside(node, selector).is_empty();
    Some(match tree.name(node) {
        "" => return None,
        "figure" if has("epipole-figure") => Kind::Figure,
        "ul" | "ol" if !has(".do") => Kind::List,
        "p" if has(":scope > .formula") => Kind::Formula,
        "div" if has("table") => Kind::Table,
        _ => Kind::Words,
    })
}

/// Returns a list of the first sentences of its items.
fn list(tree: &Tree, node: NodeId) -> String {
    let items = tree.inside(node, ":scope > li").into_iter();
    let items = items.map(|item| {
        let paragraph = tree.inside(item, ":scope > p").first().copied();
        let inner = tree.inner(paragraph.unwrap_or(item));
        format!("<li>{}</li>", sentence::first(inner.trim()))
    });
    let name = tree.name(node);
    format!("<{name}>{}</{name}>", items.collect::<String>())
}

/// Returns buttons for the phrases of a paragraph that operate a figure.
fn actions(tree: &Tree, node: NodeId) -> String {
    let words = tree.inside(node, ".do").into_iter();
    words.map(|words| tree.outer(words)).collect()
}

/// Makes links and pictures relative to the folder of the decks.
fn rebase(tree: &mut Tree, page: &str) {
    for name in ADDRESSES {
        for node in tree.all(&format!("[{name}]")) {
            let found = tree.attr(node, name).and_then(|href| place(page, href));
            if let Some((path, rest)) = found.map(|(path, rest)| (path, rest.to_owned())) {
                tree.set(node, name, &format!("../{path}{rest}"));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHAPTER: &str = "<h1>Rays</h1>\n<p>Why? <a href=\"#a\">A</a>.</p>\
        <section><h2 id=\"a\">One <a class=\"anchor\">#</a></h2><p>First. Second.</p>\
        <p><span class=\"formula\"><math><mi>x</mi></math></span></p><p>Third.</p>\
        <figure class=\"epipole\" id=\"fig-b\"><epipole-figure name=\"b\"><template>T</template><picture>\
        <img src=\"assets/b.webp\"></picture></epipole-figure><figcaption>Said.</figcaption></figure>\
        <p>Now <span class=\"do\" data-figure=\"fig-b\">turn it</span>.</p>\
        <ul><li>Red. More.</li><li>Blue.</li></ul></section>\
        <section><h2 id=\"exercises\">Exercises</h2><p>Work.</p></section>";

    #[test]
    fn sections_become_stacks() {
        let stacks = stacks(CHAPTER, "rays.html");
        let kinds = |stack: &Stack| stack.slides.iter().map(|s| s.kind).collect::<Vec<_>>();
        assert_eq!(stacks.len(), 2);
        assert_eq!(kinds(&stacks[0]), [Kind::Words]);
        assert_eq!(stacks[0].slides[0].body, "<p class=\"lead\">Why?</p>");
        assert_eq!(kinds(&stacks[1]), [Kind::Formula, Kind::Figure, Kind::List]);
        let [formula, figure, list] = &stacks[1].slides[..] else {
            panic!("three slides")
        };
        assert_eq!(formula.heading, "One");
        assert!(
            formula
                .body
                .starts_with("<p class=\"lead\">First.</p><p><span class=\"formula\"")
        );
        assert_eq!(formula.notes, "<p>First. Second.</p><p>Third.</p>");
        assert_eq!(
            figure.body,
            "<div class=\"shown\" id=\"fig-b\"><epipole-figure name=\"b\" compact=\"\"><picture>\
             <img src=\"../assets/b.webp\"></picture></epipole-figure></div>"
        );
        let action = "<span class=\"do\" data-figure=\"fig-b\">turn it</span>";
        assert_eq!(figure.actions, action);
        assert!(
            figure.notes.starts_with("<p>Said.</p><p>Now"),
            "{}",
            figure.notes
        );
        assert_eq!(list.body, "<ul><li>Red.</li><li>Blue.</li></ul>");
        assert_eq!(list.notes, "<ul><li>Red. More.</li><li>Blue.</li></ul>");
    }

    #[test]
    fn no_slide_has_only_a_heading() {
        let table = "<div class=\"table\"><table><tr><td>1</td></tr></table></div>";
        let html = format!("<section><h2 id=\"a\">One</h2>{table}</section>");
        let stacks = stacks(&html, "rays.html");
        let [slide] = &stacks[1].slides[..] else {
            panic!("one slide")
        };
        assert_eq!((slide.kind, &*slide.heading), (Kind::Table, "One"));
    }

    #[test]
    fn links_lead_back_to_the_book() {
        let stacks = stacks(CHAPTER, "rays.html");
        let notes = &stacks[0].slides[0].notes;
        assert!(notes.contains("href=\"../rays.html#a\""), "{notes}");
    }
}
