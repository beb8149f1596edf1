//! The error type of the core: every failure is a sentence for the user.

use std::ops::RangeInclusive;

/// Reason why an operation has no result.
///
/// Bad data never causes a panic or a NaN, but one of these errors.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Fewer data than the computation needs.
    #[error("{what} needs at least {needed}, but {}", only(*.got))]
    TooFew {
        /// The computation, with its unit of counting, such as "a fundamental matrix from matches".
        what: &'static str,
        /// The smallest sufficient number.
        needed: usize,
        /// Number given.
        got: usize,
    },
    /// Enough data, but too few that differ: repetitions count once.
    #[error("{what} needs at least {needed} that differ, but {}", distinct(*.got, *.given))]
    TooFewDistinct {
        /// The computation, as in [`Error::TooFew`].
        what: &'static str,
        /// The smallest sufficient number.
        needed: usize,
        /// Number of distinct data.
        got: usize,
        /// Number given.
        given: usize,
    },
    /// A NaN or an infinity among the inputs.
    #[error("{what} must be a finite number")]
    NotFinite {
        /// The input's name.
        what: &'static str,
    },
    /// A parameter outside its range.
    #[error("{what} must be {requirement}, but is {}", brief(*.value))]
    OutOfRange {
        /// The parameter's name.
        what: &'static str,
        /// The range in words, such as "greater than 0".
        requirement: &'static str,
        /// The value given.
        value: f64,
    },
    /// The data do not determine the result.
    #[error("{what} is not determined: {why}")]
    Degenerate {
        /// The quantity asked for.
        what: &'static str,
        /// Reason why these data do not determine it, such as "all points lie on one line".
        why: &'static str,
    },
    /// Two inputs differ in size but must agree.
    #[error("{what} must have the same size, but one has {first} and the other {second}")]
    SizeMismatch {
        /// The two inputs, such as "the two lists of points".
        what: &'static str,
        /// Size of the first.
        first: usize,
        /// Size of the second.
        second: usize,
    },
    /// Rays are parallel: the point they share is infinitely far.
    #[error("the rays are parallel, so the point is infinitely far away")]
    PointAtInfinity,
    /// The point is behind the camera or in its center plane, so it has no image.
    #[error("the point is not in front of the camera")]
    PointBehindCamera,
    /// No candidate model gathered enough support.
    #[error(
        "no model was supported by at least {needed} of the {got} data after {iterations} tries"
    )]
    NoConsensus {
        /// The smallest acceptable number of inliers.
        needed: usize,
        /// Number of data.
        got: usize,
        /// Samples drawn.
        iterations: usize,
    },
    /// Canceled by the caller.
    #[error("the work was canceled")]
    Canceled,
}

impl Error {
    /// Checks that a number is finite and in a range.
    ///
    /// * `what`, `requirement`: as in [`Error::OutOfRange`]
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutOfRange`].
    ///
    /// ```
    /// use epipole::Error;
    /// let check = |share| Error::check_range("the share", "between 0 and 1", share, 0.0..=1.0);
    /// assert!(check(1.0).is_ok());
    /// let message = check(1.5).unwrap_err().to_string();
    /// assert_eq!(message, "the share must be between 0 and 1, but is 1.5");
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

    /// Checks rules for parameters: name, range in words, value, and whether it is in the range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the first that is not.
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

/// The count in words, for [`Error::TooFew`].
fn only(count: usize) -> String {
    match count {
        0 => "there are none".to_owned(),
        1 => "there is only 1".to_owned(),
        _ => format!("there are only {count}"),
    }
}

/// The counts in words, for [`Error::TooFewDistinct`].
fn distinct(count: usize, given: usize) -> String {
    match count {
        1 => format!("the {given} given are equal"),
        _ => format!("of the {given} given only {count} are distinct: the others repeat them"),
    }
}

/// A number without hundreds of zeros.
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
                given: 9,
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
