//! Serialization of HTML elements as XHTML.

use super::package::Property;
use crate::edition::tree::Tree;
use crate::html::escape;
use ego_tree::iter::Edge;
use html5ever::{Namespace, QualName, ns};
use scraper::Node;
use std::collections::BTreeSet;

/// HTML elements without an end tag.
const VOID: [&str; 7] = ["br", "col", "hr", "img", "source", "track", "wbr"];

/// Returns the content of a page in XHTML, and its properties for the manifest.
pub(super) fn xhtml(tree: &Tree) -> (String, BTreeSet<Property>) {
    let mut text = String::new();
    let mut properties = BTreeSet::new();
    // Namespaces of the open elements.
    let mut around: Vec<Namespace> = vec![ns!(html)];
    for edge in tree.edges(tree.root()) {
        match edge {
            Edge::Open(node) => match node.value() {
                Node::Text(words) => text.push_str(&escape(&allowed(words))),
                Node::Element(element) => {
                    let name = &element.name;
                    text.push_str(&format!("<{}", name.local));
                    if around.last() != Some(&name.ns) {
                        text.push_str(&format!(" xmlns=\"{}\"", name.ns));
                        properties.extend(property(&name.ns));
                    }
                    // The namespace is declared separately.
                    let attributes = element.attrs.iter();
                    for (key, value) in attributes.filter(|(key, _)| key.ns == ns!()) {
                        text.push_str(&format!(" {}=\"{}\"", key.local, escape(&allowed(value))));
                    }
                    text.push_str(if is_empty(name, node.has_children()) {
                        "/>"
                    } else {
                        ">"
                    });
                    around.push(name.ns.clone());
                }
                _ => {}
            },
            Edge::Close(node) => {
                if let Node::Element(element) = node.value() {
                    around.pop();
                    if !is_empty(&element.name, node.has_children()) {
                        text.push_str(&format!("</{}>", element.name.local));
                    }
                }
            }
        }
    }
    (text, properties)
}

fn property(namespace: &Namespace) -> Option<Property> {
    match *namespace {
        ns!(mathml) => Some(Property::Mathml),
        ns!(svg) => Some(Property::Svg),
        _ => None,
    }
}

fn is_empty(name: &QualName, has_children: bool) -> bool {
    match name.ns {
        ns!(html) => VOID.contains(&&*name.local),
        _ => !has_children,
    }
}

/// Removes control characters, which XML does not allow.
fn allowed(text: &str) -> String {
    let is_allowed = |letter: &char| !letter.is_control() || matches!(letter, '\n' | '\t');
    text.chars().filter(is_allowed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn converted(html: &str) -> (String, Vec<Property>) {
        let (text, properties) = xhtml(&Tree::parse(html));
        (text, properties.into_iter().collect())
    }

    #[test]
    fn every_element_ends() {
        let (text, properties) = converted(
            "<p>One<br>two &lt; three &amp; four<p>Five<img src=a.jpg alt='\"&lt;\"'><ul><li>x<li></ul>\u{1}",
        );
        assert_eq!(
            text,
            "<p>One<br/>two &lt; three &amp; four</p><p>Five<img src=\"a.jpg\" \
             alt=\"&quot;&lt;&quot;\"/></p><ul><li>x</li><li></li></ul>"
        );
        assert!(properties.is_empty());
    }

    #[test]
    fn formulas_and_drawings_have_their_namespaces() {
        let (text, properties) = converted(
            "<math display=inline><mi>x</mi><mspace></mspace></math> \
             <svg viewbox=\"0 0 16 16\"><path d=\"M0 0\"/></svg><b></b>",
        );
        assert_eq!(
            text,
            "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"inline\"><mi>x</mi>\
             <mspace/></math> <svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 16 16\">\
             <path d=\"M0 0\"/></svg><b></b>"
        );
        assert_eq!(properties, [Property::Mathml, Property::Svg]);
    }
}
