//! Text files: decoding, lines and numbers.

use crate::{Error, Result};

/// The text of a file, without a byte order mark. Line ends may be `\n` or `\r\n`.
pub(crate) fn decode(bytes: &[u8]) -> Result<&str> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(Error::malformed("the text is UTF-16: save it as UTF-8"));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        Error::malformed(format!(
            "not text: byte {} is not UTF-8",
            error.valid_up_to()
        ))
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// Lines with content and their numbers, counted from 1: comments after `#` and blank lines are
/// left out.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (text.lines().enumerate())
        .map(|(index, line)| (index + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty())
}

/// A finite number.
pub(crate) fn number(line: usize, word: &str) -> Result<f64> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(Error::at(line, format!("{word} is not finite"))),
        Err(_) => Err(Error::at(line, format!("\"{word}\" is not a number"))),
    }
}
