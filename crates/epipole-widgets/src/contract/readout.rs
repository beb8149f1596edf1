//! Readouts: the numbers that a figure shows beside the picture.

use serde::Serialize;

/// A value with its label and unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Readout {
    /// Permanent name.
    pub id: &'static str,
    /// What the reader reads.
    pub label: &'static str,
    /// The value.
    pub value: ReadoutValue,
    /// Unit after a number; empty for a pure number.
    pub unit: &'static str,
    /// The value as shown, with its unit.
    pub text: String,
    /// Whether it carries the figure's point: then it is large and always there. The others fold.
    pub main: bool,
}

/// What a readout can say.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ReadoutValue {
    /// A finite number.
    Number(f64),
    /// Words, where a number would not do or there is none.
    Text(String),
}

impl Readout {
    /// A number; one that is not there, or not finite, becomes the words "no value".
    pub fn number(
        id: &'static str,
        label: &'static str,
        value: impl Into<Option<f64>>,
        digits: usize,
        unit: &'static str,
    ) -> Self {
        let Some(value) = value.into().filter(|value| value.is_finite()) else {
            return Self::words(id, label, "no value");
        };
        let number = format_number(value, digits);
        let text = with_unit(&number, unit);
        Self {
            id,
            label,
            value: ReadoutValue::Number(value),
            unit,
            text,
            main: false,
        }
    }

    /// A share in percent, as [`Readout::number`].
    pub fn percent(
        id: &'static str,
        label: &'static str,
        share: impl Into<Option<f64>>,
        digits: usize,
    ) -> Self {
        let percent = share.into().map(|share| 100.0 * share);
        Self::number(id, label, percent, digits, "%")
    }

    /// A count.
    pub fn count(id: &'static str, label: &'static str, value: usize) -> Self {
        Self::number(id, label, value as f64, 0, "")
    }

    /// Words.
    pub fn words(id: &'static str, label: &'static str, text: impl Into<String>) -> Self {
        let text = text.into();
        Self {
            id,
            label,
            value: ReadoutValue::Text(text.clone()),
            unit: "",
            text,
            main: false,
        }
    }
}

impl Readout {
    /// The same number, or these words where there is none.
    ///
    /// ```
    /// use epipole_widgets::contract::Readout;
    /// let error = |px| Readout::number("error", "Error", px, 1, "px").or("no line");
    /// assert_eq!(error(Some(0.52)).text, "0.5 px");
    /// assert_eq!(error(None).text, "no line");
    /// ```
    #[must_use]
    pub fn or(self, words: &str) -> Self {
        match self.value {
            ReadoutValue::Number(_) => self,
            ReadoutValue::Text(_) => Self::words(self.id, self.label, words).main_if(self.main),
        }
    }

    /// One of the two to four that carry the figure's point.
    #[must_use]
    pub fn main(self) -> Self {
        self.main_if(true)
    }

    /// As [`Readout::main`], if `main`.
    #[must_use]
    pub fn main_if(self, main: bool) -> Self {
        Self { main, ..self }
    }
}

/// A number with its unit: a degree sign stands close to the number, other units after a space.
pub(super) fn with_unit(number: &str, unit: &str) -> String {
    match unit {
        "" | "°" => format!("{number}{unit}"),
        _ => format!("{number} {unit}"),
    }
}

/// A number as a reader reads it: fixed digits, a true minus sign, and no minus before zero.
///
/// ```
/// use epipole_widgets::contract::format_number;
/// assert_eq!(format_number(-2.345, 1), "−2.3");
/// assert_eq!(format_number(-0.001, 2), "0.00");
/// assert_eq!(format_number(1177.0, 0), "1177");
/// ```
pub fn format_number(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(magnitude) if magnitude.bytes().all(|b| b == b'0' || b == b'.') => {
            magnitude.to_owned()
        }
        Some(magnitude) => format!("\u{2212}{magnitude}"),
        None => text,
    }
}
