//! Failures of commands.

use std::fmt;
use std::process::ExitCode;

/// A failure: a kind for scripts and a message for people.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Failure {
    pub(crate) kind: &'static str,
    pub(crate) message: String,
}

impl Failure {
    pub(crate) fn new(kind: &'static str, message: impl Into<String>) -> Self {
        Self {
            kind,
            message: message.into(),
        }
    }

    /// Adds the file to the message.
    pub(crate) fn about(self, path: &std::path::Path) -> Self {
        Self {
            message: format!("{}: {}", path.display(), self.message),
            ..self
        }
    }

    /// Creates a failure for wrong usage: conflicting options, or options that do not fit a file.
    pub(crate) fn usage(message: impl Into<String>) -> Self {
        Self::new("usage", message)
    }

    /// Returns 2 for wrong usage, else 1.
    pub(crate) fn exit_code(&self) -> ExitCode {
        ExitCode::from(if self.kind == "usage" { 2 } else { 1 })
    }

    /// Returns `{"error": {"kind", "message"}}`.
    pub(crate) fn to_json(&self) -> String {
        let error = serde_json::json!({ "kind": self.kind, "message": self.message });
        serde_json::json!({ "error": error }).to_string()
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.message.fmt(f)
    }
}

impl From<epipole::Error> for Failure {
    fn from(error: epipole::Error) -> Self {
        use epipole::Error as E;
        let kind = match error {
            E::TooFew { .. } | E::TooFewDistinct { .. } => "too-few",
            E::NotFinite { .. } => "not-finite",
            E::OutOfRange { .. } => "out-of-range",
            E::Degenerate { .. } => "degenerate",
            E::SizeMismatch { .. } => "size-mismatch",
            E::NoConsensus { .. } => "no-consensus",
            E::Canceled => "canceled",
            _ => "failed",
        };
        Self::new(kind, error.to_string())
    }
}

impl From<epipole_io::Error> for Failure {
    fn from(error: epipole_io::Error) -> Self {
        use epipole_io::Error as E;
        let kind = match error {
            E::Invalid(error) => return error.into(),
            E::Malformed { .. } => "malformed",
            E::BadImage { .. } => "bad-image",
            E::Unsupported { .. } => "unsupported",
            _ => "failed",
        };
        Self::new(kind, error.to_string())
    }
}

impl From<epipole_widgets::contract::Problem> for Failure {
    fn from(problem: epipole_widgets::contract::Problem) -> Self {
        Self::new("figure", problem.to_string())
    }
}
