//! Plain data that crosses the boundary between Rust and JavaScript.

use std::borrow::Cow;

/// Key of a record.
pub type Key = Cow<'static, str>;

/// Plain data of JavaScript.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// `undefined` or `null`.
    Nothing,
    /// A boolean.
    Flag(bool),
    /// A number.
    Number(f64),
    /// A string.
    Text(String),
    /// `Uint8Array` or `Uint8ClampedArray`.
    Bytes(Vec<u8>),
    /// `Uint32Array`.
    Indices(Vec<u32>),
    /// `Int32Array`.
    Integers(Vec<i32>),
    /// `Float32Array`.
    Floats(Vec<f32>),
    /// `Float64Array`, or an array of numbers.
    Doubles(Vec<f64>),
    /// Any other array.
    List(Vec<Value>),
    /// A plain object.
    Record(Vec<(Key, Value)>),
    /// Any other type, by its name.
    Other(String),
}

impl Value {
    /// Describes its type for messages, such as "a string".
    pub fn describe(&self) -> String {
        match self {
            Self::Nothing => "missing".to_owned(),
            Self::Flag(flag) => format!("{flag}"),
            Self::Number(number) => format!("{number}"),
            Self::Text(text) => format!("the string {text:?}"),
            Self::Bytes(list) => format!("an array of {} bytes", list.len()),
            Self::Indices(list) => format!("an array of {} integers", list.len()),
            Self::Integers(list) => format!("an array of {} integers", list.len()),
            Self::Floats(list) => format!("an array of {} numbers", list.len()),
            Self::Doubles(list) => format!("an array of {} numbers", list.len()),
            Self::List(list) => format!("an array of {} elements", list.len()),
            Self::Record(_) => "an object".to_owned(),
            Self::Other(kind) => kind.clone(),
        }
    }

    /// Returns the numbers of a flat array with any element type.
    pub(crate) fn numbers(&self) -> Option<Cow<'_, [f64]>> {
        match self {
            Self::Doubles(list) => Some(Cow::Borrowed(list)),
            Self::Integers(list) => Some(list.iter().map(|&x| f64::from(x)).collect()),
            Self::Floats(list) => Some(list.iter().map(|&x| f64::from(x)).collect()),
            Self::Bytes(list) => Some(list.iter().map(|&x| f64::from(x)).collect()),
            Self::Indices(list) => Some(list.iter().map(|&x| f64::from(x)).collect()),
            Self::List(list) if list.is_empty() => Some(Cow::Borrowed(&[])),
            _ => None,
        }
    }

    /// Returns an entry of a record; [`Value::Nothing`] if absent.
    pub(crate) fn get(&self, key: &str) -> &Value {
        let entries = match self {
            Self::Record(entries) => entries.as_slice(),
            _ => &[],
        };
        let entry = entries.iter().find(|(name, _)| name == key);
        entry.map_or(&Self::Nothing, |(_, value)| value)
    }
}

/// Converts `max_error_px` to `maxErrorPx`. Names that start with a capital letter remain
/// unchanged.
pub fn camel(name: &str) -> String {
    let mut out = String::new();
    if name.starts_with(|first: char| first.is_ascii_uppercase()) {
        return name.to_owned();
    }
    for (index, part) in name.split('_').enumerate() {
        let mut letters = part.chars();
        match letters.next() {
            Some(first) if index > 0 => {
                out.push(first.to_ascii_uppercase());
                out.push_str(letters.as_str());
            }
            _ => out.push_str(part),
        }
    }
    out
}

/// Whether a text is a name in snake case.
pub fn is_name(text: &str) -> bool {
    let is_part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    text.starts_with(|c: char| c.is_ascii_lowercase()) && text.chars().all(is_part)
}

#[cfg(test)]
mod tests {
    use super::{camel, is_name};

    #[test]
    fn names_are_in_camel_case() {
        for (rust, script) in [
            ("max_error_px", "maxErrorPx"),
            ("seed", "seed"),
            ("cam2_from_cam1", "cam2FromCam1"),
            ("homography_4point", "homography4point"),
        ] {
            assert!(is_name(rust));
            assert_eq!(camel(rust), script);
        }
        assert_eq!(camel("Aruco4x4_50"), "Aruco4x4_50");
        assert!(!is_name("F x1 = 0"));
    }
}
