//! Files of keys and values: JSON, YAML and XML as one kind of tree.
//!
//! Depth is limited, and aliases of YAML and entities of XML are refused, so the size of a tree is
//! linear in that of its file.

mod field;
mod json;
mod node;
mod xml;
mod yaml;

pub(crate) use field::Field;
pub(crate) use node::Node;

use crate::Result;

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
    /// Returns the syntax by the first character.
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
    /// deep nesting.
    pub(crate) fn parse(self, text: &str) -> Result<Node> {
        match self {
            Self::Json => json::parse(text),
            Self::Xml => xml::parse(text),
            Self::Yaml => yaml::parse(text),
        }
    }
}
