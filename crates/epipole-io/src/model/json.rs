//! Values of JSON documents, with errors that name the place.

use crate::{Error, Result, text};
use serde_json::Value;

pub(super) fn document(bytes: &[u8]) -> Result<Value> {
    let text = text::decode(bytes)?;
    serde_json::from_str(text).map_err(|error| Error::at(error.line(), error.to_string()))
}

/// A value of an object, with its place.
#[derive(Debug, Clone)]
pub(super) struct Node<'a> {
    value: &'a Value,
    place: String,
}

impl<'a> Node<'a> {
    pub(super) fn root(value: &'a Value) -> Self {
        let place = String::new();
        Self { value, place }
    }

    pub(super) fn value(&self) -> &'a Value {
        self.value
    }

    pub(super) fn error(&self, message: &str) -> Error {
        Error::malformed(format!("{} {message}", self.place))
    }

    /// A member that may be absent.
    pub(super) fn find(&self, key: &str) -> Option<Self> {
        let value = self.value.get(key).filter(|value| !value.is_null())?;
        Some(Self {
            value,
            place: match self.place.is_empty() {
                true => key.to_owned(),
                false => format!("{}.{key}", self.place),
            },
        })
    }

    pub(super) fn get(&self, key: &str) -> Result<Self> {
        self.find(key).ok_or_else(|| match self.place.is_empty() {
            true => Error::malformed(format!("{key} is missing")),
            false => Error::malformed(format!("{}.{key} is missing", self.place)),
        })
    }

    pub(super) fn list(&self) -> Result<Vec<Self>> {
        let list = (self.value.as_array()).ok_or_else(|| self.error("is no list"))?;
        let node = |(index, value)| Self {
            value,
            place: format!("{}[{index}]", self.place),
        };
        Ok(list.iter().enumerate().map(node).collect())
    }

    pub(super) fn number(&self) -> Result<f64> {
        let number = self.value.as_f64().filter(|number| number.is_finite());
        number.ok_or_else(|| self.error("is no finite number"))
    }

    /// A whole number; some programs write 640.0.
    pub(super) fn whole(&self) -> Result<u64> {
        let number = self.number()?;
        let is_whole = number >= 0.0 && number == number.trunc() && number < 9e15;
        match self.value.as_u64() {
            Some(whole) => Ok(whole),
            None if is_whole => Ok(number as u64),
            None => Err(self.error("is no whole number")),
        }
    }

    pub(super) fn text(&self) -> Result<&'a str> {
        self.value.as_str().ok_or_else(|| self.error("is no text"))
    }

    /// A list of exactly N numbers.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N]> {
        let list = self.list()?;
        if list.len() != N {
            return Err(self.error(&format!("has {} numbers, not {N}", list.len())));
        }
        let mut numbers = [0.0; N];
        for (number, node) in numbers.iter_mut().zip(list) {
            *number = node.number()?;
        }
        Ok(numbers)
    }
}
