//! Exact nearest-neighbor search for numeric descriptors.
//!
//! The first list is cut into pieces for threads; a piece is compared with the second list tile by
//! tile. Distances are compared as squares; roots are taken only of the two nearest.

use super::dots;
use super::floats::Floats;
use super::integers::Integers;
use super::neighbors::{Found, Neighbors, Scanned};
use crate::feature::Descriptors;
use crate::feature::descriptors::Values;
use crate::math::{monitored, parallel};
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use std::borrow::Cow;
use std::ops::Range;

/// Number of descriptors of the first list that share a pass over the second.
const ROWS: usize = 64;
/// Number of values of the first list that share a pass over the second, for long descriptors.
const ROW_NUMBERS: usize = 128 * ROWS;
/// Number of descriptors of the first list whose results are collected at once.
const GROUP: usize = 1024;

pub(super) fn search(
    first: &Descriptors,
    second: &Descriptors,
    monitor: &mut dyn Monitor,
) -> Result<Found> {
    if first.dimension() != second.dimension() {
        return Err(Error::SizeMismatch {
            what: "the descriptors of the two images",
            first: first.dimension(),
            second: second.dimension(),
        });
    }
    report(monitor, Stage::FeatureMatching, 0.0)?;
    if first.is_empty() || second.is_empty() {
        return Ok(Found {
            rows: Vec::new(),
            columns: vec![0; second.len()],
        });
    }
    let n = first.dimension();
    if let (Some(a), Some(b)) = (whole_bytes(first), whole_bytes(second)) {
        let second = Integers::new(&b, n);
        let scan = |rows: &Range<usize>| dots::scan(&second, &a[rows.start * n..rows.end * n]);
        return collect_block([first.len(), b.len() / n, n], scan, monitor);
    }
    let a = first.to_floats();
    let second = Floats::new(second.to_floats(), n);
    let scan = |rows: &Range<usize>| second.scan(&a[rows.start * n..rows.end * n]);
    collect_block([first.len(), second.count(), n], scan, monitor)
}

/// Type of a squared distance.
trait Distance: Copy + PartialOrd + Send + Sync + Into<f64> {
    const FARTHEST: Self;
}
impl Distance for i32 {
    const FARTHEST: Self = i32::MAX;
}
impl Distance for f32 {
    const FARTHEST: Self = f32::INFINITY;
}

fn collect_block<D: Distance>(
    [num_rows, num_columns, dimension]: [usize; 3],
    scan: impl Fn(&Range<usize>) -> Scanned<D> + Sync + Send,
    monitor: &mut dyn Monitor,
) -> Result<Found> {
    let root = |squared: D| squared.into().sqrt();
    let stage = Stage::FeatureMatching;
    let piece_len = (ROW_NUMBERS / dimension.max(1)).clamp(8, ROWS);
    let mut rows = Vec::with_capacity(num_rows);
    let mut nearest = vec![(D::FARTHEST, 0); num_columns];
    for group in parallel::pieces(num_rows, GROUP) {
        let pieces: Vec<_> = parallel::pieces(group.len(), piece_len)
            .into_iter()
            .map(|piece| piece.start + group.start..piece.end + group.start)
            .collect();
        let [from, to] = [group.start, group.end].map(|row| row as f32 / num_rows as f32);
        let part = &mut Part::new(monitor, from, to);
        for (piece, scanned) in pieces
            .iter()
            .zip(monitored::map(&pieces, stage, part, &scan)?)
        {
            rows.extend(scanned.rows.iter().map(|&(index, near, second)| Neighbors {
                index,
                distance: root(near) as f32,
                second_distance: (num_columns > 1).then(|| root(second) as f32),
            }));
            // Pieces come in order, so the first of equally near ones is kept.
            for (held, (distance, row)) in nearest.iter_mut().zip(scanned.columns) {
                if distance < held.0 {
                    *held = (distance, piece.start + row);
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

/// Returns the values as bytes, if all are integers from 0 to 255.
fn whole_bytes(descriptors: &Descriptors) -> Option<Cow<'_, [u8]>> {
    match descriptors.values() {
        Values::Bytes(values) => Some(Cow::Borrowed(values)),
        Values::Bits(_) => None,
        Values::Floats(values) => values
            .iter()
            .all(|&v| f32::from(v as u8) == v)
            .then(|| Cow::Owned(values.iter().map(|&v| v as u8).collect())),
    }
}
