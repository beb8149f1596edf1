//! Errors of readers and writers.

/// Reason why a file cannot be read or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The content is not of the format.
    #[error("{}{message}", .line.map_or_else(String::new, |line| format!("line {line}: ")))]
    Malformed {
        /// Line of the file, counted from 1, if the format has lines.
        line: Option<usize>,
        /// The wrong value, and the expected one.
        message: String,
    },
    /// The content is valid, but not supported by the library, or the format cannot hold it.
    #[error("{message}")]
    Unsupported {
        /// The part that is not supported, and the choices.
        message: String,
    },
    /// Bytes that are not a complete image.
    #[error("the image cannot be read: {why}")]
    BadImage {
        /// The problem, in words.
        why: String,
    },
    /// An image with more pixels than the caller allows.
    #[error("the image has {got} pixels, more than the limit of {limit}")]
    TooManyPixels {
        /// Width times height.
        got: u64,
        /// The limit, which the caller may raise.
        limit: u64,
    },
    /// The values describe no valid camera, transform or data.
    #[error(transparent)]
    Invalid(#[from] epipole::Error),
}

impl Error {
    /// Creates an error on a malformed line, counted from 1.
    pub(crate) fn at(line: usize, message: impl Into<String>) -> Self {
        Self::Malformed {
            line: Some(line),
            message: message.into(),
        }
    }

    /// Creates an error on a malformed file, without a line.
    pub(crate) fn malformed(message: impl Into<String>) -> Self {
        Self::Malformed {
            line: None,
            message: message.into(),
        }
    }

    /// Adds the line to an error without one.
    pub(crate) fn on_line(self, line: usize) -> Self {
        match self {
            Self::Malformed {
                line: None,
                message,
            } => Self::at(line, message),
            Self::Invalid(error) => Self::at(line, error.to_string()),
            other => other,
        }
    }

    /// Adds the file to an error of a format that consists of several files.
    pub(crate) fn in_file(self, name: &str) -> Self {
        match self {
            Self::Malformed {
                line: Some(line),
                message,
            } => Self::malformed(format!("{name}, line {line}: {message}")),
            Self::Malformed {
                line: None,
                message,
            } => Self::malformed(format!("{name}: {message}")),
            other => other,
        }
    }

    /// Creates an error on an unsupported part.
    pub(crate) fn unsupported(message: impl Into<String>) -> Self {
        Self::Unsupported {
            message: message.into(),
        }
    }
}

/// Part of a list, or the reason why it is left out.
pub(crate) type Listed<T> = std::result::Result<T, String>;

/// Separates unsupported entries, so that the rest of a list can be read.
///
/// # Errors
/// Every other error.
pub(crate) fn set_aside<T>(read: Result<T>) -> Result<Listed<T>> {
    match read {
        Ok(read) => Ok(Ok(read)),
        Err(Error::Unsupported { message }) => Ok(Err(message)),
        Err(error) => Err(error),
    }
}

/// Result of reading or writing a file.
pub type Result<T> = std::result::Result<T, Error>;
