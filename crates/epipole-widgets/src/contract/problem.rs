//! What can go wrong between a reader and a figure, in sentences.

use epipole_canvas::canvas::BadSize;

/// Why a figure could not do what it was asked.
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
    /// A value that the parameter does not take.
    #[error("\"{value}\" is not a value of {name}: it takes {expected}")]
    BadValue {
        /// The parameter's name.
        name: String,
        /// The value given.
        value: String,
        /// What it takes, in words.
        expected: String,
    },
    /// The picture cannot be drawn at this size.
    #[error(transparent)]
    BadSize(#[from] BadSize),
    /// A computation in another place, such as a worker of the page, ended with this sentence.
    #[error("{sentence}")]
    Elsewhere {
        /// What it said.
        sentence: String,
    },
    /// The mathematics behind the figure refused.
    #[error(transparent)]
    Core(#[from] epipole::Error),
}
