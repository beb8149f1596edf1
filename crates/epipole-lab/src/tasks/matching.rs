//! Matches of two photographs.

use super::{Described, Match, MatchOptions};
use epipole::feature::{Descriptors, match_descriptors};

/// Matches descriptors.
///
/// # Errors
/// As [`match_descriptors`].
pub(super) fn matches(
    first: Described,
    second: Described,
    options: &MatchOptions,
) -> Result<Vec<Match>, String> {
    let how = epipole::feature::MatchOptions {
        max_ratio: Some(options.ratio),
        mutual: options.mutual,
        ..epipole::feature::MatchOptions::default()
    };
    let found = match_descriptors(&read(first)?, &read(second)?, &how);
    let found = found.map_err(|error| error.to_string())?;
    let plain = |m: &epipole::feature::Match| Match {
        first: m.index1 as u32,
        second: m.index2 as u32,
        ratio: m.ratio,
    };
    Ok(found.iter().map(plain).collect())
}

fn read(described: Described) -> Result<Descriptors, String> {
    let dimension = described.dimension as usize;
    Descriptors::from_bytes(dimension, described.values.0.to_vec())
        .map_err(|error| error.to_string())
}
