//! The error type of the library, with messages for the user.

use std::ops::RangeInclusive;

/// Reason why an operation failed.
///
/// Invalid data never causes a panic or a NaN, but one of these errors.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Fewer data than the computation needs.
    #[error("{what} needs at least {needed}, but {}", only(*.got))]
    TooFew {
        /// Description of the computation, with its unit of counting, such as "a fundamental matrix
        /// from matches".
        what: &'static str,
        /// Minimum sufficient number.
        needed: usize,
        /// Number of data, with repetitions.
        got: usize,
    },
    /// Enough data, but too few distinct: repetitions count once.
    #[error("{what} needs at least {needed} that differ, but {}", distinct(*.got, *.total))]
    TooFewDistinct {
        /// Description of the computation, as in [`Error::TooFew`].
        what: &'static str,
        /// Minimum sufficient number.
        needed: usize,
        /// Number of distinct data.
        got: usize,
        /// Number of data, with repetitions.
        total: usize,
    },
    /// A NaN or an infinity among the inputs.
    #[error("{what} must be a finite number")]
    NotFinite {
        /// Name of the input.
        what: &'static str,
    },
    /// A parameter outside its range.
    #[error("{what} must be {requirement}, but is {}", brief(*.value))]
    OutOfRange {
        /// Name of the parameter.
        what: &'static str,
        /// Description of the range, such as "greater than 0".
        requirement: &'static str,
        /// Actual value.
        value: f64,
    },
    /// The data do not determine the result.
    #[error("{what} is not determined: {why}")]
    Degenerate {
        /// Name of the undetermined quantity.
        what: &'static str,
        /// Reason why the data do not determine it, such as "all points lie on one line".
        why: &'static str,
    },
    /// Two inputs that must have the same size differ.
    #[error("{what} must have the same size, but one has {first} and the other {second}")]
    SizeMismatch {
        /// Description of the two inputs, such as "the two lists of points".
        what: &'static str,
        /// Size of the first input.
        first: usize,
        /// Size of the second input.
        second: usize,
    },
    /// The rays are parallel: the point is infinitely far away.
    #[error("the rays are parallel, so the point is infinitely far away")]
    PointAtInfinity,
    /// The point is behind the camera or in its center plane, so it has no projection.
    #[error("the point is not in front of the camera")]
    PointBehindCamera,
    /// No model had enough support.
    #[error(
        "no model was supported by at least {needed} of the {got} data after {iterations} tries"
    )]
    NoConsensus {
        /// Minimum number of inliers.
        needed: usize,
        /// Number of data points.
        got: usize,
        /// Number of samples drawn.
        iterations: usize,
    },
    /// Canceled by the caller.
    #[error("the work was canceled")]
    Canceled,
}

impl Error {
    /// Checks that a number is finite and in range.
    ///
    /// * `what`, `requirement`: as in [`Error::OutOfRange`]
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutOfRange`].
    ///
    /// ```
    /// use epipole::Error;
    /// let check = |fraction| Error::check_range("the fraction", "between 0 and 1", fraction, 0.0..=1.0);
    /// assert!(check(1.0).is_ok());
    /// let message = check(1.5).unwrap_err().to_string();
    /// assert_eq!(message, "the fraction must be between 0 and 1, but is 1.5");
    /// ```
    pub fn check_range(
        what: &'static str,
        requirement: &'static str,
        value: f64,
        range: RangeInclusive<f64>,
    ) -> Result<(), Self> {
        if !value.is_finite() {
            return Err(Self::NotFinite { what });
        }
        if !range.contains(&value) {
            return Err(Self::OutOfRange {
                what,
                requirement,
                value,
            });
        }
        Ok(())
    }

    /// Checks rules for parameters: name, description of the range, value, and whether it is in
    /// range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the first violated rule.
    pub(crate) fn check_rules(
        rules: &[(&'static str, &'static str, f64, bool)],
    ) -> Result<(), Self> {
        match rules.iter().find(|(.., is_good)| !is_good) {
            None => Ok(()),
            Some(&(what, requirement, value, _)) => Err(Self::OutOfRange {
                what,
                requirement,
                value,
            }),
        }
    }
}

/// Formats the count for [`Error::TooFew`].
fn only(count: usize) -> String {
    match count {
        0 => "there are none".to_owned(),
        1 => "there is only 1".to_owned(),
        _ => format!("there are only {count}"),
    }
}

/// Formats the counts for [`Error::TooFewDistinct`].
fn distinct(count: usize, total: usize) -> String {
    match count {
        1 => format!("the {total} given are equal"),
        _ => format!("of the {total} given only {count} are distinct: the others repeat them"),
    }
}

/// Formats a number without long runs of zeros.
fn brief(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !size.is_finite() || (1e-6..1e15).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::{Error, brief};

    #[test]
    fn few_data_are_counted_in_good_english() {
        for (got, end) in [
            (0, "but there are none"),
            (1, "but there is only 1"),
            (6, "but there are only 6"),
        ] {
            let error = Error::TooFew {
                what: "a fundamental matrix from matches",
                needed: 7,
                got,
            };
            let whole = format!("a fundamental matrix from matches needs at least 7, {end}");
            assert_eq!(error.to_string(), whole);
        }
    }

    #[test]
    fn repetitions_are_named() {
        for (got, end) in [
            (1, "but the 9 given are equal"),
            (
                2,
                "but of the 9 given only 2 are distinct: the others repeat them",
            ),
        ] {
            let error = Error::TooFewDistinct {
                what: "a fundamental matrix from matches",
                needed: 7,
                got,
                total: 9,
            };
            let whole =
                format!("a fundamental matrix from matches needs at least 7 that differ, {end}");
            assert_eq!(error.to_string(), whole);
        }
    }

    #[test]
    fn numbers_are_brief() {
        for (value, text) in [
            (0.0, "0"),
            (-2.5, "-2.5"),
            (1e9, "1000000000"),
            (1e300, "1e300"),
            (-3e-12, "-3e-12"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(brief(value), text);
        }
    }
}
