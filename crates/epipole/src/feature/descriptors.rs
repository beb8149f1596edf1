//! Descriptors of keypoints.

use super::Keypoint;
use crate::{Error, Result};

/// Keypoints and their descriptors, in the same order.
#[derive(Debug, Clone, PartialEq)]
pub struct Features {
    /// Keypoints.
    pub keypoints: Vec<Keypoint>,
    /// Their descriptors.
    pub descriptors: Descriptors,
}

/// Descriptors of equal length: numbers, compared by Euclidean distance (SIFT, RootSIFT, patches),
/// or bits, compared by Hamming distance (ORB).
#[derive(Debug, Clone, PartialEq)]
pub struct Descriptors {
    dimension: usize,
    values: Values,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Values {
    Bytes(Vec<u8>),
    Floats(Vec<f32>),
    Bits(Vec<[u64; 4]>),
}

/// Number of bits of a binary descriptor.
const NUM_BITS: usize = 256;

impl Descriptors {
    /// Creates descriptors from integers 0 to 255, one descriptor after the other.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a dimension of 0 or above 4096, [`Error::SizeMismatch`] if the
    /// values do not fill whole descriptors.
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// let descriptors = epipole::feature::Descriptors::from_bytes(2, vec![1, 2, 3, 4])?;
    /// assert_eq!((descriptors.len(), descriptors.get(1)), (2, Some(vec![3.0, 4.0])));
    /// # Ok(()) }
    /// ```
    pub fn from_bytes(dimension: usize, values: Vec<u8>) -> Result<Self> {
        check(dimension, values.len())?;
        Ok(Self {
            dimension,
            values: Values::Bytes(values),
        })
    }

    /// Creates descriptors from finite numbers, one descriptor after the other.
    ///
    /// # Errors
    /// As [`Descriptors::from_bytes`], and [`Error::NotFinite`] for a value that is NaN or
    /// infinite.
    ///
    /// ```
    /// assert!(epipole::feature::Descriptors::from_floats(2, vec![0.5; 3]).is_err());
    /// ```
    pub fn from_floats(dimension: usize, values: Vec<f32>) -> Result<Self> {
        check(dimension, values.len())?;
        if values.iter().any(|v| !v.is_finite()) {
            return Err(Error::NotFinite {
                what: "every value of a descriptor",
            });
        }
        Ok(Self {
            dimension,
            values: Values::Floats(values),
        })
    }

    /// Creates descriptors of 256 bits each, as four 64-bit words; bit 0 of word 0 comes first.
    ///
    /// ```
    /// let descriptors = epipole::feature::Descriptors::from_bits(vec![[0b101, 0, 0, 0]]);
    /// assert_eq!((descriptors.len(), descriptors.dimension()), (1, 256));
    /// assert_eq!(descriptors.to_floats()[..4], [1.0, 0.0, 1.0, 0.0]);
    /// ```
    pub fn from_bits(bits: Vec<[u64; 4]>) -> Self {
        Self {
            dimension: NUM_BITS,
            values: Values::Bits(bits),
        }
    }

    /// Returns the number of descriptors.
    pub fn len(&self) -> usize {
        match &self.values {
            Values::Bytes(values) => values.len() / self.dimension,
            Values::Floats(values) => values.len() / self.dimension,
            Values::Bits(words) => words.len(),
        }
    }

    /// Returns whether there are no descriptors.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the number of values or bits per descriptor.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Returns descriptor `index` as floats, or `None` past the end; bits become 0 and 1.
    pub fn get(&self, index: usize) -> Option<Vec<f32>> {
        let range = index.checked_mul(self.dimension)?..(index + 1).checked_mul(self.dimension)?;
        match &self.values {
            Values::Bytes(values) => {
                Some(values.get(range)?.iter().map(|&v| f32::from(v)).collect())
            }
            Values::Floats(values) => Some(values.get(range)?.to_vec()),
            Values::Bits(words) => Some(bits_of(words.get(index)?).collect()),
        }
    }

    /// Returns all values as bytes, if stored as bytes.
    pub fn as_bytes(&self) -> Option<&[u8]> {
        match &self.values {
            Values::Bytes(values) => Some(values),
            _ => None,
        }
    }

    /// Returns the words of all binary descriptors; `None` for numbers.
    pub fn as_bits(&self) -> Option<&[[u64; 4]]> {
        match &self.values {
            Values::Bits(words) => Some(words),
            _ => None,
        }
    }

    /// Returns all values as floats; bits become 0 and 1.
    pub fn to_floats(&self) -> Vec<f32> {
        match &self.values {
            Values::Bytes(values) => values.iter().map(|&v| f32::from(v)).collect(),
            Values::Floats(values) => values.clone(),
            Values::Bits(words) => words.iter().flat_map(bits_of).collect(),
        }
    }

    pub(crate) fn values(&self) -> &Values {
        &self.values
    }
}

fn bits_of(words: &[u64; 4]) -> impl Iterator<Item = f32> {
    let words = *words;
    (0..NUM_BITS).map(move |bit| (words[bit / 64] >> (bit % 64) & 1) as f32)
}

fn check(dimension: usize, count: usize) -> Result<()> {
    if !(1..=4096).contains(&dimension) {
        return Err(Error::OutOfRange {
            what: "the length of a descriptor",
            requirement: "between 1 and 4096",
            value: dimension as f64,
        });
    }
    if !count.is_multiple_of(dimension) {
        return Err(Error::SizeMismatch {
            what: "the last descriptor and the others",
            first: count % dimension,
            second: dimension,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_must_fit() {
        assert!(Descriptors::from_bytes(0, vec![]).is_err());
        assert!(Descriptors::from_bytes(4097, vec![]).is_err());
        assert!(Descriptors::from_bytes(3, vec![0; 7]).is_err());
        assert!(Descriptors::from_floats(1, vec![f32::NAN]).is_err());
        let none = Descriptors::from_floats(128, vec![]).unwrap();
        assert!(none.is_empty() && none.get(0).is_none());
        assert_eq!(none.get(usize::MAX - 1), None);
    }
}
