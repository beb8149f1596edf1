//! Conversion of forms: EPUB regards a page with a form as scripted.

use crate::edition::tree::Tree;
use ego_tree::NodeId;

/// Converts choices and steps to lists, and number fields to blanks.
pub(super) fn flatten(tree: &mut Tree) {
    for label in tree.all(".note-mark label") {
        for field in tree.inside(label, "input") {
            tree.remove(field);
        }
        tree.unwrap(label);
    }
    for question in tree.all("form.question") {
        // Text below the pictures would give away the answer.
        for choice in tree.inside(question, ".choice .small") {
            describe(tree, choice);
        }
        for class in ["choice", "step"] {
            list(tree, question, class);
        }
        for label in tree.inside(question, ".numeric label") {
            tree.unwrap(label);
        }
        for field in tree.inside(question, ".numeric input") {
            tree.insert_before(field, "______");
            tree.remove(field);
        }
        for legend in tree.inside(question, "legend") {
            tree.rename(legend, "p");
        }
        for fields in tree.inside(question, "fieldset") {
            tree.unwrap(fields);
        }
        tree.rename(question, "div");
    }
}

/// Moves the text of a small picture to its alternative text.
fn describe(tree: &mut Tree, small: NodeId) {
    for words in tree.inside(small, ":scope > span") {
        let text = tree.text(words);
        for image in tree.inside(small, "img") {
            tree.set(image, "alt", &text);
        }
        tree.remove(words);
    }
}

/// Converts the labels of a class to list items.
fn list(tree: &mut Tree, question: NodeId, class: &str) {
    let labels = tree.inside(question, &format!("label.{class}"));
    let Some(&first) = labels.first() else {
        return;
    };
    tree.insert_before(first, "<ul class=\"choices\"></ul>");
    let Some(&list) = tree.inside(question, "ul.choices").first() else {
        return;
    };
    for label in labels {
        for field in tree.inside(label, "input, select") {
            tree.remove(field);
        }
        tree.rename(label, "li");
        tree.append_node(list, label);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_question_has_no_form() {
        let mut tree = Tree::parse(
            "<form class=\"question\" id=\"q\"><fieldset><legend>Which?</legend>\
             <label class=\"choice\"><input type=\"radio\"> <span>A</span></label>\n\
             <label class=\"choice\"><input type=\"radio\"> <span><span class=\"small\"><img \
             src=\"b.jpg\" alt=\"\"><span>B</span></span></span></label>\
             <p class=\"numeric\"><label for=\"f\">Your answer</label> <input id=\"f\"> m</p>\
             </fieldset></form>",
        );
        flatten(&mut tree);
        assert_eq!(
            tree.html(),
            "<div class=\"question\" id=\"q\"><p>Which?</p><ul class=\"choices\"><li class=\"choice\"> \
             <span>A</span></li><li class=\"choice\"> <span><span class=\"small\"><img src=\"b.jpg\" \
             alt=\"B\"></span></span></li></ul>\n\
             <p class=\"numeric\">Your answer ______ m</p></div>"
        );
    }
}
