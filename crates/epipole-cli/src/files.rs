//! Reading and writing, with sentences for what goes wrong and nothing half-written.

use crate::failure::Failure;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// Prints one text and a line end on standard output.
///
/// # Errors
/// If standard output is closed.
pub(crate) fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "{text}")?;
    out.flush()
}

/// Writes a file aside and then renames it, so that a reader never sees half of it.
///
/// # Errors
/// A sentence naming the file.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failure =
        |error: io::Error| Failure::new("write", format!("cannot be written: {error}")).about(path);
    let mut aside = path.as_os_str().to_owned();
    aside.push(format!(".{}.part", std::process::id()));
    let aside = Path::new(&aside);
    fs::write(aside, bytes)
        .and_then(|()| fs::rename(aside, path))
        .map_err(|error| {
            // The part may not exist; there is nothing more to tell than the first error.
            let _ = fs::remove_file(aside);
            failure(error)
        })
}

/// Reads a file of text, without the byte order mark that some editors put at its start.
///
/// # Errors
/// A sentence naming the file.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    let text = fs::read_to_string(path).map_err(|error| {
        let why = match error.kind() {
            io::ErrorKind::NotFound => "there is no such file".to_owned(),
            io::ErrorKind::InvalidData => "this is not a text file".to_owned(),
            _ => format!("cannot be read: {error}"),
        };
        Failure::new("read", why).about(path)
    })?;
    Ok(match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text,
    })
}

/// Makes a folder, with those above it.
///
/// # Errors
/// A sentence naming the folder.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| {
        Failure::new("write", format!("the folder cannot be made: {error}")).about(path)
    })
}
