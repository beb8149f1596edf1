//! Values by their keys, with errors that name key and line.

use super::node::{Node, Value};
use crate::{Error, Result};

/// A node and the keys that lead to it.
#[derive(Debug, Clone)]
pub(crate) struct Field<'a> {
    /// Keys from the root, joined by dots; empty for the root.
    path: String,
    node: &'a Node,
}

impl<'a> Field<'a> {
    pub(crate) fn root(node: &'a Node) -> Self {
        Self {
            path: String::new(),
            node,
        }
    }

    fn child(&self, key: &str, node: &'a Node) -> Self {
        let path = match self.path.is_empty() {
            true => key.to_owned(),
            false => format!("{}.{key}", self.path),
        };
        Self { path, node }
    }

    /// Returns the value of a key; `None` if it is missing or null.
    pub(crate) fn get(&self, key: &str) -> Option<Self> {
        self.all(key).next()
    }

    /// Returns all values of a key, of which XML may have several.
    pub(crate) fn all(&self, key: &str) -> impl Iterator<Item = Self> {
        let entries: &'a [(String, Node)] = match &self.node.value {
            Value::Map(entries) => entries,
            _ => &[],
        };
        entries
            .iter()
            .filter(move |(name, node)| name == key && node.value != Value::Null)
            .map(|(name, node)| self.child(name, node))
    }

    /// Returns the value of the first key present, ignoring case, `_` and `-`.
    ///
    /// * `keys`: lower case, without `_` and `-`
    pub(crate) fn any(&self, keys: &[&str]) -> Option<Self> {
        let entries = self.entries();
        keys.iter().find_map(|key| {
            let of_key = |entry: &&(String, Self)| {
                let letters = entry.0.chars().filter(|c| !matches!(c, '_' | '-' | ' '));
                letters.flat_map(char::to_lowercase).eq(key.chars())
            };
            let (_, field) = entries.iter().find(of_key)?;
            Some(field.clone())
        })
    }

    /// Returns the value of a key.
    ///
    /// # Errors
    /// [`Error::Malformed`] if there is none.
    ///
    /// * `expected`: expected value, such as "width in pixels"
    pub(crate) fn need(&self, key: &str, expected: &str) -> Result<Self> {
        self.get(key).ok_or_else(|| self.missing(key, expected))
    }

    /// Returns the error for a missing key.
    pub(crate) fn missing(&self, key: &str, expected: &str) -> Error {
        let place = match self.path.is_empty() {
            true => key.to_owned(),
            false => format!("{}.{key}", self.path),
        };
        Error::Malformed {
            line: self.node.line.filter(|_| !self.path.is_empty()),
            message: format!("{place} is missing: {expected}"),
        }
    }

    /// Returns the error for a wrong value. `what` follows the key, as in "is not a number".
    pub(crate) fn wrong(&self, what: &str) -> Error {
        Error::Malformed {
            line: self.node.line,
            message: format!("{} {what}", self.path),
        }
    }

    /// Returns the error for a value that is valid, but not supported.
    pub(crate) fn unsupported(&self, what: &str) -> Error {
        Error::unsupported(format!("{} {what}", self.path))
    }

    /// Returns keys and values, without null values.
    pub(crate) fn entries(&self) -> Vec<(String, Self)> {
        match &self.node.value {
            Value::Map(entries) => (entries.iter())
                .filter(|(_, node)| node.value != Value::Null)
                .map(|(name, node)| (name.clone(), self.child(name, node)))
                .collect(),
            _ => Vec::new(),
        }
    }

    /// Returns the elements of a list; `None` for other values.
    pub(crate) fn items(&self) -> Option<Vec<Self>> {
        match &self.node.value {
            Value::List(list) => {
                let item = |(index, node)| Self {
                    path: format!("{}[{index}]", self.path),
                    node,
                };
                Some(list.iter().enumerate().map(item).collect())
            }
            _ => None,
        }
    }

    /// Elements of a list.
    ///
    /// # Errors
    /// [`Error::Malformed`] for anything else.
    pub(crate) fn list(&self) -> Result<Vec<Self>> {
        self.items().ok_or_else(|| self.wrong("is not a list"))
    }

    pub(crate) fn is_map(&self) -> bool {
        matches!(self.node.value, Value::Map(_))
    }

    /// Returns a word or string, without the quotes that OpenCV writes into XML; `None` for lists
    /// and maps.
    pub(crate) fn text(&self) -> Option<&'a str> {
        match &self.node.value {
            Value::Scalar(text) => Some(text.trim().trim_matches('"')),
            _ => None,
        }
    }

    /// Returns a finite number.
    pub(crate) fn number(&self) -> Result<f64> {
        let number = self.text().and_then(|text| text.parse::<f64>().ok());
        number
            .filter(|number| number.is_finite())
            .ok_or_else(|| self.wrong(&format!("is not a finite number{}", self.shown())))
    }

    /// Returns a word or string.
    ///
    /// # Errors
    /// [`Error::Malformed`] for lists and maps.
    pub(crate) fn word(&self) -> Result<&'a str> {
        self.text().ok_or_else(|| self.wrong("is not a text"))
    }

    /// Returns a whole number from 0; some programs write 640.0.
    pub(crate) fn whole(&self) -> Result<u64> {
        let text = self.text().unwrap_or_default();
        let number = text.parse::<f64>().ok();
        let is_whole = |number: &f64| number.fract() == 0.0 && (0.0..9e15).contains(number);
        let whole = text.parse().ok();
        whole
            .or(number.filter(is_whole).map(|number| number as u64))
            .ok_or_else(|| self.wrong(&format!("is not a whole number{}", self.shown())))
    }

    /// Returns exactly N numbers.
    pub(crate) fn array<const N: usize>(&self) -> Result<[f64; N]> {
        let numbers = self.numbers()?;
        let count = numbers.len();
        (numbers.try_into()).map_err(|_| self.wrong(&format!("has {count} numbers, not {N}")))
    }

    /// Returns a whole number of pixels.
    pub(crate) fn pixels(&self) -> Result<u32> {
        let number = self.text().and_then(|text| text.parse::<f64>().ok());
        let is_whole =
            |number: &f64| number.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(number);
        match number.filter(is_whole) {
            Some(number) => Ok(number as u32),
            None => Err(self.wrong(&format!("is not a whole number above 0{}", self.shown()))),
        }
    }

    /// Returns all numbers of a list, of nested lists row by row, of an OpenCV matrix (its `data`)
    /// or of a text with blanks or commas. A single number is a list of one.
    pub(crate) fn numbers(&self) -> Result<Vec<f64>> {
        let mut numbers = Vec::new();
        self.collect(self.node, &mut numbers)?;
        Ok(numbers)
    }

    /// * `node`: this node or a descendant
    fn collect(&self, node: &Node, numbers: &mut Vec<f64>) -> Result<()> {
        let not_numbers = || self.wrong("is not a list of numbers");
        match &node.value {
            Value::Scalar(text) => {
                let words = text.split(|c: char| c.is_whitespace() || c == ',');
                for word in words.filter(|word| !word.is_empty()) {
                    let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
                    numbers.push(number.ok_or_else(|| {
                        self.wrong(&format!("is not a list of finite numbers: \"{word:.40}\""))
                    })?);
                }
                Ok(())
            }
            Value::List(list) => (list.iter()).try_for_each(|node| self.collect(node, numbers)),
            Value::Map(entries) => match entries.iter().find(|(key, _)| key == "data") {
                Some((_, data)) => self.collect(data, numbers),
                None => Err(not_numbers()),
            },
            Value::Null => Err(not_numbers()),
        }
    }

    /// Returns a short value, to append to a message.
    fn shown(&self) -> String {
        match self.text() {
            Some(text) => format!(": \"{text:.40}\""),
            None => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Syntax;
    use super::*;

    #[test]
    fn values_are_found_and_errors_name_them() {
        let text = "Camera-Matrix: {rows: 1, data: [1, [2., 3]]}\nwide: 5.5\nnone: ~\nt: [1, x]\n";
        let node = Syntax::Yaml.parse(text).unwrap();
        let root = Field::root(&node);
        let matrix = root.any(&["k", "cameramatrix"]).unwrap();
        assert_eq!(matrix.numbers().unwrap(), [1.0, 2.0, 3.0]);
        assert!(root.get("none").is_none() && root.get("other").is_none());
        let wide = root.get("wide").unwrap();
        assert_eq!(wide.number().unwrap(), 5.5);
        for (error, message) in [
            (
                wide.pixels().unwrap_err(),
                "line 2: wide is not a whole number above 0: \"5.5\"",
            ),
            (
                root.get("t").unwrap().numbers().unwrap_err(),
                "line 4: t is not a list of finite numbers: \"x\"",
            ),
            (
                root.need("fl_x", "focal length").unwrap_err(),
                "fl_x is missing: focal length",
            ),
            (
                matrix.need("cols", "columns").unwrap_err(),
                "line 1: Camera-Matrix.cols is missing: columns",
            ),
        ] {
            assert_eq!(error.to_string(), message);
        }
    }
}
