//! A tree of keys and values.

/// Maximum nesting of lists and maps.
pub(super) const MAX_DEPTH: usize = 64;

/// A value and its place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    /// Line of the file, counted from 1. JSON has none.
    pub(crate) line: Option<usize>,
    pub(crate) value: Value,
}

/// Content of a node.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    /// `null`, an empty element.
    Null,
    /// A number, word or string, as text.
    Scalar(String),
    List(Vec<Node>),
    /// Keys in the order of the file. XML repeats them; attributes come before elements.
    Map(Vec<(String, Node)>),
}
