//! Quiz questions as slides: choices are a list, answers are notes.

use super::slide::{Kind, Slide};
use crate::edition::tree::Tree;
use ego_tree::NodeId;

/// Returns the slide of a question.
pub(super) fn slide(tree: &mut Tree, question: NodeId, heading: &str) -> Slide {
    let html = |tree: &Tree, selector: &str| -> Vec<String> {
        let found = tree.inside(question, selector).into_iter();
        found.map(|node| tree.inner(node)).collect()
    };
    for number in tree.inside(question, ".question-number") {
        tree.remove(number);
    }
    for summary in tree.inside(question, "summary") {
        tree.remove(summary);
    }
    let prompt = html(tree, "legend").concat();
    let choices = html(tree, ".choice > span, .step > span");
    let list = match choices.is_empty() {
        true => String::new(),
        false => format!(
            "<ol class=\"possible\"><li>{}</li></ol>",
            choices.join("</li><li>")
        ),
    };
    Slide {
        kind: Kind::Question,
        heading: heading.to_owned(),
        body: format!("<p class=\"lead\">{}</p>{list}", prompt.trim()),
        actions: String::new(),
        notes: html(tree, "details").concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_notes() {
        let mut tree = Tree::parse(
            "<form class=\"question\"><legend><span class=\"question-number\">Question 1</span> Why?\
             </legend><label class=\"choice\"><input type=\"radio\"> <span>So</span></label>\
             <label class=\"choice\"><input type=\"radio\"> <span>No</span></label>\
             <details><summary>Answer</summary><p>So.</p></details></form>",
        );
        let question = tree.all("form")[0];
        let slide = slide(&mut tree, question, "Quiz");
        assert_eq!(
            slide.body,
            "<p class=\"lead\">Why?</p><ol class=\"possible\"><li>So</li><li>No</li></ol>"
        );
        assert_eq!(slide.notes, "<p>So.</p>");
    }
}
