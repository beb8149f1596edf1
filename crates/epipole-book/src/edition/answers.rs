//! Hints, solutions and answers, moved to a page at the end of the book.

use super::tree::{Tree, place};
use crate::html::{escape, path_to_root};
use crate::render::page::Page;
use ego_tree::NodeId;

/// Path of the page.
const PATH: &str = "answers.html";
const TITLE: &str = "Hints and answers";

/// Links between questions and answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AnswerLinks {
    /// No links, on paper: the table of contents leads to the answers.
    None,
    /// From a question to its answer and back.
    Both,
}

/// The page so far.
pub(super) struct Answers {
    links: AnswerLinks,
    html: String,
    count: usize,
}

impl Answers {
    pub(super) fn new(links: AnswerLinks) -> Self {
        Answers {
            links,
            html: String::new(),
            count: 0,
        }
    }

    /// Moves the answers of a page to this one.
    pub(super) fn take(&mut self, tree: &mut Tree, page: &Page) {
        let all = tree.all("details");
        if all.is_empty() {
            return;
        }
        let numbered = [page.number.as_deref().unwrap_or_default(), &page.title];
        let heading = numbered.join(" ");
        let list = escape(&page.path.replace(".html", "").replace('/', "-"));
        self.html.push_str(&format!(
            "<h2 id=\"of-{list}\">{}</h2>\n<dl>\n",
            escape(heading.trim())
        ));
        let mut last = String::new();
        for details in all {
            self.count += 1;
            let id = format!("answer-{}", self.count);
            let kind = take_kind(tree, details);
            let subject = subject(tree, details);
            if self.links == AnswerLinks::Both {
                let root = path_to_root(&page.path);
                tree.insert_before(
                    details,
                    &format!("<p class=\"to-answer\" id=\"to-{id}\"><a href=\"{root}{PATH}#{id}\">{kind}</a></p>"),
                );
            }
            if subject != last {
                let name = escape(&subject);
                let name = match self.links {
                    AnswerLinks::Both => {
                        format!("<a href=\"{}#to-{id}\">{name}</a>", escape(&page.path))
                    }
                    AnswerLinks::None => name,
                };
                self.html
                    .push_str(&format!("<dt class=\"answer-name\">{name}</dt>\n"));
                last = subject;
            }
            if kind != "Answer" {
                let first = tree.inside(details, "p").first().copied();
                tree.prepend(first.unwrap_or(details), &format!("<em>{kind}. </em>"));
            }
            move_links(tree, details, &page.path);
            self.html
                .push_str(&format!("<dd id=\"{id}\">{}</dd>\n", tree.inner(details)));
            tree.remove(details);
        }
        self.html.push_str("</dl>\n");
    }

    /// Returns the page, if there are answers.
    pub(super) fn page(self) -> Option<Page> {
        (!self.html.is_empty()).then(|| Page {
            path: PATH.to_owned(),
            title: TITLE.to_owned(),
            html: format!("<h1 id=\"answers\">{TITLE}</h1>\n{}", self.html),
            ..Page::default()
        })
    }
}

/// Removes the summary of an answer. Returns its first words, the kind of answer.
fn take_kind(tree: &mut Tree, details: NodeId) -> String {
    let Some(&summary) = tree.inside(details, "summary").first() else {
        return String::new();
    };
    for more in tree.inside(summary, ".visually-hidden") {
        tree.remove(more);
    }
    let kind = escape(&tree.text(summary));
    tree.remove(summary);
    kind
}

/// Returns the name of the question, exercise or section that an answer belongs to.
fn subject(tree: &Tree, details: NodeId) -> String {
    let is_question = |element: scraper::ElementRef| {
        let mut classes = element.value().classes();
        classes.any(|class| class == "question")
    };
    if let Some(question) = tree.around(details, is_question) {
        let number = tree.inside(question, ".question-number");
        return number.first().map_or_else(String::new, |&n| tree.text(n));
    }
    for (index, item) in exercises(tree) {
        if tree.inside(item, "details").contains(&details) {
            return format!("Exercise {}", index + 1);
        }
    }
    let mut before = String::new();
    for node in tree.all("h2, h3, h4, .listing-title, details") {
        if node == details {
            break;
        }
        if tree.inside(node, "summary").is_empty() {
            before = tree.text(node);
        }
    }
    before
}

/// Returns items of numbered lists, with their index in the list.
fn exercises(tree: &Tree) -> Vec<(usize, NodeId)> {
    let lists = tree.all("ol").into_iter();
    let items = lists.flat_map(|list| {
        let items = tree.inside(list, ":scope > li").into_iter();
        items.enumerate().collect::<Vec<_>>()
    });
    items.collect()
}

/// Makes links and pictures of an answer relative to the page of the answers.
fn move_links(tree: &mut Tree, details: NodeId, page: &str) {
    for (selector, name) in [("[href]", "href"), ("[src]", "src")] {
        for node in tree.inside(details, selector) {
            let found = tree.attr(node, name).and_then(|href| place(page, href));
            if let Some((path, rest)) = found.map(|(path, rest)| (path, rest.to_owned())) {
                tree.set(node, name, &format!("{path}{rest}"));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arranged(html: &str, links: AnswerLinks) -> (String, String) {
        let page = Page {
            path: "part/rays.html".to_owned(),
            title: "Rays".to_owned(),
            number: Some("2".to_owned()),
            ..Page::default()
        };
        let mut tree = Tree::parse(html);
        let mut answers = Answers::new(links);
        answers.take(&mut tree, &page);
        let answers = answers.page().map(|page| page.html);
        (tree.html(), answers.unwrap_or_default())
    }

    const EXERCISES: &str = "<ol><li>One</li><li>Two<details><summary>Hint</summary><p>Look at <a \
                             href=\"#x\">x</a>.</p></details><details><summary>Solution</summary>\
                             <pre>3</pre></details></li></ol>";

    #[test]
    fn answers_move_to_the_end() {
        let (left, answers) = arranged(EXERCISES, AnswerLinks::None);
        assert_eq!(left, "<ol><li>One</li><li>Two</li></ol>");
        for part in [
            "<h2 id=\"of-part-rays\">2 Rays</h2>",
            "<dt class=\"answer-name\">Exercise 2</dt>",
            "<p><em>Hint. </em>Look at <a href=\"part/rays.html#x\">x</a>.</p>",
            "<dd id=\"answer-2\"><em>Solution. </em><pre>3</pre></dd>",
        ] {
            assert!(answers.contains(part), "{part}: {answers}");
        }
        assert_eq!(answers.matches("<dt").count(), 1);
    }

    #[test]
    fn questions_lead_to_their_answers_and_back() {
        let (left, answers) = arranged(EXERCISES, AnswerLinks::Both);
        let way = "<p class=\"to-answer\" id=\"to-answer-1\"><a href=\"../answers.html#answer-1\">Hint</a></p>";
        assert!(left.contains(way), "{left}");
        let back = "<a href=\"part/rays.html#to-answer-1\">Exercise 2</a>";
        assert!(answers.contains(back), "{answers}");
    }

    #[test]
    fn an_answer_is_named_after_what_it_answers() {
        let question = "<div class=\"question\"><span class=\"question-number\">Question 7</span>\
                        <details><summary>Answer<span class=\"visually-hidden\"> to question 7</span>\
                        </summary><p>F.</p></details></div>";
        let (_, answers) = arranged(question, AnswerLinks::None);
        assert!(
            answers.contains(">Question 7</dt>\n<dd id=\"answer-1\"><p>F.</p></dd>"),
            "{answers}"
        );
        let task = "<h2>A</h2><p class=\"listing-title\">Your turn</p><details><summary>Solution</summary>\
                    <p>1</p></details><h2>B</h2>";
        let (_, answers) = arranged(task, AnswerLinks::None);
        assert!(answers.contains(">Your turn</dt>"), "{answers}");
    }
}
