//! Matches between descriptors of bits.

use super::neighbors::{Found, Neighbors};
use super::options::{MatchOptions, check};
use super::select::{Match, select};
use crate::feature::parallel;
use crate::math::simd::dispatched;
use crate::progress::{Monitor, Stage, report};
use crate::{Error, Result};
use std::ops::Range;

/// Descriptors of the first list that share a walk over the second.
const ROWS: usize = 128;
/// Descriptors of the first list between two reports of progress.
const REPORT: usize = 8 * ROWS;

/// Descriptors of 256 bits each, as four 64-bit words; bit 0 of word 0 comes first.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct BinaryDescriptors {
    /// One entry per keypoint.
    pub bits: Vec<[u64; 4]>,
}

impl BinaryDescriptors {
    /// Number of descriptors.
    pub fn len(&self) -> usize {
        self.bits.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bits.is_empty()
    }

    /// 32 bytes per descriptor, bit 0 first in each.
    ///
    /// ```
    /// use epipole::feature::BinaryDescriptors;
    /// let descriptors = BinaryDescriptors { bits: vec![[0x0102, 0, 0, 0]] };
    /// assert_eq!(descriptors.to_bytes()[..2], [2, 1]);
    /// ```
    pub fn to_bytes(&self) -> Vec<u8> {
        let words = self.bits.iter().flatten();
        words.flat_map(|word| word.to_le_bytes()).collect()
    }

    /// The other way.
    ///
    /// # Errors
    /// [`Error::SizeMismatch`] unless there are 32 bytes per descriptor.
    ///
    /// ```
    /// assert!(epipole::feature::BinaryDescriptors::from_bytes(&[0; 31]).is_err());
    /// ```
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let (chunks, rest) = bytes.as_chunks::<32>();
        if !rest.is_empty() {
            return Err(Error::SizeMismatch {
                what: "the last binary descriptor and the others, in bytes,",
                first: rest.len(),
                second: 32,
            });
        }
        let word = |chunk: &[u8; 32], k: usize| {
            (0..8).fold(0, |word, i| word | u64::from(chunk[8 * k + i]) << (8 * i))
        };
        Ok(Self {
            bits: chunks
                .iter()
                .map(|chunk| std::array::from_fn(|k| word(chunk, k)))
                .collect(),
        })
    }
}

/// For each descriptor of `first` the two in `second` with the fewest bits that differ, exactly.
///
/// Empty lists give an empty result. The one stage is [`Stage::FeatureMatching`].
///
/// # Errors
/// [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{BinaryDescriptors, nearest_two_hamming};
/// let first = BinaryDescriptors { bits: vec![[0b1011, 0, 0, 0]] };
/// let second = BinaryDescriptors { bits: vec![[0, 0, 0, 0], [0b1111, 0, 0, 0]] };
/// let near = nearest_two_hamming(&first, &second, &mut ())?[0];
/// assert_eq!((near.index, near.distance, near.second_distance), (1, 1.0, Some(3.0)));
/// # Ok(()) }
/// ```
pub fn nearest_two_hamming(
    first: &BinaryDescriptors,
    second: &BinaryDescriptors,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Neighbors>> {
    Ok(search(first, second, monitor)?.rows)
}

/// Matches between two lists of binary descriptors, in the order of the first list. Distances are
/// numbers of bits. The one stage is [`Stage::FeatureMatching`].
///
/// # Errors
/// [`Error::OutOfRange`] for an option outside its range,
/// [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{BinaryDescriptors, MatchOptions, match_hamming};
/// let first = BinaryDescriptors { bits: vec![[0b1011, 0, 0, 0]] };
/// let second = BinaryDescriptors { bits: vec![[0, 0, 0, 0], [0b1111, 0, 0, 0]] };
/// let matches = match_hamming(&first, &second, &MatchOptions::default(), &mut ())?;
/// assert_eq!((matches[0].index2, matches[0].ratio), (1, 1.0 / 3.0));
/// # Ok(()) }
/// ```
pub fn match_hamming(
    first: &BinaryDescriptors,
    second: &BinaryDescriptors,
    options: &MatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Match>> {
    check(options)?;
    let found = search(first, second, monitor)?;
    Ok(select(&found.rows, &found.columns, options))
}

fn search(
    first: &BinaryDescriptors,
    second: &BinaryDescriptors,
    monitor: &mut dyn Monitor,
) -> Result<Found> {
    report(monitor, Stage::FeatureMatching, 0.0)?;
    if first.is_empty() || second.is_empty() {
        return Ok(Found {
            rows: Vec::new(),
            columns: vec![0; second.len()],
        });
    }
    let mut nearest = vec![(u32::MAX, 0); second.len()];
    let mut rows = Vec::with_capacity(first.len());
    let pieces = parallel::pieces(first.len(), ROWS);
    for group in pieces.chunks(REPORT / ROWS) {
        for (more, columns) in parallel::map(group, |piece| scan(first, second, piece.clone())) {
            rows.extend(more);
            for (held, column) in nearest.iter_mut().zip(columns) {
                if column.0 < held.0 {
                    *held = column;
                }
            }
        }
        let share = rows.len() as f32 / first.len() as f32;
        report(monitor, Stage::FeatureMatching, share)?;
    }
    Ok(Found {
        rows,
        columns: nearest.into_iter().map(|(_, row)| row).collect(),
    })
}

/// Neighbors of a piece of the first list, and for each of the second its nearest in that piece.
fn scan(
    first: &BinaryDescriptors,
    second: &BinaryDescriptors,
    piece: Range<usize>,
) -> (Vec<Neighbors>, Vec<(u32, usize)>) {
    let mut rows = Vec::with_capacity(piece.len());
    let mut columns = vec![(u32::MAX, 0); second.len()];
    let mut distances = vec![0; second.len()];
    for row in piece {
        differing_bits(&first.bits[row], &second.bits, &mut distances);
        let (mut near, mut next, mut index) = (u32::MAX, u32::MAX, 0);
        for (k, (&d, held)) in distances.iter().zip(&mut columns).enumerate() {
            if d < next {
                if d < near {
                    (next, near, index) = (near, d, k);
                } else {
                    next = d;
                }
            }
            if d < held.0 {
                *held = (d, row);
            }
        }
        rows.push(Neighbors {
            index,
            distance: near as f32,
            second_distance: (second.len() > 1).then_some(next as f32),
        });
    }
    (rows, columns)
}

dispatched! {
    fn differing_bits(one: &[u64; 4], many: &[[u64; 4]], out: &mut [u32]) {
        for (out, other) in out.iter_mut().zip(many) {
            *out = (0..4).map(|k| (one[k] ^ other[k]).count_ones()).sum();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn random_bits(count: usize, seed: u64) -> BinaryDescriptors {
        let mut random = Random::new(seed);
        let mut word = || (random.below(1 << 32) as u64) << 32 | random.below(1 << 32) as u64;
        BinaryDescriptors {
            bits: (0..count)
                .map(|_| std::array::from_fn(|_| word()))
                .collect(),
        }
    }

    #[test]
    fn neighbors_are_those_of_brute_force() {
        for (n1, n2) in [(1, 1), (3, 2), (300, 150)] {
            let (a, b) = (random_bits(n1, 1), random_bits(n2, 2));
            let near = nearest_two_hamming(&a, &b, &mut ()).unwrap();
            let found = search(&a, &b, &mut ()).unwrap();
            for (k, x) in a.bits.iter().enumerate() {
                let distance =
                    |y: &[u64; 4]| -> u32 { (0..4).map(|i| (x[i] ^ y[i]).count_ones()).sum() };
                let mut all: Vec<_> = b
                    .bits
                    .iter()
                    .enumerate()
                    .map(|(j, y)| (distance(y), j))
                    .collect();
                all.sort_unstable();
                assert_eq!(
                    (near[k].distance, near[k].index),
                    (all[0].0 as f32, all[0].1)
                );
                assert_eq!(near[k].second_distance, all.get(1).map(|d| d.0 as f32));
            }
            for (j, y) in b.bits.iter().enumerate() {
                let distance =
                    |x: &[u64; 4]| -> u32 { (0..4).map(|i| (x[i] ^ y[i]).count_ones()).sum() };
                let best = a.bits.iter().map(distance).min().unwrap();
                let first = a.bits.iter().position(|x| distance(x) == best).unwrap();
                assert_eq!(found.columns[j], first);
            }
        }
    }

    #[test]
    fn bytes_and_empty_lists() {
        let a = random_bits(5, 3);
        assert_eq!(BinaryDescriptors::from_bytes(&a.to_bytes()), Ok(a.clone()));
        let none = BinaryDescriptors::default();
        for (a, b) in [(&none, &none), (&a, &none), (&none, &a)] {
            assert!(
                match_hamming(a, b, &MatchOptions::default(), &mut ())
                    .unwrap()
                    .is_empty()
            );
        }
        let bad = MatchOptions {
            max_ratio: Some(2.0),
            ..MatchOptions::default()
        };
        assert!(match_hamming(&a, &a, &bad, &mut ()).is_err());
    }
}
