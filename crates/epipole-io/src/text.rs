//! Text files: decoding, lines and numbers.

use crate::{Error, Result};

/// Signatures of binary files mistaken for tables, and advice.
const OTHER_FORMATS: [(&[u8], &str); 3] = [
    (
        b"\x93NUMPY",
        "a NumPy file: write it as text, with numpy.savetxt",
    ),
    (
        b"PK\x03\x04",
        "a ZIP file, such as .xlsx and .npz: save it as CSV or text",
    ),
    (
        b"MATLAB 5.0 MAT-file",
        "a MATLAB file: write it as text, with writematrix",
    ),
];

/// Maximum length of an excerpt of a line, characters.
const MAX_EXCERPT: usize = 60;

/// Returns the text of a file, without a byte order mark. Line ends may be `\n` or `\r\n`.
pub(crate) fn decode(bytes: &[u8]) -> Result<&str> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(Error::malformed("the text is UTF-16: save it as UTF-8"));
    }
    let other = OTHER_FORMATS
        .iter()
        .find(|(start, _)| bytes.starts_with(start));
    if let Some((_, why)) = other {
        return Err(Error::malformed(*why));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        Error::malformed(format!(
            "not text: byte {} is not UTF-8",
            error.valid_up_to()
        ))
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// Returns the lines with content and their numbers, counted from 1, without comments after `#` and
/// blank lines.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (text.lines().enumerate())
        .map(|(index, line)| (index + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty())
}

/// Reads a finite number.
pub(crate) fn number(line: usize, word: &str) -> Result<f64> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(Error::at(line, format!("{word} is not finite"))),
        Err(_) => Err(Error::at(line, format!("\"{word}\" is not a number"))),
    }
}

/// Shortens a line for a message.
pub(crate) fn excerpt(line: &str) -> String {
    match line.char_indices().nth(MAX_EXCERPT) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line.to_owned(),
    }
}
