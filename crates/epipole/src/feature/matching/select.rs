//! Filters of nearest neighbors, and the resulting matches.

use super::neighbors::Neighbors;
use super::options::MatchOptions;

/// A pair of matching features of two images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Match {
    /// Index in the first list.
    pub index1: usize,
    /// Index in the second list.
    pub index2: usize,
    /// Euclidean or Hamming distance of the descriptors.
    pub distance: f32,
    /// Ratio of this distance to that of the second nearest, in [0, 1]; 0 if there is no second, 1
    /// if both are 0.
    pub ratio: f32,
}

impl Match {
    /// Creates a match from another source, without descriptors: distance and ratio are 0.
    ///
    /// ```
    /// use epipole::feature::Match;
    /// let known = Match { distance: 0.2, ratio: 0.7, ..Match::new(3, 5) };
    /// assert_eq!((known.index1, known.index2), (3, 5));
    /// ```
    pub fn new(index1: usize, index2: usize) -> Self {
        Self {
            index1,
            index2,
            distance: 0.0,
            ratio: 0.0,
        }
    }
}

/// Selects the neighbors that pass all tests.
///
/// * `columns`: for each descriptor of the second list, the index of its nearest in the first
pub(super) fn select(rows: &[Neighbors], columns: &[usize], options: &MatchOptions) -> Vec<Match> {
    let mut matches: Vec<Match> = rows
        .iter()
        .enumerate()
        .filter(|(k, near)| !options.mutual || columns[near.index] == *k)
        .map(|(k, near)| Match {
            index1: k,
            index2: near.index,
            distance: near.distance,
            ratio: near.ratio(),
        })
        .filter(|m| {
            options
                .max_ratio
                .is_none_or(|limit| m.ratio < limit || limit == 1.0)
        })
        .filter(|m| options.max_distance.is_none_or(|limit| m.distance <= limit))
        .collect();
    if options.unique && !options.mutual {
        // The closest for each second index; the first of equally close ones.
        let mut closest: Vec<Option<usize>> = vec![None; columns.len()];
        for (k, m) in matches.iter().enumerate() {
            let held = &mut closest[m.index2];
            if held.is_none_or(|h| m.distance < matches[h].distance) {
                *held = Some(k);
            }
        }
        let mut k = 0;
        matches.retain(|m| {
            k += 1;
            closest[m.index2] == Some(k - 1)
        });
    }
    matches
}
