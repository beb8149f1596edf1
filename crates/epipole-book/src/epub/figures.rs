//! Conversion of figures to pictures, and of formulas to the MathML of EPUB.

use crate::edition::tree::{Tree, place};
use crate::html::escape;
use crate::write::address::of_page;
use std::collections::BTreeSet;

/// Attributes that only browsers need.
const OF_BROWSERS: [&str; 7] = [
    "autocomplete",
    "decoding",
    "download",
    "fetchpriority",
    "loading",
    "tabindex",
    "xmlns",
];

/// Replaces figures by their pictures, with a link to the live figure if the address of the book is
/// known.
pub(super) fn flatten(tree: &mut Tree, page: &str, address: Option<&str>) {
    for picture in tree.all("picture") {
        let size = tree.inside(picture, "source").last().map(|&source| {
            ["width", "height"].map(|name| tree.attr(source, name).map(str::to_owned))
        });
        for image in tree.inside(picture, "img") {
            for (name, value) in ["width", "height"]
                .into_iter()
                .zip(size.clone().into_iter().flatten())
            {
                if let Some(value) = value {
                    tree.set(image, name, &value);
                }
            }
        }
        for source in tree.inside(picture, "source") {
            tree.remove(source);
        }
        tree.unwrap(picture);
    }
    for figure in tree.all("figure.epipole") {
        let id = tree.attr(figure, "id").map(escape);
        let caption = tree.inside(figure, "figcaption");
        if let (Some(root), Some(id), Some(&caption)) = (address, id, caption.first()) {
            let href = escape(&of_page(root, page));
            let link = format!(" <a class=\"permalink\" href=\"{href}#{id}\">Live on the web</a>");
            tree.append(caption, &link);
        }
    }
    for figure in tree.all("epipole-figure") {
        tree.unwrap(figure);
    }
    formulas(tree);
    for node in tree.all("*") {
        tree.keep_attributes(node, |name| {
            !name.starts_with("data-") && !OF_BROWSERS.contains(&name)
        });
    }
}

/// Makes LaTeX the alternative text of a formula. Annotations would be displayed by readers without
/// MathML.
fn formulas(tree: &mut Tree) {
    for math in tree.all("math") {
        if let Some(&annotation) = tree.inside(math, "annotation").first() {
            let latex = tree.text(annotation);
            tree.set(math, "alttext", &latex);
            tree.remove(annotation);
        }
        for semantics in tree.inside(math, "semantics") {
            tree.unwrap(semantics);
        }
    }
    // EPUB uses MathML 3, in which other elements have these attributes.
    for row in tree.all("mrow[displaystyle]") {
        tree.rename(row, "mstyle");
    }
    for head in tree.all("th") {
        for words in tree.inside(head, ".visually-hidden") {
            tree.remove(words);
        }
        for formula in tree.inside(head, "[aria-hidden]") {
            tree.unwrap(formula);
        }
    }
}

/// Returns the paths of a page's pictures, from the root of the book.
pub(super) fn paths(tree: &Tree, page: &str) -> BTreeSet<String> {
    let images = tree.all("img").into_iter();
    let paths = images.filter_map(|image| Some(place(page, tree.attr(image, "src")?)?.0));
    paths.collect()
}

/// Returns the path of the first figure's picture.
pub(super) fn first(tree: &Tree, page: &str) -> Option<String> {
    let image = *tree.all("figure.epipole > img").first()?;
    Some(place(page, tree.attr(image, "src")?)?.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_is_a_picture_with_its_caption() {
        let mut tree = Tree::parse(
            "<figure class=\"epipole\" id=\"fig-dot\"><epipole-figure name=\"dot\"><picture><source \
             srcset=\"../a.jpg\" width=\"8\" height=\"4\"><img src=\"../a.jpg\" alt=\"A dot.\" \
             loading=\"lazy\"></picture></epipole-figure><figcaption>Dot</figcaption></figure>",
        );
        flatten(&mut tree, "part/one.html", Some("https://a.example/"));
        assert_eq!(
            tree.html(),
            "<figure class=\"epipole\" id=\"fig-dot\"><img src=\"../a.jpg\" alt=\"A dot.\" width=\"8\" \
             height=\"4\"><figcaption>Dot <a class=\"permalink\" \
             href=\"https://a.example/part/one.html#fig-dot\">Live on the web</a></figcaption></figure>"
        );
        assert_eq!(
            paths(&tree, "part/one.html"),
            BTreeSet::from(["a.jpg".to_owned()])
        );
    }

    #[test]
    fn formulas_are_mathml_3_and_contain_their_latex_once() {
        let math = "<math><semantics><mrow displaystyle=\"false\"><mi>x</mi></mrow><annotation encoding=\"application/x-tex\">\\x</annotation></semantics></math>";
        let mut tree = Tree::parse(&format!(
            "<table><tr><th><span class=\"visually-hidden\">x</span><span aria-hidden=\"true\">{math}</span></th></tr></table>"
        ));
        flatten(&mut tree, "one.html", None);
        let head = "<th><math alttext=\"\\x\"><mstyle displaystyle=\"false\"><mi>x</mi></mstyle></math></th>";
        assert!(tree.html().contains(head), "{}", tree.html());
    }
}
