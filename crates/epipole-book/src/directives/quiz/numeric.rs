//! Answers that are numbers.

use crate::resolve::numbers::{self, Number as Computed};

/// A numeric answer as written.
pub(super) struct Number {
    /// Expression computed by the core, written as in `{{#value …}}`.
    pub(super) value: Option<String>,
    /// Answer defined by the question itself.
    pub(super) answer: Option<f64>,
    pub(super) tolerance: f64,
    pub(super) unit: Option<String>,
}

/// A known numeric answer.
pub(super) struct Answer {
    pub(super) value: f64,
    /// The number as printed on the page.
    pub(super) printed: String,
    pub(super) tolerance: f64,
    pub(super) unit: Option<String>,
}

impl Number {
    /// Computes the answer.
    ///
    /// # Errors
    /// A message.
    pub(super) fn answer(self) -> Result<Answer, String> {
        let (value, printed) = match (&self.value, self.answer) {
            (Some(call), _) => {
                let (name, settings) = call_parts(call)?;
                let value = match numbers::compute(&name, &without_digits(&settings))? {
                    Computed::Count(count) => count as f64,
                    Computed::Real(value, _) => value,
                };
                (value, numbers::print(&name, &settings)?)
            }
            (None, Some(answer)) => (answer, answer.to_string()),
            (None, None) => return Err("a numeric question needs value or answer".to_owned()),
        };
        let tolerance = self.tolerance;
        if !value.is_finite() || !tolerance.is_finite() || tolerance < 0.0 {
            return Err(
                "answer and tolerance must be finite, and tolerance not negative".to_owned(),
            );
        }
        let typed: f64 = printed
            .parse()
            .map_err(|_| "the answer is not a number".to_owned())?;
        if libm::fabs(typed - value) > tolerance {
            return Err(format!(
                "the printed answer {printed} is not within the tolerance {tolerance} of {value}"
            ));
        }
        Ok(Answer {
            value,
            printed,
            tolerance,
            unit: self.unit,
        })
    }
}

fn call_parts(call: &str) -> Result<(String, Vec<(String, String)>), String> {
    let mut words = call.split_whitespace();
    let name = words.next().ok_or("value is empty")?.to_owned();
    let setting = |word: &str| match word.split_once('=') {
        Some((key, value)) => Ok((key.to_owned(), value.to_owned())),
        None => Err(format!("`{word}`: a setting is written key=value")),
    };
    Ok((name, words.map(setting).collect::<Result<_, _>>()?))
}

fn without_digits(settings: &[(String, String)]) -> Vec<(String, String)> {
    settings
        .iter()
        .filter(|(key, _)| key != "digits")
        .cloned()
        .collect()
}
