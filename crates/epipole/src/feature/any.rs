//! Features of any detector, and their matches.

use super::{
    BinaryDescriptors, Descriptors, Keypoint, Match, MatchOptions, match_descriptors, match_hamming,
};
use crate::progress::Monitor;
use crate::{Error, Result};

/// Descriptors of any kind.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyDescriptors {
    /// Numbers, compared by Euclidean distance: SIFT, RootSIFT, patches.
    Vectors(Descriptors),
    /// Bits, compared by how many differ: ORB.
    Bits(BinaryDescriptors),
}

impl AnyDescriptors {
    /// Number of descriptors.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Vectors(descriptors) => descriptors.len(),
            Self::Bits(descriptors) => descriptors.len(),
        }
    }

    /// The numbers; `None` for bits.
    pub fn as_vectors(&self) -> Option<&Descriptors> {
        match self {
            Self::Vectors(vectors) => Some(vectors),
            Self::Bits(_) => None,
        }
    }
}

/// Keypoints and their descriptors; entry k of one belongs to entry k of the other.
#[derive(Debug, Clone, PartialEq)]
pub struct AnyFeatures {
    /// Keypoints.
    pub keypoints: Vec<Keypoint>,
    /// Its descriptor.
    pub descriptors: AnyDescriptors,
}

/// The matches of two lists of descriptors of one kind, in the order of the first.
///
/// # Errors
/// [`Error::Degenerate`] if one list is of numbers and the other of bits; else as
/// [`match_descriptors`] and [`match_hamming`].
///
/// Source: as [`match_descriptors`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{AnyDescriptors, Descriptors, MatchOptions, match_any_descriptors};
/// let list = |values| Descriptors::from_bytes(2, values).map(AnyDescriptors::Vectors);
/// let (first, second) = (list(vec![9, 9])?, list(vec![90, 90, 8, 9])?);
/// let matches = match_any_descriptors(&first, &second, &MatchOptions::default(), &mut ())?;
/// assert_eq!((matches.len(), matches[0].index2), (1, 1));
/// # Ok(()) }
/// ```
pub fn match_any_descriptors(
    first: &AnyDescriptors,
    second: &AnyDescriptors,
    options: &MatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Match>> {
    match (first, second) {
        (AnyDescriptors::Vectors(a), AnyDescriptors::Vectors(b)) => {
            match_descriptors(a, b, options, monitor)
        }
        (AnyDescriptors::Bits(a), AnyDescriptors::Bits(b)) => match_hamming(a, b, options, monitor),
        _ => Err(Error::Degenerate {
            what: "the distance of two descriptors",
            why: "one is a list of numbers and the other one of bits",
        }),
    }
}
