//! Words of a text with their line numbers.

use crate::{Error, Result};

/// Reader of the words of a text, with checks of numbers.
pub(crate) struct Tokens<'a> {
    words: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    line: usize,
}

impl<'a> Tokens<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        let words = text.lines().enumerate().flat_map(|(line, content)| {
            content.split_whitespace().map(move |word| (line + 1, word))
        });
        Self {
            words: Box::new(words),
            line: 1,
        }
    }

    /// Creates an error at the last word read.
    pub(crate) fn error(&self, why: String) -> Error {
        Error::at(self.line, why)
    }

    fn word(&mut self, meaning: &str) -> Result<&'a str> {
        match self.words.next() {
            Some((line, word)) => {
                self.line = line;
                Ok(word)
            }
            None => Err(self.error(format!("the text ends where {meaning} should follow"))),
        }
    }

    /// Reads a finite number.
    pub(crate) fn number(&mut self, meaning: &str) -> Result<f64> {
        let word = self.word(meaning)?;
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(self.error(format!("{meaning} is not finite: “{word}”"))),
            Err(_) => Err(self.error(format!("{meaning} is not a number: “{word}”"))),
        }
    }

    /// Reads a whole number below `bound`.
    pub(crate) fn index(&mut self, meaning: &str, bound: usize) -> Result<usize> {
        let word = self.word(meaning)?;
        match word.parse::<usize>() {
            Ok(value) if value < bound => Ok(value),
            Ok(value) => Err(self.error(format!(
                "{meaning} is {value}, but must be less than {bound}"
            ))),
            Err(_) => Err(self.error(format!("{meaning} is not a whole number: “{word}”"))),
        }
    }

    /// Checks that only blanks follow.
    pub(crate) fn end(&mut self) -> Result<()> {
        match self.words.next() {
            Some((line, word)) => {
                self.line = line;
                Err(self.error(format!("“{word}” follows where the text should end")))
            }
            None => Ok(()),
        }
    }
}
