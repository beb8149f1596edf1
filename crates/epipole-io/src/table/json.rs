//! Rows of numbers in JSON: lists of lists, as from `json.dump(array.tolist(), file)`, or lists of
//! objects with named numbers.

use serde_json::Value;

/// Converts the rows of a JSON text to lines with semicolons, with a header for objects; `None` if
/// it is not a list of rows. Lists in a row are flattened.
///
/// * `columns`: number of values in a row
pub(super) fn lines(text: &str, columns: usize) -> Option<String> {
    if !text.trim_start().starts_with('[') {
        return None;
    }
    let rows: Vec<Value> = serde_json::from_str(text).ok()?;
    if let Some(first) = rows.first().and_then(Value::as_object) {
        let names: Vec<&String> = first.keys().collect();
        let named = |row: &Value| -> Option<Vec<String>> {
            let row = row.as_object()?;
            Some(names.iter().map(|name| number(row.get(*name))).collect())
        };
        let mut lines = vec![names.iter().map(|name| word(name)).collect()];
        lines.extend(rows.iter().map(named).collect::<Option<Vec<_>>>()?);
        return Some(join_fields(&lines));
    }
    let lines: Vec<Vec<String>> = rows.iter().map(flatten).collect::<Option<_>>()?;
    // One line of text, a row whose parts are in brackets.
    let is_one_row = lines.iter().map(Vec::len).sum::<usize>() == columns;
    (!is_one_row).then(|| join_fields(&lines))
}

fn join_fields(lines: &[Vec<String>]) -> String {
    let lines: Vec<String> = lines.iter().map(|fields| fields.join(";")).collect();
    lines.join("\n")
}

/// Returns the text of a number, or "-" for anything else.
fn number(value: Option<&Value>) -> String {
    let number = value.and_then(Value::as_f64);
    number.map_or_else(|| "-".to_owned(), |number| number.to_string())
}

/// Returns a name without the special characters of tables.
fn word(name: &str) -> String {
    name.replace(|c: char| !c.is_alphanumeric() && c != '_', "_")
}

/// Returns the numbers of nested lists; `None` for other values.
fn flatten(row: &Value) -> Option<Vec<String>> {
    let parts = row.as_array()?.iter();
    Some(
        parts
            .flat_map(|part| flatten(part).unwrap_or_else(|| vec![number(Some(part))]))
            .collect(),
    )
}
