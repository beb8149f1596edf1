//! Readouts: numbers beside the picture.

use serde::Serialize;

/// A value with its label and unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Readout {
    /// Permanent name.
    pub id: &'static str,
    /// Label shown to the reader.
    pub label: &'static str,
    /// The value.
    pub value: ReadoutValue,
    /// Unit after a number; empty for a pure number.
    pub unit: &'static str,
    /// The value as shown, with its unit.
    pub text: String,
    /// Whether it carries the figure's point: it is then large and always shown. The others fold.
    pub main: bool,
}

/// Value of a readout.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(untagged)]
pub enum ReadoutValue {
    /// A finite number.
    Number(f64),
    /// Words instead of a number.
    Text(String),
}

impl Readout {
    /// Creates a readout of a number; a missing or non-finite one is displayed as "no value".
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

    /// Creates a readout of a fraction in percent, as [`Readout::number`].
    pub fn percent(
        id: &'static str,
        label: &'static str,
        share: impl Into<Option<f64>>,
        digits: usize,
    ) -> Self {
        let percent = share.into().map(|share| 100.0 * share);
        Self::number(id, label, percent, digits, "%")
    }

    /// Creates a readout of a count.
    pub fn count(id: &'static str, label: &'static str, value: usize) -> Self {
        Self::number(id, label, value as f64, 0, "")
    }

    /// Creates a readout of a text.
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
    /// Replaces a missing number by this text.
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

    /// Marks it as one of the two to four that carry the figure's point.
    #[must_use]
    pub fn main(self) -> Self {
        self.main_if(true)
    }

    /// Marks it as [`Readout::main`] if `main`.
    #[must_use]
    pub fn main_if(self, main: bool) -> Self {
        Self { main, ..self }
    }
}

/// Appends the unit: degree and percent signs directly, other units after a space.
pub(super) fn with_unit(number: &str, unit: &str) -> String {
    match unit {
        "" | "°" | "%" => format!("{number}{unit}"),
        _ => format!("{number} {unit}"),
    }
}

/// Formats a number for the reader: fixed digits, a true minus sign, and no minus before zero.
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
