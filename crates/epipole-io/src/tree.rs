//! Files of keys and values: JSON, YAML and XML as one tree.
//!
//! Depth is limited, and aliases of YAML and entities of XML are refused, so a tree is not larger
//! than a multiple of its file.

mod field;
mod json;
mod xml;
mod yaml;

pub(crate) use field::Field;

use crate::Result;

/// Maximum nesting of lists and maps.
const MAX_DEPTH: usize = 64;

/// Syntax of a file of keys and values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Syntax {
    /// Begins with a brace or bracket.
    Json,
    /// Begins with `<`.
    Xml,
    /// Every other text.
    Yaml,
}

impl Syntax {
    /// Syntax by the first character.
    pub(crate) fn of(text: &str) -> Self {
        match text.trim_start().as_bytes().first() {
            Some(b'{' | b'[') => Self::Json,
            Some(b'<') => Self::Xml,
            _ => Self::Yaml,
        }
    }

    /// Reads a text.
    ///
    /// # Errors
    /// [`Error::Malformed`](crate::Error::Malformed) with the line, for broken syntax and for
    /// nesting beyond [`MAX_DEPTH`].
    pub(crate) fn parse(self, text: &str) -> Result<Node> {
        match self {
            Self::Json => json::parse(text),
            Self::Xml => xml::parse(text),
            Self::Yaml => yaml::parse(text),
        }
    }
}

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
