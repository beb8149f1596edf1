//! Errors of figures, as messages for the reader.

use epipole_canvas::canvas::BadSize;
use serde::Serialize;

/// Error of a figure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// No figure has this name.
    #[error("there is no figure \"{name}\"; the figures are {known}")]
    UnknownFigure {
        /// The requested name.
        name: String,
        /// Existing names, comma-separated.
        known: String,
    },
    /// The figure has no parameter of this name.
    #[error("the figure {figure} has no parameter \"{name}\"; its parameters are {known}")]
    UnknownParameter {
        /// The figure's name.
        figure: &'static str,
        /// The requested name.
        name: String,
        /// Existing names, comma-separated.
        known: String,
    },
    /// The value is not valid for the parameter.
    #[error("\"{value}\" is not a value of {name}: it takes {expected}")]
    BadValue {
        /// The parameter's name.
        name: String,
        /// The rejected value.
        value: String,
        /// Valid values, in words.
        expected: String,
    },
    /// The picture cannot be drawn at this size.
    #[error(transparent)]
    BadSize(#[from] BadSize),
    /// A computation elsewhere, such as in a worker of the page, failed.
    #[error("{sentence}")]
    Elsewhere {
        /// Error message.
        sentence: String,
    },
    /// The computation behind the figure failed.
    #[error(transparent)]
    Core(#[from] epipole::Error),
}

/// A rejected parameter.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Refused {
    /// True if the figure has no such parameter: one in the page's address may belong to another
    /// script.
    pub unknown: bool,
    /// The reason, as a sentence.
    pub message: String,
}

impl From<&Problem> for Refused {
    fn from(problem: &Problem) -> Self {
        Self {
            unknown: matches!(problem, Problem::UnknownParameter { .. }),
            message: problem.to_string(),
        }
    }
}
