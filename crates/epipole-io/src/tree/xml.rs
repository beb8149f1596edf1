//! XML as a tree: attributes and child elements are keys. Source: W3C XML 1.0.

use super::node::{MAX_DEPTH, Node, Value};
use crate::{Error, Result};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// An element that is not closed.
struct Open {
    name: String,
    line: usize,
    entries: Vec<(String, Node)>,
    text: String,
}

/// Reads an XML text; the tree has one key, the root element.
///
/// An element with neither attributes nor children is a scalar. Text beside children is left out.
pub(super) fn parse(text: &str) -> Result<Node> {
    let mut reader = Reader::from_str(text);
    let mut open: Vec<Open> = Vec::new();
    let (mut line, mut counted) = (1, 0);
    loop {
        let event = reader.read_event();
        let end = usize::try_from(reader.buffer_position()).unwrap_or(text.len());
        let event =
            event.map_err(|error| Error::at(line, format!("not well-formed XML: {error}")))?;
        let done = match event {
            Event::Start(start) => {
                open.push(element(&start, line)?);
                None
            }
            Event::Empty(start) => Some(close(element(&start, line)?)),
            Event::End(_) => open.pop().map(close),
            Event::Text(more) => {
                if let (Some(parent), Ok(more)) = (open.last_mut(), more.decode()) {
                    parent.text.push_str(&more);
                }
                None
            }
            Event::CData(more) => {
                if let (Some(parent), Ok(more)) = (open.last_mut(), more.decode()) {
                    parent.text.push_str(&more);
                }
                None
            }
            Event::GeneralRef(reference) => {
                let name = reference.decode().unwrap_or_default();
                let resolved = match reference.resolve_char_ref() {
                    Ok(Some(character)) => character.to_string(),
                    _ => quick_xml::escape::resolve_predefined_entity(&name)
                        .ok_or_else(|| Error::at(line, format!("unknown entity &{name};")))?
                        .to_owned(),
                };
                if let Some(parent) = open.last_mut() {
                    parent.text.push_str(&resolved);
                }
                None
            }
            Event::Eof => return Err(Error::at(line, "the XML ends before its root is closed")),
            _ => None,
        };
        if open.len() > MAX_DEPTH {
            let message = format!("elements are nested deeper than {MAX_DEPTH}");
            return Err(Error::at(line, message));
        }
        if let Some(entry) = done {
            let Some(parent) = open.last_mut() else {
                let root = vec![entry];
                return Ok(Node {
                    line: Some(1),
                    value: Value::Map(root),
                });
            };
            parent.entries.push(entry);
        }
        line += newlines(&text[counted.min(end)..end.max(counted).min(text.len())]);
        counted = end.max(counted).min(text.len());
    }
}

fn newlines(text: &str) -> usize {
    text.bytes().filter(|&byte| byte == b'\n').count()
}

fn element(start: &BytesStart, line: usize) -> Result<Open> {
    let name = String::from_utf8_lossy(start.local_name().as_ref()).into_owned();
    let mut entries = Vec::new();
    let mut attributes = start.attributes();
    // Duplicate attributes are harmless; the first is used.
    for attribute in attributes.with_checks(false) {
        let attribute = attribute
            .map_err(|error| Error::at(line, format!("attribute of <{name}>: {error}")))?;
        let key = String::from_utf8_lossy(attribute.key.local_name().as_ref()).into_owned();
        let value = String::from_utf8_lossy(&attribute.value);
        let value = quick_xml::escape::unescape(&value)
            .map_err(|error| Error::at(line, format!("attribute {key} of <{name}>: {error}")))?;
        entries.push((
            key,
            Node {
                line: Some(line),
                value: Value::Scalar(value.into_owned()),
            },
        ));
    }
    Ok(Open {
        name,
        line,
        entries,
        text: String::new(),
    })
}

fn close(open: Open) -> (String, Node) {
    let text = open.text.trim();
    let value = match (open.entries.is_empty(), text.is_empty()) {
        (true, true) => Value::Null,
        (true, false) => Value::Scalar(text.to_owned()),
        (false, _) => Value::Map(open.entries),
    };
    let node = Node {
        line: Some(open.line),
        value,
    };
    (open.name, node)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_and_elements_are_keys() {
        let text =
            "<?xml version=\"1.0\"?>\n<a>\n <b w=\"5\" h=\"4&#49;\"/>\n <c>\n  1 &lt; 2</c></a>";
        let Value::Map(root) = parse(text).unwrap().value else {
            panic!("no root")
        };
        let Value::Map(a) = &root[0].1.value else {
            panic!("no a")
        };
        assert_eq!((&*a[0].0, a[0].1.line), ("b", Some(3)));
        let Value::Map(b) = &a[0].1.value else {
            panic!("no b")
        };
        assert_eq!(b[1].1.value, Value::Scalar("41".to_owned()));
        assert_eq!(a[1].1.line, Some(4));
        assert_eq!(a[1].1.value, Value::Scalar("1 < 2".to_owned()));
    }

    #[test]
    fn broken_and_deep_files_are_refused() {
        for text in [
            "",
            "<a>",
            "<a></b>",
            "<a>&x;</a>",
            "<a b></a>",
            &"<a>".repeat(1 << 16),
        ] {
            assert!(parse(text).is_err(), "{text:.20}");
        }
    }
}
