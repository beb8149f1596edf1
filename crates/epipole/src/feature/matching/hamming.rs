//! Matching of binary descriptors.

use super::neighbors::{Found, Neighbors};
use crate::Result;
use crate::math::simd::dispatched;
use crate::math::{monitored, parallel};
use crate::progress::{Monitor, Part, Stage, report};
use std::ops::Range;

/// Number of descriptors of the first list that share a pass over the second.
const ROWS: usize = 128;
/// Number of pieces of the first list whose results are collected at once.
const GROUP: usize = 8;

/// Finds, for each descriptor of one list, the two of the other with the smallest Hamming distance,
/// exactly.
pub(super) fn search(
    first: &[[u64; 4]],
    second: &[[u64; 4]],
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
    let stage = Stage::FeatureMatching;
    for (k, group) in pieces.chunks(GROUP).enumerate() {
        let [from, to] = [k, k + 1].map(|k| k as f32 / pieces.len().div_ceil(GROUP) as f32);
        let part = &mut Part::new(monitor, from, to);
        let found = monitored::map(group, stage, part, |piece| {
            scan(first, second, piece.clone())
        })?;
        for (more, columns) in found {
            rows.extend(more);
            for (held, column) in nearest.iter_mut().zip(columns) {
                if column.0 < held.0 {
                    *held = column;
                }
            }
        }
    }
    report(monitor, stage, 1.0)?;
    Ok(Found {
        rows,
        columns: nearest.into_iter().map(|(_, row)| row).collect(),
    })
}

/// Returns the neighbors of a piece of the first list, and for each of the second list its nearest
/// in that piece.
fn scan(
    first: &[[u64; 4]],
    second: &[[u64; 4]],
    piece: Range<usize>,
) -> (Vec<Neighbors>, Vec<(u32, usize)>) {
    let mut rows = Vec::with_capacity(piece.len());
    let mut columns = vec![(u32::MAX, 0); second.len()];
    let mut distances = vec![0; second.len()];
    for row in piece {
        differing_bits(&first[row], second, &mut distances);
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

    fn random_bits(count: usize, seed: u64) -> Vec<[u64; 4]> {
        let mut random = Random::new(seed);
        let mut word = || (random.below(1 << 32) as u64) << 32 | random.below(1 << 32) as u64;
        (0..count)
            .map(|_| std::array::from_fn(|_| word()))
            .collect()
    }

    #[test]
    fn neighbors_are_those_of_brute_force() {
        for (n1, n2) in [(1, 1), (3, 2), (300, 150)] {
            let (a, b) = (random_bits(n1, 1), random_bits(n2, 2));
            let found = search(&a, &b, &mut ()).unwrap();
            let near = &found.rows;
            for (k, x) in a.iter().enumerate() {
                let distance =
                    |y: &[u64; 4]| -> u32 { (0..4).map(|i| (x[i] ^ y[i]).count_ones()).sum() };
                let mut all: Vec<_> = b
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
            for (j, y) in b.iter().enumerate() {
                let distance =
                    |x: &[u64; 4]| -> u32 { (0..4).map(|i| (x[i] ^ y[i]).count_ones()).sum() };
                let best = a.iter().map(distance).min().unwrap();
                let first = a.iter().position(|x| distance(x) == best).unwrap();
                assert_eq!(found.columns[j], first);
            }
        }
    }
}
