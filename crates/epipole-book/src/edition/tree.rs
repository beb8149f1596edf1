//! Editing of a page's elements.

use crate::render::links::{is_external, resolve_path};
use ego_tree::NodeId;
use ego_tree::iter::Edge;
use html5ever::{LocalName, QualName, ns};
use scraper::node::Element;
use scraper::{ElementRef, Html, Node, Selector};

/// Elements of a page or of a part of one.
pub(crate) struct Tree(Html);

impl Tree {
    pub(crate) fn parse(html: &str) -> Tree {
        Tree(Html::parse_fragment(html))
    }

    /// Returns the root element.
    pub(crate) fn root(&self) -> NodeId {
        self.0.root_element().id()
    }

    pub(crate) fn html(&self) -> String {
        self.0.root_element().inner_html()
    }

    /// Returns the HTML of an element's children.
    pub(crate) fn inner(&self, node: NodeId) -> String {
        let element = self.element(node);
        element.map_or_else(String::new, |element| element.inner_html())
    }

    /// Returns the HTML of an element; empty for text.
    pub(crate) fn outer(&self, node: NodeId) -> String {
        let element = self.element(node);
        element.map_or_else(String::new, |element| element.html())
    }

    /// Returns the name of an element; empty for text.
    pub(crate) fn name(&self, node: NodeId) -> &str {
        self.element(node)
            .map_or("", |element| element.value().name())
    }

    /// Iterates over starts and ends of all nodes inside an element, in document order.
    pub(crate) fn edges(&self, node: NodeId) -> impl Iterator<Item = Edge<'_, Node>> {
        let node = self.0.tree.get(node);
        let children = node.into_iter().flat_map(|node| node.children());
        children.flat_map(|child| child.traverse())
    }

    /// Returns the elements that match a CSS selector, in document order; none if the selector is
    /// invalid.
    pub(crate) fn all(&self, selector: &str) -> Vec<NodeId> {
        self.inside(self.root(), selector)
    }

    /// Returns the matching elements below an element.
    pub(crate) fn inside(&self, node: NodeId, selector: &str) -> Vec<NodeId> {
        let (Some(element), Ok(selector)) = (self.element(node), Selector::parse(selector)) else {
            return Vec::new();
        };
        let found = element.select(&selector);
        found.map(|element| element.id()).collect()
    }

    /// Returns the nearest ancestor of a node that passes a test.
    pub(crate) fn around(&self, node: NodeId, test: impl Fn(ElementRef) -> bool) -> Option<NodeId> {
        let ancestors = self.0.tree.get(node)?.ancestors();
        let mut elements = ancestors.filter_map(ElementRef::wrap);
        let found = elements.find(|element| test(*element));
        found.map(|element| element.id())
    }

    pub(crate) fn attr(&self, node: NodeId, name: &str) -> Option<&str> {
        self.element(node)?.attr(name)
    }

    /// Returns the text inside an element, trimmed.
    pub(crate) fn text(&self, node: NodeId) -> String {
        let element = self.element(node);
        let text: String = element.into_iter().flat_map(|e| e.text()).collect();
        text.trim().to_owned()
    }

    fn element(&self, node: NodeId) -> Option<ElementRef<'_>> {
        ElementRef::wrap(self.0.tree.get(node)?)
    }

    fn with_element(&mut self, node: NodeId, change: impl FnOnce(&mut Element)) {
        if let Some(mut node) = self.0.tree.get_mut(node)
            && let Node::Element(element) = node.value()
        {
            change(element);
        }
    }

    /// Sets an attribute. Selectors may still match a former class or id.
    pub(crate) fn set(&mut self, node: NodeId, name: &str, value: &str) {
        let name = QualName::new(None, ns!(), LocalName::from(name));
        self.with_element(node, |element| {
            element.attrs.insert(name, value.into());
        });
    }

    /// Keeps only the attributes that pass a test.
    pub(crate) fn keep_attributes(&mut self, node: NodeId, test: impl Fn(&str) -> bool) {
        self.with_element(node, |element| {
            element.attrs.retain(|name, _| test(&name.local));
        });
    }

    pub(crate) fn rename(&mut self, node: NodeId, name: &str) {
        self.with_element(node, |element| element.name.local = LocalName::from(name));
    }

    pub(crate) fn remove(&mut self, node: NodeId) {
        if let Some(mut node) = self.0.tree.get_mut(node) {
            node.detach();
        }
    }

    /// Replaces an element by its children.
    pub(crate) fn unwrap(&mut self, node: NodeId) {
        for child in self.children(node) {
            self.move_before(node, child);
        }
        self.remove(node);
    }

    /// Moves a node before an element.
    pub(crate) fn move_before(&mut self, node: NodeId, moved: NodeId) {
        if let Some(mut node) = self.0.tree.get_mut(node) {
            node.insert_id_before(moved);
        }
    }

    /// Inserts HTML before an element.
    pub(crate) fn insert_before(&mut self, node: NodeId, html: &str) {
        for child in self.adopt(html) {
            self.move_before(node, child);
        }
    }

    /// Inserts HTML at the end of an element.
    pub(crate) fn append(&mut self, node: NodeId, html: &str) {
        for child in self.adopt(html) {
            self.append_node(node, child);
        }
    }

    /// Moves a node to the end of an element.
    pub(crate) fn append_node(&mut self, node: NodeId, child: NodeId) {
        if let Some(mut node) = self.0.tree.get_mut(node) {
            node.append_id(child);
        }
    }

    /// Inserts HTML at the beginning of an element.
    pub(crate) fn prepend(&mut self, node: NodeId, html: &str) {
        match self.children(node).first() {
            Some(first) => self.insert_before(*first, html),
            None => self.append(node, html),
        }
    }

    pub(crate) fn children(&self, node: NodeId) -> Vec<NodeId> {
        let node = self.0.tree.get(node);
        let children = node.into_iter().flat_map(|node| node.children());
        children.map(|child| child.id()).collect()
    }

    /// Adds the nodes of an HTML fragment to the tree, without a parent.
    fn adopt(&mut self, html: &str) -> Vec<NodeId> {
        let piece = Html::parse_fragment(html).tree;
        let document = self.0.tree.extend_tree(piece).id();
        let around = self.children(document);
        around
            .into_iter()
            .flat_map(|node| self.children(node))
            .collect()
    }
}

/// Resolves a link to the path from the root of the book and the rest of the link. `None` for links
/// to other servers.
///
/// * `page`: path of the page with the link
pub(crate) fn place<'a>(page: &str, href: &'a str) -> Option<(String, &'a str)> {
    if is_external(href) {
        return None;
    }
    let end = href.find(['#', '?']).unwrap_or(href.len());
    let (path, rest) = href.split_at(end);
    let path = match path {
        "" => page.to_owned(),
        path => resolve_path(page, path),
    };
    Some((path, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_move() {
        let mut tree = Tree::parse("<p>a <b>c <i>d</i></b> e</p><pre>x\n</pre>");
        let bold = tree.all("p > b")[0];
        tree.append(bold, "f<br>");
        tree.prepend(bold, "<q>");
        tree.insert_before(bold, "<s>g</s> ");
        tree.unwrap(bold);
        assert_eq!(
            tree.html(),
            "<p>a <s>g</s> <q></q>c <i>d</i>f<br> e</p><pre>x\n</pre>"
        );
        let italic = tree.all("i")[0];
        tree.rename(italic, "em");
        tree.set(italic, "id", "x");
        assert_eq!(tree.attr(italic, "id"), Some("x"));
        tree.remove(tree.all("pre")[0]);
        assert_eq!(
            tree.html(),
            "<p>a <s>g</s> <q></q>c <em id=\"x\">d</em>f<br> e</p>"
        );
    }

    #[test]
    fn links_name_places() {
        let named = |href| place("a/b.html", href);
        assert_eq!(named("#x"), Some(("a/b.html".to_owned(), "#x")));
        assert_eq!(named("../c.html#y"), Some(("c.html".to_owned(), "#y")));
        assert_eq!(
            named("lab/index.html?z=1"),
            Some(("a/lab/index.html".to_owned(), "?z=1"))
        );
        assert_eq!(named("https://a.example"), None);
    }
}
