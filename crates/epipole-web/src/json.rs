//! JSON output of the module.

use serde::Serialize;
use serde_json::ser::Formatter;
use std::io::{self, Write};

/// A figure's entry in the list of all.
#[derive(Serialize)]
pub(crate) struct Listed {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) help: &'static str,
}

/// JSON of plain data of this crate.
pub(crate) fn json<T: Serialize>(value: &T) -> String {
    let mut text = Vec::with_capacity(4096);
    let mut serializer = serde_json::Serializer::with_formatter(&mut text, Plain);
    // Only a map with keys that are no strings, or a failing `Serialize`, could fail; there is
    // none.
    let written = value.serialize(&mut serializer);
    debug_assert!(written.is_ok());
    String::from_utf8(text).unwrap_or_default()
}

/// Numbers as the rest of the module writes them: a second printer of floating-point numbers, with
/// its tables, would be a good part of the module.
struct Plain;

impl Formatter for Plain {
    fn write_f64<W: ?Sized + Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        write!(writer, "{value}")
    }
}
