//! Unique data: repetitions are found once and not counted.

use crate::{Error, Result};
use std::collections::HashMap;

/// Maximum number of values of a data point: those of a point and its pixel.
const MAX_COORDINATES: usize = 5;

/// Repetitions in the data.
///
/// Ten equal matches are one observation; counted ten times they would outvote correct ones.
/// Estimators work on the unique data alone, and this maps between unique and given data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unique {
    /// For each unique data point, the index of its first occurrence.
    first: Vec<usize>,
    /// For each given data point, its index among the unique ones; `None` if left out.
    place: Vec<Option<usize>>,
}

impl Unique {
    /// Finds the repetitions among `num_data` data points with coordinates `datum(i)`.
    ///
    /// Unique data keep the order of their first occurrence.
    pub fn new<const D: usize>(num_data: usize, datum: impl Fn(usize) -> [f64; D]) -> Self {
        Self::of_usable(num_data, |i| Some(datum(i)))
    }

    /// As [`new`](Self::new), but leaves out unusable data, given as `None`.
    pub fn of_usable<const D: usize>(
        num_data: usize,
        datum: impl Fn(usize) -> Option<[f64; D]>,
    ) -> Self {
        // Adding zero gives −0 and 0 the same bits.
        let key = |i: usize| {
            let mut key = [0; MAX_COORDINATES];
            for (bits, x) in key.iter_mut().zip(datum(i)?) {
                *bits = (x + 0.0).to_bits();
            }
            Some((key, i))
        };
        const { assert!(D <= MAX_COORDINATES) }
        let keys: Vec<_> = (0..num_data).filter_map(key).collect();
        Self::of_keys(num_data, &keys)
    }

    /// Separate from [`new`](Self::new), so that the search is compiled once for data of every
    /// kind.
    fn of_keys(num_data: usize, keys: &[([u64; MAX_COORDINATES], usize)]) -> Self {
        let mut places = HashMap::with_capacity(keys.len());
        let mut first = Vec::with_capacity(keys.len());
        let mut place = vec![None; num_data];
        for (key, i) in keys {
            place[*i] = Some(*places.entry(key).or_insert_with(|| {
                first.push(*i);
                first.len() - 1
            }));
        }
        Self { first, place }
    }

    /// Returns the number of unique data points.
    pub fn len(&self) -> usize {
        self.first.len()
    }

    /// Returns whether there are no data.
    pub fn is_empty(&self) -> bool {
        self.first.is_empty()
    }

    /// Checks that there are enough unique data to estimate `what`.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer usable data than `needed`, [`Error::TooFewDistinct`] if only
    /// repetitions reach that number.
    pub fn at_least(&self, needed: usize, what: &'static str) -> Result<()> {
        let total = self.place.len() - self.num_left_out();
        match self.len() {
            got if got >= needed => Ok(()),
            got if total >= needed => Err(Error::TooFewDistinct {
                what,
                needed,
                got,
                total,
            }),
            _ => Err(Error::TooFew {
                what,
                needed,
                got: total,
            }),
        }
    }

    /// Returns the index of the first occurrence of each unique data point.
    pub fn first_occurrences(&self) -> &[usize] {
        &self.first
    }

    /// Returns the index of each given data point among the unique ones; `None` if left out.
    pub fn places(&self) -> &[Option<usize>] {
        &self.place
    }

    /// Returns the number of data points left out.
    pub fn num_left_out(&self) -> usize {
        self.place.iter().filter(|place| place.is_none()).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repetitions_are_found_in_any_order() {
        let data = [[1.0, 2.0], [0.0, 1.0], [1.0, 2.0], [-0.0, 1.0], [3.0, 3.0]];
        let unique = Unique::new(data.len(), |i| data[i]);
        assert_eq!(unique.first_occurrences(), [0, 1, 4]);
        assert_eq!(unique.places(), [0, 1, 0, 1, 2].map(Some));
        assert_eq!(unique.len(), 3);
        assert!(Unique::new(0, |_| [0.0]).is_empty());
        let unique = Unique::of_usable(data.len(), |i| (i != 0).then_some(data[i]));
        assert_eq!(unique.first_occurrences(), [1, 2, 4]);
        assert_eq!(unique.places(), [None, Some(0), Some(1), Some(0), Some(2)]);
        assert_eq!((unique.len(), unique.num_left_out()), (3, 1));
    }

    #[test]
    fn small_whole_numbers_and_their_repetitions_are_distinguished() {
        let datum = |i: usize| [(i % 40) as f64, (i / 40 % 30) as f64];
        let unique = Unique::new(2500, datum);
        assert!(unique.first_occurrences().iter().copied().eq(0..1200));
        assert!((0..2500).all(|i| unique.places()[i] == Some(i % 1200)));
    }

    #[test]
    fn repetitions_do_not_make_enough() {
        let data = [[1.0], [1.0], [2.0], [f64::NAN]];
        let unique = Unique::of_usable(4, |i| (!data[i][0].is_nan()).then_some(data[i]));
        assert_eq!(unique.at_least(2, "a fit"), Ok(()));
        let (what, total) = ("a fit", 3);
        let (needed, got) = (3, 2);
        let repeated = Error::TooFewDistinct {
            what,
            needed,
            got,
            total,
        };
        assert_eq!(unique.at_least(needed, what), Err(repeated));
        let (needed, got) = (4, 3);
        let few = Error::TooFew { what, needed, got };
        assert_eq!(unique.at_least(needed, what), Err(few));
    }
}
