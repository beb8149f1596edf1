//! JSON output of the module.

use serde::Serialize;
use serde_json::ser::Formatter;
use std::io::{self, Write};

/// A figure's entry in the list of all figures.
#[derive(Serialize)]
pub(crate) struct Listed {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) help: &'static str,
}

/// Serializes plain data of this crate as JSON.
pub(crate) fn json<T: Serialize>(value: &T) -> String {
    let mut text = Vec::with_capacity(4096);
    let mut serializer = serde_json::Serializer::with_formatter(&mut text, Plain);
    // Serialization fails only for a map with keys that are not strings, or a failing `Serialize`;
    // neither occurs.
    let written = value.serialize(&mut serializer);
    debug_assert!(written.is_ok());
    String::from_utf8(text).unwrap_or_default()
}

/// Formatter that prints numbers like the rest of the module: a second printer of floating-point
/// numbers, with its tables, would take a considerable part of the module.
struct Plain;

impl Formatter for Plain {
    fn write_f64<W: ?Sized + Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        write!(writer, "{value}")
    }
}
