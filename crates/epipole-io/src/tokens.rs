//! Words of a text with the lines they stand in.

use crate::{Error, Result};

/// Hands out the words of a text, numbers checked.
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

    /// An error at the last word that was handed out.
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

    /// A finite number.
    pub(crate) fn number(&mut self, meaning: &str) -> Result<f64> {
        let word = self.word(meaning)?;
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(self.error(format!("{meaning} is not finite: “{word}”"))),
            Err(_) => Err(self.error(format!("{meaning} is not a number: “{word}”"))),
        }
    }

    /// A whole number below `bound`.
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

    /// Nothing but blanks may follow.
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
