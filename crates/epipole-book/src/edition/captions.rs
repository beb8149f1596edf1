//! Captions on paper, without instructions.

use super::sentence;
use super::tree::Tree;

/// First words of instructions for operating a figure.
const IMPERATIVES: [&str; 21] = [
    "Change", "Choose", "Click", "Drag", "Flatten", "Lengthen", "Light", "Lower", "Move", "Or",
    "Press", "Raise", "Set", "Slide", "Step", "Switch", "Take", "Tap", "Try", "Turn", "Walk",
];

/// Removes instructions for operating a figure from its caption.
pub(super) fn remove_instructions(tree: &mut Tree) {
    for caption in tree.all("figcaption") {
        let html = tree.inner(caption);
        for child in tree.children(caption) {
            tree.remove(child);
        }
        tree.append(caption, &without_instructions(&html));
    }
}

fn without_instructions(html: &str) -> String {
    let mut remaining = String::new();
    // The number of the figure does not end like a sentence.
    let start = html.find("</a> ").map_or(0, |end| end + "</a> ".len());
    let (number, mut rest) = html.split_at(start);
    while !rest.is_empty() {
        let sentence = sentence::first(rest);
        rest = &rest[sentence.len()..];
        let word = sentence.trim_start().split([' ', '<']).next();
        if !word.is_some_and(|word| IMPERATIVES.contains(&word)) {
            remaining.push_str(sentence);
        }
    }
    format!("{number}{}", remaining.trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_are_left_out() {
        for (caption, remaining) in [
            (
                "<a class=\"figure-number\">Figure 1</a> Drag it. A point, at 3.5 m. Press <em>Go</em>. Line 2. Click it.",
                "<a class=\"figure-number\">Figure 1</a> A point, at 3.5 m. Line 2.",
            ),
            (
                "A drag is not an order. Or choose it.",
                "A drag is not an order.",
            ),
            ("Turn it.", ""),
        ] {
            assert_eq!(without_instructions(caption), remaining);
        }
    }
}
