//! Errors of figures, as sentences for the reader.

use epipole_canvas::canvas::BadSize;

/// Error of a figure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// No figure has this name.
    #[error("there is no figure \"{name}\"; the figures are {known}")]
    UnknownFigure {
        /// The name asked for.
        name: String,
        /// The names that exist, comma-separated.
        known: String,
    },
    /// The figure has no parameter of this name.
    #[error("the figure {figure} has no parameter \"{name}\"; its parameters are {known}")]
    UnknownParameter {
        /// The figure's name.
        figure: &'static str,
        /// The name asked for.
        name: String,
        /// The names that exist, comma-separated.
        known: String,
    },
    /// The value is not valid for the parameter.
    #[error("\"{value}\" is not a value of {name}: it takes {expected}")]
    BadValue {
        /// The parameter's name.
        name: String,
        /// The value given.
        value: String,
        /// Valid values, in words.
        expected: String,
    },
    /// The picture cannot be drawn at this size.
    #[error(transparent)]
    BadSize(#[from] BadSize),
    /// A computation elsewhere, such as in a worker of the page, failed with this sentence.
    #[error("{sentence}")]
    Elsewhere {
        /// Message of that failure.
        sentence: String,
    },
    /// The computation behind the figure failed.
    #[error(transparent)]
    Core(#[from] epipole::Error),
}
