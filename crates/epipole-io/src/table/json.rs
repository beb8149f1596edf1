//! Rows of numbers in JSON: lists of lists, as `json.dump(array.tolist(), file)` writes them, or
//! lists of objects with named numbers.

use crate::{Error, Result};
use serde_json::Value;

/// The rows of a JSON text, or `None` if it is no list of rows in JSON. Lists in a row are
/// flattened; numbers behind the Nth are ignored.
///
/// * `expected`: names of the columns, in words
///
/// # Errors
/// [`Error::Malformed`] with the row that has fewer numbers.
pub(super) fn read<const N: usize>(
    text: &str,
    names: &[[&str; N]],
    expected: &str,
) -> Option<Result<Vec<[f64; N]>>> {
    let rows: Vec<Value> = (text.trim_start().starts_with('['))
        .then(|| serde_json::from_str(text).ok())
        .flatten()?;
    let numbered = rows.iter().zip(1..);
    if rows.iter().any(Value::is_object) {
        return Some(
            numbered
                .map(|(row, at)| named(row, at, names, expected))
                .collect(),
        );
    }
    let lists: Vec<Vec<f64>> = rows.iter().map(flatten).collect::<Option<_>>()?;
    // One line of text: a row whose parts are in brackets.
    if lists.iter().map(Vec::len).sum::<usize>() == N {
        return None;
    }
    let row = |(list, at): (&Vec<f64>, i32)| {
        (list.first_chunk().copied()).ok_or_else(|| {
            let got = list.len();
            Error::malformed(format!("row {at} has {got} numbers where {N} should be"))
        })
    };
    Some(lists.iter().zip(1..).map(row).collect())
}

/// The numbers of nested lists; `None` for anything else.
fn flatten(row: &Value) -> Option<Vec<f64>> {
    let parts = row.as_array()?.iter().map(|value| match value.as_f64() {
        Some(number) => Some(vec![number]),
        None => flatten(value),
    });
    Some(parts.collect::<Option<Vec<_>>>()?.concat())
}

fn named<const N: usize>(
    row: &Value,
    at: usize,
    names: &[[&str; N]],
    expected: &str,
) -> Result<[f64; N]> {
    let number = |name: &str| -> Option<f64> {
        let mut fields = row.as_object()?.iter();
        let (_, value) = fields.find(|(key, _)| key.to_lowercase() == name)?;
        value.as_f64()
    };
    let pick = |names: &[&str; N]| -> Option<[f64; N]> {
        let numbers: Option<Vec<f64>> = names.iter().map(|name| number(name)).collect();
        numbers?.try_into().ok()
    };
    names
        .iter()
        .find_map(pick)
        .ok_or_else(|| Error::malformed(format!("row {at} has no numbers {expected}")))
}
