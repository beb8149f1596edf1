//! YAML as a tree, OpenCV's dialect included. Source: YAML 1.2.2, and OpenCV's
//! `modules/core/src/persistence_yml.cpp`.

use super::node::{MAX_DEPTH, Node, Value};
use crate::{Error, Result};
use saphyr_parser::{Event, Parser, ScalarStyle};

/// An incomplete list or map.
struct Open {
    line: usize,
    content: Content,
}

enum Content {
    List(Vec<Node>),
    /// Entries, and the key whose value comes next.
    Map(Vec<(String, Node)>, Option<String>),
}

/// Reads the first document of a YAML text.
pub(super) fn parse(text: &str) -> Result<Node> {
    // OpenCV's `%YAML:1.0` is not a valid directive, so directives become comments.
    let commented = text.strip_prefix('%').map(|rest| format!("#{rest}"));
    let text = commented.as_deref().unwrap_or(text);
    let mut open: Vec<Open> = Vec::new();
    for event in Parser::new_from_str(text) {
        let (event, span) =
            event.map_err(|error| Error::at(error.marker().line(), error.info().to_owned()))?;
        let line = span.start.line();
        let done = match event {
            Event::Alias(_) => return Err(Error::at(line, "aliases (*name) are not supported")),
            Event::SequenceStart(..) => {
                let content = Content::List(Vec::new());
                open.push(Open { line, content });
                None
            }
            Event::MappingStart(..) => {
                let content = Content::Map(Vec::new(), None);
                open.push(Open { line, content });
                None
            }
            Event::Scalar(text, style, ..) => {
                let is_null = style == ScalarStyle::Plain && matches!(&*text, "" | "~" | "null");
                let value = match is_null {
                    true => Value::Null,
                    false => Value::Scalar(text.into_owned()),
                };
                Some(Node {
                    line: Some(line),
                    value,
                })
            }
            Event::SequenceEnd | Event::MappingEnd => open.pop().map(close),
            Event::DocumentEnd => break,
            _ => None,
        };
        if open.len() > MAX_DEPTH {
            let message = format!("lists and maps are nested deeper than {MAX_DEPTH}");
            return Err(Error::at(line, message));
        }
        if let Some(node) = done {
            match open.last_mut() {
                Some(parent) => add(parent, node)?,
                None => return Ok(node),
            }
        }
    }
    Err(Error::malformed("the file has no content"))
}

fn close(open: Open) -> Node {
    let value = match open.content {
        Content::List(list) => Value::List(list),
        Content::Map(entries, _) => Value::Map(entries),
    };
    Node {
        line: Some(open.line),
        value,
    }
}

fn add(parent: &mut Open, node: Node) -> Result<()> {
    match &mut parent.content {
        Content::List(list) => list.push(node),
        Content::Map(entries, key) => match (key.take(), node.value) {
            (Some(key), value) => entries.push((
                key,
                Node {
                    line: node.line,
                    value,
                },
            )),
            (None, Value::Scalar(text)) => *key = Some(text),
            (None, Value::Null) => *key = Some(String::new()),
            (None, _) => {
                let line = node.line.unwrap_or(parent.line);
                return Err(Error::at(line, "a key must be a word, not a list or map"));
            }
        },
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opencv_writes_a_directive_and_tags() {
        let text =
            "%YAML:1.0\n---\nk: !!opencv-matrix\n   rows: 1\n   data: [ 5., .5,\n       1e-3 ]\n";
        let Value::Map(map) = parse(text).unwrap().value else {
            panic!("no map")
        };
        assert_eq!(map[0].0, "k");
        let Value::Map(matrix) = &map[0].1.value else {
            panic!("no matrix")
        };
        assert_eq!(matrix[1].1.line, Some(5));
        let Value::List(data) = &matrix[1].1.value else {
            panic!("no data")
        };
        assert_eq!(data.len(), 3);
        assert_eq!(data[2].line, Some(6));
    }

    #[test]
    fn bombs_are_refused() {
        let aliases = "a: &a [1, 2]\nb: [*a, *a]\n";
        assert_eq!(
            parse(aliases).unwrap_err().to_string(),
            "line 2: aliases (*name) are not supported"
        );
        assert!(parse(&"[".repeat(1000)).is_err());
        assert!(parse("").is_err());
        assert!(parse("? [1]\n: 2\n").is_err());
    }
}
