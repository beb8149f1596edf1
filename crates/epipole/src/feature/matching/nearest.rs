//! Nearest descriptors and matches, by the metric of the descriptors.

use super::neighbors::{Found, Neighbors};
use super::options::{MatchOptions, check};
use super::select::{Match, select};
use super::{dense, hamming};
use crate::feature::Descriptors;
use crate::math::order::{at_rank, order_by};
use crate::progress::Monitor;
use crate::{Error, Result};

/// Finds, for each descriptor of `first`, the two nearest in `second`, exactly: by Euclidean
/// distance, or by Hamming distance for bits.
///
/// Empty lists give an empty result. Integers from 0 to 255, such as SIFT's, are compared in
/// integers, whether stored as bytes or as floats; other numbers in `f32`. The only stage is
/// [`Stage::FeatureMatching`](crate::progress::Stage::FeatureMatching).
///
/// # Errors
/// [`Error::Degenerate`] if one list is numeric and the other binary, [`Error::SizeMismatch`] for
/// descriptors of different length, [`Error::Canceled`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{Descriptors, nearest_two};
/// let first = Descriptors::from_bytes(2, vec![0, 0])?;
/// let second = Descriptors::from_bytes(2, vec![30, 40, 6, 8])?;
/// let found = nearest_two(&first, &second, &mut ())?[0];
/// assert_eq!((found.index, found.distance, found.second_distance), (1, 10.0, Some(50.0)));
/// # Ok(()) }
/// ```
pub fn nearest_two(
    first: &Descriptors,
    second: &Descriptors,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Neighbors>> {
    Ok(search(first, second, monitor)?.rows)
}

fn search(first: &Descriptors, second: &Descriptors, monitor: &mut dyn Monitor) -> Result<Found> {
    match (first.as_bits(), second.as_bits()) {
        (Some(first), Some(second)) => hamming::search(first, second, monitor),
        (None, None) => dense::search(first, second, monitor),
        _ => Err(Error::Degenerate {
            what: "the distance of two descriptors",
            why: "one is a list of numbers and the other one of bits",
        }),
    }
}

/// Finds the entries of a list nearest to one descriptor, by Euclidean distance: returns indices
/// and distances, nearest first; of equally near ones the lowest index first.
///
/// * `query`: a descriptor of the same length as those of the list
/// * `count`: maximum number of entries
///
/// [`nearest_two`] gives only the distance of the second nearest, this function also its index.
///
/// # Errors
/// [`Error::SizeMismatch`] for a query of another length, [`Error::NotFinite`] for one with NaN or
/// infinity.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{Descriptors, nearest_few};
/// let list = Descriptors::from_bytes(2, vec![30, 40, 6, 8, 0, 1])?;
/// assert_eq!(nearest_few(&[0.0, 0.0], &list, 2)?, [(2, 1.0), (1, 10.0)]);
/// # Ok(()) }
/// ```
pub fn nearest_few(query: &[f32], list: &Descriptors, count: usize) -> Result<Vec<(usize, f32)>> {
    if query.len() != list.dimension() {
        return Err(Error::SizeMismatch {
            what: "a descriptor and those of the list",
            first: query.len(),
            second: list.dimension(),
        });
    }
    if query.iter().any(|v| !v.is_finite()) {
        return Err(Error::NotFinite {
            what: "every value of a descriptor",
        });
    }
    let values = list.to_floats();
    let distances: Vec<f32> = (values.chunks_exact(query.len()))
        .map(|other| {
            let pairs = query.iter().zip(other);
            let apart = pairs.map(|(a, b)| f64::from(*a) - f64::from(*b));
            apart.map(|d| d * d).sum::<f64>().sqrt() as f32
        })
        .collect();
    // Avoid sorting all, since most are too far away.
    let mut all: Vec<f64> = distances.iter().map(|&d| f64::from(d)).collect();
    let farthest = match count {
        0 => return Ok(Vec::new()),
        _ if count < all.len() => at_rank(&mut all, count - 1),
        _ => f64::INFINITY,
    };
    let near: Vec<(usize, f32)> = (distances.into_iter().enumerate())
        .filter(|&(_, distance)| f64::from(distance) <= farthest)
        .collect();
    let mut order = order_by(near.len(), &mut |a, b| near[a].1.total_cmp(&near[b].1));
    order.truncate(count);
    Ok(order.into_iter().map(|place| near[place]).collect())
}

/// Matches two lists of descriptors; matches are in the order of the first list.
///
/// Empty lists give no matches. See [`Match`] for the treatment of a single candidate. The only
/// stage is [`Stage::FeatureMatching`](crate::progress::Stage::FeatureMatching).
///
/// # Errors
/// As [`nearest_two`], and [`Error::OutOfRange`] for an option outside its range.
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::feature::{Descriptors, MatchOptions, match_descriptors};
/// let first = Descriptors::from_floats(1, vec![0.0, 5.0])?;
/// let second = Descriptors::from_floats(1, vec![5.5, 0.25, 40.0])?;
/// let matches = match_descriptors(&first, &second, &MatchOptions::default(), &mut ())?;
/// assert_eq!((matches[0].index1, matches[0].index2, matches[0].distance), (0, 1, 0.25));
/// assert_eq!((matches[1].index1, matches[1].index2, matches[1].distance), (1, 0, 0.5));
/// // Binary descriptors are compared by Hamming distance.
/// let first = Descriptors::from_bits(vec![[0b1011, 0, 0, 0]]);
/// let second = Descriptors::from_bits(vec![[0, 0, 0, 0], [0b1111, 0, 0, 0]]);
/// let matches = match_descriptors(&first, &second, &MatchOptions::default(), &mut ())?;
/// assert_eq!((matches[0].index2, matches[0].ratio), (1, 1.0 / 3.0));
/// # Ok(()) }
/// ```
pub fn match_descriptors(
    first: &Descriptors,
    second: &Descriptors,
    options: &MatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Match>> {
    check(options)?;
    let found = search(first, second, monitor)?;
    Ok(select(&found.rows, &found.columns, options))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn random_bytes(count: usize, dimension: usize, seed: u64) -> Vec<u8> {
        let mut random = Random::new(seed);
        (0..count * dimension)
            .map(|_| random.below(256) as u8)
            .collect()
    }

    /// Distances in f64, one pair after the other.
    fn brute_force(a: &Descriptors, b: &Descriptors) -> Vec<(usize, f64, Option<f64>)> {
        let rows = |d: &Descriptors| (0..d.len()).map(|k| d.get(k).unwrap()).collect::<Vec<_>>();
        let (a, b) = (rows(a), rows(b));
        a.iter()
            .map(|x| {
                let mut all: Vec<(f64, usize)> = b
                    .iter()
                    .enumerate()
                    .map(|(k, y)| {
                        let squares = x
                            .iter()
                            .zip(y)
                            .map(|(p, q)| f64::from(p - q) * f64::from(p - q));
                        (squares.sum::<f64>().sqrt(), k)
                    })
                    .collect();
                all.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
                (all[0].1, all[0].0, all.get(1).map(|s| s.0))
            })
            .collect()
    }

    fn assert_neighbors(a: &Descriptors, b: &Descriptors) {
        let near = nearest_two(a, b, &mut ()).unwrap();
        for (got, want) in near.iter().zip(brute_force(a, b)) {
            assert_eq!(got.index, want.0);
            assert!((f64::from(got.distance) - want.1).abs() <= 1e-5 * want.1.max(1.0));
            assert_eq!(got.second_distance.is_some(), want.2.is_some());
            if let (Some(got), Some(want)) = (got.second_distance, want.2) {
                assert!((f64::from(got) - want).abs() <= 1e-5 * want.max(1.0));
            }
        }
    }

    #[test]
    fn neighbors_are_those_of_brute_force() {
        for (n1, n2, dimension) in [
            (1, 1, 1),
            (1, 2, 3),
            (5, 1, 128),
            (7, 9, 2),
            (70, 130, 128),
            (33, 3, 17),
            (600, 65, 8),
        ] {
            let a = random_bytes(n1, dimension, 1);
            let b = random_bytes(n2, dimension, 2);
            let floats = |v: &[u8], scale: f32| v.iter().map(|&x| f32::from(x) * scale).collect();
            for scale in [1.0, 0.37] {
                let a = Descriptors::from_floats(dimension, floats(&a, scale)).unwrap();
                let b = Descriptors::from_floats(dimension, floats(&b, scale)).unwrap();
                assert_neighbors(&a, &b);
            }
            let a = Descriptors::from_bytes(dimension, a).unwrap();
            let b = Descriptors::from_bytes(dimension, b).unwrap();
            assert_neighbors(&a, &b);
        }
    }

    #[test]
    fn equal_descriptors_go_to_the_lowest_index() {
        let a = Descriptors::from_bytes(2, vec![1, 1, 1, 1]).unwrap();
        let b = Descriptors::from_bytes(2, vec![9, 9, 1, 1, 1, 1]).unwrap();
        let near = nearest_two(&a, &b, &mut ()).unwrap();
        assert_eq!((near[0].index, near[1].index), (1, 1));
        let all = MatchOptions {
            max_ratio: None,
            ..MatchOptions::default()
        };
        let matches = match_descriptors(&a, &b, &all, &mut ()).unwrap();
        assert_eq!(matches.len(), 1);
        assert_eq!(
            (matches[0].index1, matches[0].index2, matches[0].ratio),
            (0, 1, 1.0)
        );
        assert!(
            match_descriptors(&a, &b, &MatchOptions::default(), &mut ())
                .unwrap()
                .is_empty()
        );
    }

    #[test]
    fn each_option_has_its_effect() {
        let a = Descriptors::from_bytes(1, vec![10, 12, 100]).unwrap();
        let b = Descriptors::from_bytes(1, vec![11, 103, 200]).unwrap();
        let none = MatchOptions {
            max_ratio: None,
            mutual: false,
            max_distance: None,
            unique: false,
        };
        let pairs = |options: MatchOptions| {
            let matches = match_descriptors(&a, &b, &options, &mut ()).unwrap();
            matches
                .iter()
                .map(|m| (m.index1, m.index2))
                .collect::<Vec<_>>()
        };
        assert_eq!(pairs(none), [(0, 0), (1, 0), (2, 1)]);
        assert_eq!(
            pairs(MatchOptions {
                unique: true,
                ..none
            }),
            [(0, 0), (2, 1)]
        );
        assert_eq!(
            pairs(MatchOptions {
                mutual: true,
                ..none
            }),
            [(0, 0), (2, 1)]
        );
        assert_eq!(
            pairs(MatchOptions {
                max_distance: Some(2.0),
                ..none
            }),
            [(0, 0), (1, 0)]
        );
        assert_eq!(
            pairs(MatchOptions {
                max_ratio: Some(0.02),
                ..none
            }),
            [(0, 0), (1, 0)]
        );
    }

    #[test]
    fn none_one_and_unequal() {
        let none = Descriptors::from_bytes(3, vec![]).unwrap();
        let one = Descriptors::from_bytes(3, vec![1, 2, 3]).unwrap();
        let options = MatchOptions::default();
        for (a, b) in [(&none, &none), (&one, &none), (&none, &one)] {
            assert!(
                match_descriptors(a, b, &options, &mut ())
                    .unwrap()
                    .is_empty()
            );
        }
        let single = match_descriptors(&one, &one, &options, &mut ()).unwrap();
        assert_eq!((single.len(), single[0].ratio), (1, 0.0));
        let other = Descriptors::from_bytes(2, vec![1, 2]).unwrap();
        assert_eq!(
            match_descriptors(&one, &other, &options, &mut ()),
            Err(Error::SizeMismatch {
                what: "the descriptors of the two images",
                first: 3,
                second: 2
            })
        );
        for max_ratio in [0.0, -1.0, 1.5, f32::NAN] {
            let options = MatchOptions {
                max_ratio: Some(max_ratio),
                ..options
            };
            assert!(match_descriptors(&one, &one, &options, &mut ()).is_err());
        }
        for max_distance in [-1.0, f32::NAN] {
            let options = MatchOptions {
                max_distance: Some(max_distance),
                ..options
            };
            assert!(match_descriptors(&one, &one, &options, &mut ()).is_err());
        }
    }
}
