//! Result of a command: fields for scripts, a table for people.

use crate::failure::Failure;
use crate::files;
use serde::Serialize;
use serde_json::{Map, Value};
use std::path::Path;

/// The result of a command.
#[derive(Debug, Default)]
pub(crate) struct Report {
    fields: Map<String, Value>,
    rows: Vec<(String, String)>,
    /// Content of the output `-`.
    output: Option<Vec<u8>>,
}

impl Report {
    /// Adds a field of the JSON object.
    pub(crate) fn field(mut self, name: &str, value: impl Serialize) -> Self {
        // Values consist of numbers, strings, lists and maps with string keys.
        let value = serde_json::to_value(value).expect("the value has a JSON form");
        self.fields.insert(name.to_owned(), value);
        self
    }

    /// Adds a row of the table.
    pub(crate) fn row(mut self, label: &str, value: impl ToString) -> Self {
        self.rows.push((label.to_owned(), value.to_string()));
        self
    }

    /// Writes an output file. The output `-` is printed instead of the table.
    ///
    /// # Errors
    /// As [`files::write`].
    pub(crate) fn file(mut self, path: &Path, bytes: Vec<u8>) -> Result<Self, Failure> {
        match files::is_standard(path) {
            true => self.output = Some(bytes),
            false => files::write(path, &bytes)?,
        }
        Ok(self)
    }

    /// Takes the content of the output `-`.
    pub(crate) fn take_output(&mut self) -> Option<Vec<u8>> {
        self.output.take()
    }

    /// Returns one JSON object.
    pub(crate) fn into_json(mut self, time_ms: f64) -> String {
        self.fields.insert("time_ms".to_owned(), time_ms.into());
        Value::Object(self.fields).to_string()
    }

    /// Returns a table with one label and value per line.
    pub(crate) fn into_table(mut self, time_ms: f64) -> String {
        self.rows
            .push(("time".to_owned(), format!("{time_ms:.1} ms")));
        let width = self
            .rows
            .iter()
            .map(|(label, _)| label.chars().count())
            .max()
            .unwrap_or(0);
        let line = |(label, value): &(String, String)| format!("{label:width$}  {value}");
        self.rows.iter().map(line).collect::<Vec<_>>().join("\n")
    }
}
