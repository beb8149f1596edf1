//! JSON as a tree. Source: RFC 8259.

use super::node::{Node, Value};
use crate::{Error, Result};
use serde_json::Value as Json;

/// Reads a JSON text. Nesting is limited by the parser, to 128.
pub(super) fn parse(text: &str) -> Result<Node> {
    let json = serde_json::from_str(text)
        .map_err(|error| Error::at(error.line(), format!("not JSON: {}", without_place(&error))))?;
    Ok(node(json))
}

/// Returns the message of an error without its " at line 3 column 5".
fn without_place(error: &serde_json::Error) -> String {
    let message = error.to_string();
    match message.rfind(" at line ") {
        Some(end) => message[..end].to_owned(),
        None => message,
    }
}

fn node(json: Json) -> Node {
    let value = match json {
        Json::Null => Value::Null,
        Json::Bool(value) => Value::Scalar(value.to_string()),
        Json::Number(value) => Value::Scalar(value.to_string()),
        Json::String(value) => Value::Scalar(value),
        Json::Array(list) => Value::List(list.into_iter().map(node).collect()),
        Json::Object(map) => {
            let entries = map.into_iter().map(|(key, value)| (key, node(value)));
            Value::Map(entries.collect())
        }
    };
    Node { line: None, value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_digits() {
        let tree = parse(r#"{"k": [0.1, 5, -1e-300]}"#).unwrap();
        let Value::Map(map) = tree.value else {
            panic!("no map")
        };
        let Value::List(list) = &map[0].1.value else {
            panic!("no list")
        };
        let number = |node: &Node| match &node.value {
            Value::Scalar(text) => text.parse::<f64>().unwrap(),
            _ => f64::NAN,
        };
        assert_eq!(
            list.iter().map(number).collect::<Vec<_>>(),
            [0.1, 5.0, -1e-300]
        );
    }

    #[test]
    fn errors_name_the_line() {
        let error = parse("{\n\"k\": [1,\n}").unwrap_err().to_string();
        assert!(error.starts_with("line 3: not JSON: "), "{error}");
        assert!(!error[6..].contains("line"), "{error}");
        assert!(parse(&"[".repeat(1 << 20)).is_err());
    }
}
