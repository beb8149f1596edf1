//! Errors thrown in JavaScript.

use epipole::Error;

/// Reason why a call has no result.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Class or code of the error: `TypeError`, `RangeError`, `AbortError`, or, for data that give
    /// no result, `TooFew`, `Degenerate`, `NoConsensus`.
    pub kind: &'static str,
    /// Message for the caller.
    pub message: String,
}

/// Result of reading an argument or of a call.
pub type Result<T> = std::result::Result<T, Fault>;

impl Fault {
    /// Creates the error for a wrong type.
    pub(crate) fn of_type(message: String) -> Self {
        let kind = "TypeError";
        Self { kind, message }
    }

    /// Creates the error for a value out of range.
    pub(crate) fn of_range(message: String) -> Self {
        let kind = "RangeError";
        Self { kind, message }
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let kind = match error {
            Error::TooFew { .. } | Error::TooFewDistinct { .. } => "TooFew",
            Error::Degenerate { .. } | Error::PointAtInfinity | Error::PointBehindCamera => {
                "Degenerate"
            }
            Error::NoConsensus { .. } => "NoConsensus",
            Error::Canceled => "AbortError",
            _ => "RangeError",
        };
        let message = error.to_string();
        Self { kind, message }
    }
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Fault {}
