//! Words and lines of COLMAP's text files.

use crate::text::number;
use crate::{Error, Result};
use std::str::SplitAsciiWhitespace;

/// Words of a line, read one by one.
pub(crate) struct Words<'a> {
    line: usize,
    words: SplitAsciiWhitespace<'a>,
}

impl<'a> Words<'a> {
    pub(crate) fn new(line: usize, text: &'a str) -> Self {
        let words = text.split_ascii_whitespace();
        Self { line, words }
    }

    /// * `what`: name of the value, for the error if it is missing
    pub(crate) fn word(&mut self, what: &str) -> Result<&'a str> {
        (self.words.next()).ok_or_else(|| Error::at(self.line, format!("{what} is missing")))
    }

    pub(crate) fn number(&mut self, what: &str) -> Result<f64> {
        let word = self.word(what)?;
        number(self.line, word)
    }

    pub(crate) fn numbers<const N: usize>(&mut self, what: &str) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for value in &mut numbers {
            *value = self.number(what)?;
        }
        Ok(numbers)
    }

    /// Returns the next word, if there is one.
    pub(crate) fn next(&mut self) -> Option<&'a str> {
        self.words.next()
    }

    /// Reads all remaining numbers.
    pub(crate) fn rest(self) -> Result<Vec<f64>> {
        let line = self.line;
        self.words.map(|word| number(line, word)).collect()
    }

    /// Reads a number that may be NaN or infinite.
    pub(crate) fn any_number(&mut self, what: &str) -> Result<f64> {
        let word = self.word(what)?;
        (word.parse()).map_err(|_| Error::at(self.line, format!("\"{word}\" is not a number")))
    }

    pub(crate) fn whole<T: std::str::FromStr>(&mut self, what: &str) -> Result<T> {
        let word = self.word(what)?;
        (word.parse()).map_err(|_| Error::at(self.line, format!("{what} cannot be \"{word}\"")))
    }
}

/// Returns whether COLMAP skips a line.
pub(crate) fn is_skipped(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#')
}

/// Returns the lines with content and their numbers, counted from 1.
pub(crate) fn content(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    lines.filter(|(_, line)| !is_skipped(line))
}
